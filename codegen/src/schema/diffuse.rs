//! `diffuse:` of a material: how light depends on its angles.

use subsurface_profile::single_scattering_albedo::Entry;
use subsurface_profile::{Bounds, Quantity};

use crate::diagnostics::Diagnostic;
use crate::material::DiffuseLobe;
use crate::schema::body::Body;
use crate::schema::choice::{choice, unknown_word};
use crate::schema::decoder::{Decoder, Fields};
use crate::source::Spanned;
use crate::syntax::{Node, Shape};

/// Ways of entry, and their words.
const ENTRIES: [(&str, Entry); 2] = [("Searchlight", Entry::Searchlight), ("Diffuse", Entry::Diffuse)];

const OPPOSITION: Quantity = Quantity {
    noun: "opposition",
    unit: "",
    bounds: Bounds::Unit,
    kind: "number",
    meaning: "give B₀, by how much light that goes straight back is brighter, from 0 to 1",
};

const OPPOSITION_WIDTH: Quantity = Quantity {
    noun: "width of the opposition",
    unit: "",
    bounds: Bounds::Positive,
    kind: "number",
    meaning: "give the tangent of half the angle at which the opposition falls to a half: 0.06 for dust",
};

const GRAIN_ANISOTROPY: Quantity = Quantity {
    noun: "anisotropy",
    unit: "",
    bounds: Bounds::Between(-1, 1),
    kind: "number",
    meaning: "give the mean cosine of the angle at which a grain scatters; below 0 backwards, as dust does",
};

const SIGMA: Quantity = Quantity {
    noun: "sigma",
    unit: "",
    bounds: Bounds::Unit,
    kind: "number",
    meaning: "give the standard deviation of the facets' slopes in radians, from 0 (Lambert) to 1",
};

const SUBSURFACE: Quantity = Quantity {
    noun: "subsurface",
    unit: "",
    bounds: Bounds::Unit,
    kind: "share",
    meaning: "give the share of the flatter form, from 0 to 1",
};

/// A lobe as a file gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum DiffuseGiven {
    /// A lobe that is whole.
    Lobe(DiffuseLobe),
    /// Lambert's under the coupling that makes it so.
    Coupled,
    /// With the entry that the profile is for, where the file says it.
    Chandrasekhar(Option<Entry>),
}

