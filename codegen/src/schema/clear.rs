//! Files of clear materials: what absorbs light, and does not scatter it.

use crate::clear::ClearMaterial;
use crate::diagnostics::Diagnostic;
use crate::schema::body::Body;
use crate::schema::decoder::{Decoder, Given, head};
use crate::schema::material::{check_name, check_version};
use crate::schema::quantity::{DISTANCE, REFRACTIVE_INDEX, ROUGHNESS, SHELL_THICKNESS, TRANSMITTED_COLOUR};
use crate::source::Spanned;
use crate::syntax::{Document, Node, Shape};

/// The name that such a file begins with.
pub(crate) const CLEAR: &str = "Clear";

const FIELDS: [&str; 6] =
    ["version", "name", "absorption", "refractive_index", "roughness", "shell_thickness_mm"];
const EXAMPLE: &str =
    "Clear(absorption: (colour: (0.3, 0.73, 0.63), at_distance_mm: 1000), refractive_index: 1.33)";
const ABSORPTION_EXAMPLE: &str = "write `absorption: (colour: (0.3, 0.73, 0.63), at_distance_mm: 1000)`, the colour of \
                                  white light that has gone so far";

/// A clear material as its file gives it.
#[derive(Clone, Debug)]
pub(crate) struct ClearFile {
    /// The name and where it is given.
    pub(crate) name: Spanned<String>,
    /// `None` where a field is wrong, which has been reported.
    pub(crate) material: Option<ClearMaterial>,
}

/// Decodes a file whose value is `Clear(…)`; `None` when nothing in it can be trusted.
pub(crate) fn decode_clear(decoder: &mut Decoder, stem: &str, document: &Document<'_>) -> Option<ClearFile> {
    let (word, body) = Body::of(&document.value)?;
    let entries = body.fields(decoder, &word, EXAMPLE)?;
    check_version(decoder, &entries)?;
    let fields = decoder.fields("`Clear`", word.span.clone(), entries, &FIELDS);
    let given_name = fields.optional("name", |node| decoder.text(node, "name"));
    let is_given = !given_name.is_absent();
    let name = match given_name {
        Given::Value(name) => name,
        Given::Absent | Given::Bad => Spanned::new(stem.to_owned(), word.span.clone()),
    };
    check_name(decoder, &name, is_given);
    let absorption = fields.required(decoder, "absorption", ABSORPTION_EXAMPLE, decode_absorption);
    let mut number =
        |name, quantity| fields.optional(name, |node| decoder.spanned_number(node, name, quantity));
    let refractive_index = number("refractive_index", &REFRACTIVE_INDEX);
    let roughness = number("roughness", &ROUGHNESS);
    let shell = number("shell_thickness_mm", &SHELL_THICKNESS);
    let is_bad = refractive_index.is_bad() || roughness.is_bad() || shell.is_bad();
    let of = |given: &Given<Spanned<f64>>, default| given.value().map_or(default, |given| given.value);
    let material = absorption.filter(|_| !is_bad).map(|absorption_per_mm| ClearMaterial {
        name: name.value.clone(),
        docs: document.docs.clone(),
        absorption_per_mm,
        refractive_index: of(&refractive_index, 1.0),
        roughness: of(&roughness, 0.0),
        shell_thickness_mm: shell.value().map(|thickness| thickness.value),
    });
    Some(ClearFile { name, material })
}

/// σ of `absorption: (colour: …, at_distance_mm: …)`.
fn decode_absorption(decoder: &mut Decoder, node: &Node<'_>) -> Option<[f64; 3]> {
    let Shape::Struct(None, entries) = node.shape() else {
        decoder.wrong_type(node, "absorption", "a colour at a distance", ABSORPTION_EXAMPLE);
        return None;
    };
    let fields = decoder.fields("`absorption`", head(None, node), entries, &["colour", "at_distance_mm"]);
    let colour = fields.required(decoder, "colour", ABSORPTION_EXAMPLE, |decoder, node| {
        decoder.triple(node, "colour", "(red, green, blue)", &TRANSMITTED_COLOUR)
    });
    let distance = fields.required(decoder, "at_distance_mm", ABSORPTION_EXAMPLE, |decoder, node| {
        decoder.spanned_number(node, "at_distance_mm", &DISTANCE)
    });
    let (colour, distance) = (colour?, distance?);
    if let Some(black) = colour.values.iter().position(|colour| *colour < ClearMaterial::LEAST_COLOUR) {
        decoder.report(
            Diagnostic::warning("a colour of 0 counts as a millionth")
                .label(colour.spans[black].clone(), "no finite absorption lets nothing through")
                .help("give what little comes through at the distance, or a shorter distance"),
        );
    }
    let absorption = colour.values.map(|colour| ClearMaterial::absorption_of(colour, distance.value));
    if absorption.iter().any(|absorption| *absorption > ClearMaterial::MOST_ABSORPTION) {
        decoder.report(
            Diagnostic::error("this absorption is too large")
                .label(distance.span, "the colour is reached after less than light can go")
                .help("give a longer distance; after a thousandth of a millimetre is what ink has"),
        );
        return None;
    }
    Some(absorption)
}
