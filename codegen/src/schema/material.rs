//! Material files.

use subsurface_profile::Length;

use crate::diagnostics::Diagnostic;
use crate::identifier;
use crate::material::{Coupling, SecondLobe, Transmittance};
use crate::schema::body::Body;
use crate::schema::choice::choice;
use crate::schema::clear::CLEAR;
use crate::schema::decoder::{Decoder, Fields, Given, Triple, head};
use crate::schema::diffuse::{DiffuseGiven, decode_diffuse};
use crate::schema::medium::{OrMedium, decode_medium};
use crate::schema::profile::{ProfileExpression, decode_profile};
use crate::schema::quantity::{
    DIFFUSE_MEAN_FREE_PATH, LOBE_WEIGHT, MEAN_FREE_PATH, REFLECTANCE, ROUGHNESS, SURFACE_ALBEDO,
    SURFACE_ALBEDO_MIX, THICKNESS, TRANSMISSION,
};
use crate::schema::set_file::SET;
use crate::source::{FileId, Span, Spanned};
use crate::suggestion::{closest, shortened};
use crate::syntax::{Document, Entry, Name, Node, Shape};

/// What a material writes that has not what its base has.
const NONE: &str = "None";

/// Version of the grammar of material files that this crate reads.
pub(crate) const SCHEMA_VERSION: u32 = 1;

/// A material as its file gives it: what is not written is absent, names of other files are names.
#[derive(Clone, Debug)]
pub(crate) struct MaterialFile {
    pub(crate) file: FileId,
    pub(crate) docs: Vec<String>,
    /// The word `Material`.
    pub(crate) head: Span,
    /// The name and where it is given: the field `name`, or the word `Material` when the file's stem is the name.
    pub(crate) name: Spanned<String>,
    pub(crate) base: Given<Spanned<String>>,
    pub(crate) profile: Given<(ProfileExpression, Span)>,
    pub(crate) length: Given<OrMedium<LengthGiven>>,
    pub(crate) surface_albedo: Given<OrMedium<Triple>>,
    pub(crate) surface_albedo_mix: Given<Spanned<f64>>,
    /// Where the medium is given by its coefficients.
    pub(crate) refractive_index: Given<Spanned<f64>>,
    pub(crate) reflectance_at_normal: Given<Spanned<f64>>,
    pub(crate) roughness: Given<Spanned<f64>>,
    pub(crate) coupling: Given<Coupling>,
    /// `None` within where the file says that there is none.
    pub(crate) second_lobe: Given<Option<SecondLobe>>,
    pub(crate) diffuse: Given<Spanned<DiffuseGiven>>,
    pub(crate) transmission_strength: Given<Spanned<f64>>,
    pub(crate) transmission_diffused: Given<bool>,
    pub(crate) transmittance: Given<Spanned<Transmittance>>,
    /// 0 where the file says that it is no sheet.
    pub(crate) thin_thickness_mm: Given<Spanned<f64>>,
}

/// The length that scales the profile, as given.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct LengthGiven {
    /// Which length the field's name says it is.
    pub(crate) kind: Length,
    /// The field's name.
    pub(crate) key: Span,
    pub(crate) value: Triple,
}

const FIELDS: [&str; 15] = [
    "version",
    "name",
    "base",
    "profile",
    "mean_free_path_mm",
    "diffuse_mean_free_path_mm",
    "surface_albedo",
    "surface_albedo_mix",
    "medium",
    "specular",
    "diffuse",
    "transmission",
    "transmission_strength",
    "transmittance",
    "thin",
];

/// Fields that a reader may look for one level higher than they are.
const GROUPED: [(&str, &str); 11] = [
    ("reflectance_at_normal", "specular"),
    ("roughness", "specular"),
    ("coupling", "specular"),
    ("second", "specular"),
    ("diffused", "transmission"),
    ("thickness_mm", "thin"),
    ("reduced_scattering_per_mm", "medium"),
    ("scattering_per_mm", "medium"),
    ("anisotropy", "medium"),
    ("absorption_per_mm", "medium"),
    ("refractive_index", "medium"),
];