pub(super) fn decode_diffuse(decoder: &mut Decoder, node: &Node<'_>) -> Option<Spanned<DiffuseGiven>> {
    let spanned = |given| Some(Spanned::new(given, node.span()));
    let Some((name, body)) = Body::of(node) else {
        choice(decoder, node, "diffuse", &DiffuseLobe::WORDS)?;
        return None;
    };
    let (known, example): (&[&str], &str) = match name.text {
        "Chandrasekhar" => (&["entry"], "Chandrasekhar(entry: Searchlight)"),
        "Hapke" => (
            &["opposition", "opposition_width", "anisotropy", "refracted"],
            "Hapke(opposition: 1.0, opposition_width: 0.06, anisotropy: -0.3)",
        ),
        "HanrahanKrueger" => (&["anisotropy"], "HanrahanKrueger(anisotropy: 0.0)"),
        "LommelSeeliger" => (&["refracted"], "LommelSeeliger(refracted: true)"),
        "OrenNayar" => (&["sigma"], "OrenNayar(sigma: 0.5)"),
        "Disney" => (&["subsurface"], "Disney(subsurface: 0.0)"),
        word if DiffuseLobe::WORDS.contains(&word) => (&[], word),
        _ => {
            unknown_word(decoder, &name, "diffuse", &DiffuseLobe::WORDS);
            return None;
        }
    };
    if let (true, Shape::Struct(_, entries)) = (known.is_empty(), node.shape())
        && let Some(entry) = entries.first()
    {
        decoder.report(
            Diagnostic::error(format!("`{}` has no fields", name.text))
                .label(entry.key.span.clone(), "not a field of it")
                .help(format!("write `diffuse: {}`", name.text)),
        );
        return None;
    }
    let entries = body.fields(decoder, &name, example)?;
    let fields = decoder.fields(format!("`{}`", name.text), name.span.clone(), entries, known);
    let mut numbers = Numbers { decoder, fields, is_good: true };
    let lobe = match name.text {
        "Lambert" => DiffuseLobe::Lambert,
        "Coupled" => return spanned(DiffuseGiven::Coupled),
        "Chandrasekhar" => return spanned(DiffuseGiven::Chandrasekhar(numbers.entry()?)),
        "Shirley" => DiffuseLobe::Shirley,
        "LommelSeeliger" => DiffuseLobe::LommelSeeliger { refracted: numbers.truth("refracted") },
        "Hapke" => DiffuseLobe::Hapke {
            opposition: numbers.of("opposition", &OPPOSITION, 1.0),
            opposition_width: numbers.of("opposition_width", &OPPOSITION_WIDTH, 0.06),
            // Nearer to ±1 the phase function has no end.
            anisotropy: numbers.of("anisotropy", &GRAIN_ANISOTROPY, 0.0).clamp(-0.95, 0.95),
            refracted: numbers.truth("refracted"),
        },
        "HanrahanKrueger" => DiffuseLobe::HanrahanKrueger {
            anisotropy: numbers.of("anisotropy", &GRAIN_ANISOTROPY, 0.0).clamp(-0.95, 0.95),
        },
        "OrenNayar" => DiffuseLobe::OrenNayar { sigma: numbers.of("sigma", &SIGMA, 0.3) },
        _ => DiffuseLobe::Disney { subsurface: numbers.of("subsurface", &SUBSURFACE, 0.0) },
    };
    if numbers.is_good { spanned(DiffuseGiven::Lobe(lobe)) } else { None }
}

/// The fields of a lobe.
struct Numbers<'d, 't, 'n> {
    decoder: &'d mut Decoder<'t>,
    fields: Fields<'n>,
    is_good: bool,
}

impl Numbers<'_, '_, '_> {
    /// A number, or its default where the file does not give it.
    fn of(&mut self, name: &str, quantity: &Quantity, default: f64) -> f64 {
        let Self { decoder, fields, is_good } = self;
        let given = fields.optional(name, |node| decoder.number(node, name, quantity));
        *is_good &= !given.is_bad();
        given.value().copied().unwrap_or(default)
    }

    /// `true` or `false`; `false` where the file does not say.
    fn truth(&mut self, name: &str) -> bool {
        let Self { decoder, fields, is_good } = self;
        let given = fields.optional(name, |node| decoder.truth(node, name));
        *is_good &= !given.is_bad();
        given.value().copied().unwrap_or_default()
    }

    /// The entry, if there is one; `None` where it is wrong.
    fn entry(&mut self) -> Option<Option<Entry>> {
        let Self { decoder, fields, .. } = self;
        let entry = fields.optional("entry", |node| {
            let word = choice(decoder, node, "entry", &ENTRIES.map(|(word, _)| word))?;
            ENTRIES.into_iter().find(|(known, _)| *known == word).map(|(_, entry)| entry)
        });
        (!entry.is_bad()).then(|| entry.value().copied())
    }
}

/// That a profile does not say how light enters.
pub(crate) fn no_entry(given: &Spanned<DiffuseGiven>) -> Diagnostic {
    Diagnostic::error("this profile does not say how light enters")
        .label(given.span.clone(), "its angles depend on that")
        .help("write `Chandrasekhar(entry: Searchlight)` if the profile is for perpendicular entry, `entry: Diffuse` if for light from everywhere")
        .help("or write `diffuse: Lambert`, or leave it out")
}

/// That a lobe needs another coupling.
pub(crate) fn other_coupling(given: &Spanned<DiffuseGiven>, needed: &str, remedy: &str) -> Diagnostic {
    Diagnostic::error(format!("this lobe is one under `coupling: {needed}`"))
        .label(given.span.clone(), "`specular` gives another coupling")
        .help(remedy)
}
