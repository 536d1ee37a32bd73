//! `diffuse:` of a material: how light depends on its angles.

use subsurface_profile::single_scattering_albedo::Entry;

use crate::diagnostics::Diagnostic;
use crate::material::DiffuseLobe;
use crate::schema::body::Body;
use crate::schema::choice::{choice, unknown_word};
use crate::schema::decoder::Decoder;
use crate::source::Spanned;
use crate::syntax::{Node, Shape};

/// Ways of entry, and their words.
const ENTRIES: [(&str, Entry); 2] = [("Searchlight", Entry::Searchlight), ("Diffuse", Entry::Diffuse)];

/// A lobe as a file gives it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum DiffuseGiven {
    Lambert,
    /// With the entry that the profile is for, where the file says it.
    Chandrasekhar(Option<Entry>),
}

pub(super) fn decode_diffuse(decoder: &mut Decoder, node: &Node<'_>) -> Option<Spanned<DiffuseGiven>> {
    const EXAMPLE: &str = "Chandrasekhar(entry: Searchlight)";
    if let (Some((name, body)), false) = (Body::of(node), matches!(node.shape(), Shape::Name(_)))
        && name.text == DiffuseLobe::WORDS[1]
    {
        let entries = body.fields(decoder, &name, EXAMPLE)?;
        let fields = decoder.fields("`Chandrasekhar`", name.span.clone(), entries, &["entry"]);
        let entry = fields.optional("entry", |node| {
            let word = choice(decoder, node, "entry", &ENTRIES.map(|(word, _)| word))?;
            ENTRIES.into_iter().find(|(known, _)| *known == word).map(|(_, entry)| entry)
        });
        if entry.is_bad() {
            return None;
        }
        return Some(Spanned::new(DiffuseGiven::Chandrasekhar(entry.value().copied()), node.span()));
    }
    if let Some((name, _)) = Body::of(node)
        && !DiffuseLobe::WORDS.contains(&name.text)
    {
        unknown_word(decoder, &name, "diffuse", &DiffuseLobe::WORDS);
        return None;
    }
    let word = choice(decoder, node, "diffuse", &DiffuseLobe::WORDS)?;
    let given =
        if word == DiffuseLobe::WORDS[0] { DiffuseGiven::Lambert } else { DiffuseGiven::Chandrasekhar(None) };
    Some(Spanned::new(given, node.span()))
}

/// That a profile does not say how light enters.
pub(crate) fn no_entry(given: &Spanned<DiffuseGiven>) -> Diagnostic {
    Diagnostic::error("this profile does not say how light enters")
        .label(given.span.clone(), "its angles depend on that")
        .help("write `Chandrasekhar(entry: Searchlight)` if the profile is for perpendicular entry, `entry: Diffuse` if for light from everywhere")
        .help("or write `diffuse: Lambert`, or leave it out")
}