/// Decodes the file of a material; `None` when nothing in it can be trusted.
pub(crate) fn decode_material(
    decoder: &mut Decoder,
    file: FileId,
    stem: &str,
    document: &Document<'_>,
) -> Option<MaterialFile> {
    let node = &document.value;
    let Some((name, body)) = Body::of(node).filter(|(name, _)| name.text == "Material") else {
        let found = node.name();
        let mut diagnostic = Diagnostic::error("expected a material")
            .label(head(found.as_ref(), node), format!("expected `Material(…)`, found {}", node.kind()));
        if let Some(meant) = found.as_ref().and_then(|name| closest(name.text, ["Material", SET, CLEAR])) {
            diagnostic = diagnostic.help(format!("did you mean `{meant}`?"));
        }
        let help = "a material is `Material(profile: …, mean_free_path_mm: …, surface_albedo: …)`; profiles belong \
                    in the folder `profiles`";
        decoder.report(diagnostic.help(help));
        return None;
    };
    let example = "Material(profile: \"two_exponential_dipole_searchlight\", …)";
    let entries = body.fields(decoder, &name, example)?;
    check_version(decoder, &entries)?;
    Some(decode_fields(decoder, file, stem, document, &name, entries))
}

/// A file from the future may have fields unknown today, so the version is read before any other field.
pub(super) fn check_version(decoder: &mut Decoder, entries: &[Entry<'_>]) -> Option<()> {
    let Some(entry) = entries.iter().find(|entry| entry.key.text == "version") else { return Some(()) };
    let help = format!("this compiler reads version {SCHEMA_VERSION}: write `version: {SCHEMA_VERSION}`");
    let Ok(version) = ron::from_str::<u64>(entry.value.text()) else {
        decoder.wrong_type(&entry.value, "version", "a whole number", help);
        return Some(());
    };
    if version == 0 {
        decoder.report(
            Diagnostic::error("there is no schema version 0")
                .label(entry.value.span(), "versions begin at 1")
                .help(help),
        );
    } else if version > u64::from(SCHEMA_VERSION) {
        decoder.report(
            Diagnostic::error(format!("this file is written for schema version {version}"))
                .label(entry.value.span(), format!("this compiler reads versions up to {SCHEMA_VERSION}"))
                .help("update the compiler: `cargo update -p subsurface-codegen`, or a newer release of it")
                .help("nothing else in this file was checked"),
        );
        return None;
    }
    Some(())
}

fn decode_fields(
    decoder: &mut Decoder,
    file: FileId,
    stem: &str,
    document: &Document<'_>,
    name: &Name<'_>,
    entries: Vec<Entry<'_>>,
) -> MaterialFile {
    const RGB: &str = "(red, green, blue)";
    let fields = decoder.fields_and_groups("`Material`", name.span.clone(), entries, &FIELDS, &GROUPED);
    let given_name = fields.optional("name", |node| decoder.text(node, "name"));
    let is_given = !given_name.is_absent();
    let material_name = match given_name {
        Given::Value(name) => name,
        Given::Absent | Given::Bad => Spanned::new(stem.to_owned(), name.span.clone()),
    };
    check_name(decoder, &material_name, is_given);
    let profile = fields.optional("profile", |node| {
        decode_profile(decoder, node, "profile").map(|expression| (expression, node.span()))
    });
    let length = decode_length(decoder, &fields);
    let surface_albedo = fields
        .optional("surface_albedo", |node| decoder.triple(node, "surface_albedo", RGB, &SURFACE_ALBEDO));
    let surface_albedo_mix = fields.optional("surface_albedo_mix", |node| {
        decoder.spanned_number(node, "surface_albedo_mix", &SURFACE_ALBEDO_MIX)
    });
    let (length, surface_albedo, refractive_index) = match fields.get("medium") {
        None => (length.map(OrMedium::Value), surface_albedo.map(OrMedium::Value), Given::Absent),
        Some(entry) => {
            let key = &entry.key.span;
            let medium = fields.optional("medium", |node| decode_medium(decoder, key, node));
            let medium = if is_given_twice(decoder, &fields, key) { Given::Bad } else { medium };
            let medium = medium.map(Box::new);
            let index = medium.clone().map(|medium| medium.refractive_index);
            (medium.clone().map(OrMedium::Medium), medium.map(OrMedium::Medium), index)
        }
    };
    let SpecularGiven { reflectance_at_normal, roughness, coupling, second_lobe } =
        decode_specular(decoder, &fields);
    let diffuse = fields.optional("diffuse", |node| decode_diffuse(decoder, node));
    let transmission_strength = fields.optional("transmission_strength", |node| {
        decoder.spanned_number(node, "transmission_strength", &TRANSMISSION)
    });
    let transmission_diffused = decode_transmission(decoder, &fields);
    let transmittance = fields.optional("transmittance", |node| {
        let word = choice(decoder, node, "transmittance", &Transmittance::ALL.map(Transmittance::name))?;
        Some(Spanned::new(Transmittance::from_name(word)?, node.span()))
    });
    let thin_thickness_mm = decode_thin(decoder, &fields);
    MaterialFile {
        file,
        docs: document.docs.clone(),
        head: name.span.clone(),
        name: material_name,
        base: fields.optional("base", |node| decoder.text(node, "base")),
        profile,
        length,
        surface_albedo,
        surface_albedo_mix,
        refractive_index,
        reflectance_at_normal,
        roughness,
        coupling,
        second_lobe,
        diffuse,
        transmission_strength,
        transmission_diffused,
        transmittance,
        thin_thickness_mm,
    }
}

/// Reports what follows from the coefficients of the medium, and is given beside them.
fn is_given_twice(decoder: &mut Decoder, fields: &Fields<'_>, medium: &Span) -> bool {
    let mut is_twice = false;
    for name in ["mean_free_path_mm", "diffuse_mean_free_path_mm", "surface_albedo"] {
        let Some(entry) = fields.get(name) else { continue };
        decoder.report(
            Diagnostic::error(format!("`{name}` follows from `medium`"))
                .label(entry.key.span.clone(), "given here")
                .secondary(medium.clone(), "the coefficients say it already")
                .help("remove one of the two; a material that has this one as its base may override it"),
        );
        is_twice = true;
    }
    is_twice
}

fn decode_length(decoder: &mut Decoder, fields: &Fields<'_>) -> Given<LengthGiven> {
    const RGB: &str = "(red, green, blue)";
    let mut decode = |name, kind, quantity| {
        fields.optional(name, |node| {
            let value = decoder.triple(node, name, RGB, quantity)?;
            let key = fields.get(name)?.key.span.clone();
            Some(LengthGiven { kind, key, value })
        })
    };
    let length = decode("mean_free_path_mm", Length::MeanFreePath, &MEAN_FREE_PATH);
    let diffuse = decode("diffuse_mean_free_path_mm", Length::DiffuseMeanFreePath, &DIFFUSE_MEAN_FREE_PATH);
    match (fields.get("mean_free_path_mm"), fields.get("diffuse_mean_free_path_mm")) {
        (None, None) if length.is_bad() || diffuse.is_bad() => Given::Bad, // misspelt
        (Some(one), Some(other)) => {
            decoder.report(
                Diagnostic::error("two lengths are given for one profile")
                    .label(other.key.span.clone(), "given here")
                    .secondary(one.key.span.clone(), "and here")
                    .help("a profile is scaled by one length: remove the one that your profile does not use")
                    .help("`Burley(parametrization: DiffuseMeanFreePath)` takes the diffuse mean free path, other models the mean free path"),
            );
            Given::Bad
        }
        (Some(_), None) => length,
        (None, _) => diffuse,
    }
}

/// The fields of `specular`.
struct SpecularGiven {
    reflectance_at_normal: Given<Spanned<f64>>,
    roughness: Given<Spanned<f64>>,
    coupling: Given<Coupling>,
    second_lobe: Given<Option<SecondLobe>>,
}

fn decode_specular(decoder: &mut Decoder, fields: &Fields<'_>) -> SpecularGiven {
    let Some(entry) = fields.get("specular") else {
        return SpecularGiven {
            reflectance_at_normal: Given::Absent,
            roughness: Given::Absent,
            coupling: Given::Absent,
            second_lobe: Given::Absent,
        };
    };
    let entries = match entry.value.shape() {
        Shape::Struct(None, entries) => entries,
        Shape::Tuple(None, nodes) if nodes.is_empty() => Vec::new(),
        _ => {
            let help = "write `specular: (reflectance_at_normal: 0.028, roughness: 0.40)`";
            decoder.wrong_type(&entry.value, "specular", "named values", help);
            return SpecularGiven {
                reflectance_at_normal: Given::Bad,
                roughness: Given::Bad,
                coupling: Given::Bad,
                second_lobe: Given::Bad,
            };
        }
    };
    let head = head(None, &entry.value);
    let known = ["reflectance_at_normal", "roughness", "coupling", "second"];
    let inner = decoder.fields("`specular`", head, entries, &known);
    let mut number =
        |name, quantity| inner.optional(name, |node| decoder.spanned_number(node, name, quantity));
    let reflectance_at_normal = number("reflectance_at_normal", &REFLECTANCE);
    let roughness = number("roughness", &ROUGHNESS);
    let coupling = inner.optional("coupling", |node| {
        // In RON the word is one of its own, for an option.
        if node.text() == Coupling::None.name() {
            return Some(Coupling::None);
        }
        let word = choice(decoder, node, "coupling", &Coupling::ALL.map(Coupling::name))?;
        Coupling::ALL.into_iter().find(|coupling| coupling.name() == word)
    });
    let second_lobe = inner.optional("second", |node| {
        if node.text() == NONE { Some(None) } else { decode_second_lobe(decoder, node).map(Some) }
    });
    SpecularGiven { reflectance_at_normal, roughness, coupling, second_lobe }
}

/// `second:` of `specular`.
fn decode_second_lobe(decoder: &mut Decoder, node: &Node<'_>) -> Option<SecondLobe> {
    const EXAMPLE: &str = "write `second: (roughness: 0.25, weight: 0.3)`";
    let Shape::Struct(None, entries) = node.shape() else {
        decoder.wrong_type(node, "second", "named numbers", EXAMPLE);
        return None;
    };
    let head = head(None, node);
    let fields = decoder.fields("`second`", head.clone(), entries, &["roughness", "weight"]);
    let mut number =
        |name, quantity| fields.optional(name, |node| decoder.spanned_number(node, name, quantity));
    let (roughness, weight) = (number("roughness", &ROUGHNESS), number("weight", &LOBE_WEIGHT));
    for (field, is_absent) in [("roughness", roughness.is_absent()), ("weight", weight.is_absent())] {
        if is_absent {
            decoder.missing("`second`", &head, field, EXAMPLE);
        }
    }
    Some(SecondLobe { roughness: roughness.value()?.value, weight: weight.value()?.value })
}

fn decode_transmission(decoder: &mut Decoder, fields: &Fields<'_>) -> Given<bool> {
    fields.optional("transmission", |node| {
        let Shape::Struct(None, entries) = node.shape() else {
            decoder.wrong_type(
                node,
                "transmission",
                "named values",
                "write `transmission: (diffused: true)`",
            );
            return None;
        };
        let inner = decoder.fields("`transmission`", head(None, node), entries, &["diffused"]);
        match inner.optional("diffused", |node| decoder.truth(node, "diffused")) {
            Given::Absent => Some(false),
            Given::Bad => None,
            Given::Value(is_diffused) => Some(is_diffused),
        }
    })
}

fn decode_thin(decoder: &mut Decoder, fields: &Fields<'_>) -> Given<Spanned<f64>> {
    fields.optional("thin", |node| {
        if node.text() == NONE {
            return Some(Spanned::new(0.0, node.span()));
        }
        let Shape::Struct(None, entries) = node.shape() else {
            decoder.wrong_type(node, "thin", "a named number", "write `thin: (thickness_mm: 0.25)`");
            return None;
        };
        let inner = decoder.fields("`thin`", head(None, node), entries, &["thickness_mm"]);
        let thickness =
            inner.optional("thickness_mm", |node| decoder.spanned_number(node, "thickness_mm", &THICKNESS));
        if thickness.is_absent() {
            decoder.report(
                Diagnostic::error("missing field `thickness_mm`")
                    .label(node.span(), "`thin` needs `thickness_mm`")
                    .help("add `thickness_mm: 0.25`, the thickness of the sheet in mm"),
            );
        }
        thickness.value().cloned()
    })
}

pub(super) fn check_name(decoder: &mut Decoder, name: &Spanned<String>, is_given: bool) {
    let Err(bad) = identifier::check(&name.value) else { return };
    let shown = shortened(&name.value);
    let label = if is_given {
        "the name of a material becomes an identifier in WGSL and Rust"
    } else {
        "named after its file; the name becomes an identifier in WGSL and Rust"
    };
    let remedy = if is_given {
        format!("for example `name: \"{}\"`", bad.suggestion)
    } else {
        format!("rename the file, for example to `{0}.ron`, or give `name: \"{0}\"`", bad.suggestion)
    };
    decoder.report(
        Diagnostic::error(if shown.is_empty() {
            "the name is empty".to_owned()
        } else {
            format!("the name `{shown}` {}", bad.reason)
        })
        .label(name.span.clone(), label)
        .help(format!(
            "use up to {} letters a-z, digits and single underscores, beginning with a letter",
            identifier::LONGEST_NAME
        ))
        .help(remedy),
    );
}
