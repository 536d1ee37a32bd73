//! `medium:` of a material: its coefficients, in place of a length and a surface albedo.

use subsurface_profile::Length;
use subsurface_profile::single_scattering_albedo::{
    Entry, diffuse_per_mean_free_path, to_surface_albedo_below,
};

use crate::diagnostics::Diagnostic;
use crate::schema::decoder::{Decoder, Given, Triple, head};
use crate::schema::material::LengthGiven;
use crate::schema::quantity::{ABSORPTION, ANISOTROPY, REFRACTIVE_INDEX, SCATTERING};
use crate::source::{Span, Spanned};
use crate::syntax::{Node, Shape};

/// A value that a file gives, or that follows from the coefficients of the medium.
#[derive(Clone, Debug)]
pub(crate) enum OrMedium<T> {
    Value(T),
    Medium(Box<MediumGiven>),
}

/// The coefficients of a medium.
#[derive(Clone, Debug)]
pub(crate) struct MediumGiven {
    /// The field's name.
    pub(crate) key: Span,
    /// σs′ per mm.
    reduced_scattering: Triple,
    /// σa per mm.
    absorption: Triple,
    pub(crate) refractive_index: Spanned<f64>,
}

const REDUCED: &str = "reduced_scattering_per_mm";
const FULL: &str = "scattering_per_mm";
const EXAMPLE: &str = "write `medium: (reduced_scattering_per_mm: (0.74, 0.88, 1.01), absorption_per_mm: (0.032, 0.17, \
                       0.48), refractive_index: 1.3)`";

impl MediumGiven {
    fn attenuation(&self, channel: usize) -> f64 {
        self.reduced_scattering.values[channel] + self.absorption.values[channel]
    }

    fn single_scattering_albedo(&self, channel: usize) -> f64 {
        self.reduced_scattering.values[channel] / self.attenuation(channel)
    }

    /// ℓ = 1/(σs′ + σa), or ℓ_d; infinite where that is asked of a medium that absorbs nothing.
    pub(crate) fn length(&self, kind: Length) -> LengthGiven {
        let values = [0, 1, 2].map(|channel: usize| {
            let mean_free_path = 1.0 / self.attenuation(channel);
            match kind {
                Length::MeanFreePath => mean_free_path,
                Length::DiffuseMeanFreePath => {
                    mean_free_path * diffuse_per_mean_free_path(self.single_scattering_albedo(channel))
                }
            }
        });
        let Triple { spans, span, .. } = self.reduced_scattering.clone();
        LengthGiven { kind, key: self.key.clone(), value: Triple { values, spans, span } }
    }

    /// A of the medium below its boundary, per energy that entered.
    pub(crate) fn surface_albedo(&self, entry: Entry) -> Triple {
        let values = [0, 1, 2].map(|channel: usize| {
            let alpha = self.single_scattering_albedo(channel);
            to_surface_albedo_below(entry, self.refractive_index.value, alpha)
        });
        let Triple { spans, span, .. } = self.absorption.clone();
        Triple { values, spans, span }
    }
}

/// That a medium without absorption has no diffuse mean free path, which its profile takes.
pub(crate) fn clear_medium(
    length: &LengthGiven,
    surface_albedo: Option<&OrMedium<Triple>>,
    channel: usize,
) -> Diagnostic {
    let place = match surface_albedo {
        Some(OrMedium::Medium(medium)) => &medium.absorption.spans[channel],
        _ => &length.key,
    };
    Diagnostic::error("a medium that absorbs nothing has no diffuse mean free path")
        .label(place.clone(), "no absorption")
        .help("give an absorption above 0, or a profile that takes the mean free path, such as `\"burley_searchlight\"`")
}

/// F₀ = ((η - 1)/(η + 1))² of a boundary.
pub(crate) fn reflectance_at_normal(refractive_index: f64) -> f64 {
    ((refractive_index - 1.0) / (refractive_index + 1.0)).powi(2)
}

pub(super) fn decode_medium(decoder: &mut Decoder, key: &Span, node: &Node<'_>) -> Option<MediumGiven> {
    const RGB: &str = "(red, green, blue)";
    let Shape::Struct(None, entries) = node.shape() else {
        decoder.wrong_type(node, "medium", "named coefficients", EXAMPLE);
        return None;
    };
    let head = head(None, node);
    let known = [REDUCED, FULL, "anisotropy", "absorption_per_mm", "refractive_index"];
    let fields = decoder.fields("`medium`", head.clone(), entries, &known);
    let mut triple = |name, quantity| fields.optional(name, |node| decoder.triple(node, name, RGB, quantity));
    let (reduced, full) = (triple(REDUCED, &SCATTERING), triple(FULL, &SCATTERING));
    let absorption = triple("absorption_per_mm", &ABSORPTION);
    let mut number =
        |name, quantity| fields.optional(name, |node| decoder.spanned_number(node, name, quantity));
    let anisotropy = number("anisotropy", &ANISOTROPY);
    let refractive_index = number("refractive_index", &REFRACTIVE_INDEX);
    let mut is_whole = true;
    for (is_missing, field, help) in [
        (
            reduced.is_absent() && full.is_absent(),
            REDUCED,
            "add `reduced_scattering_per_mm: (red, green, blue)`, σs′ per mm; or σs as `scattering_per_mm`, and the \
             mean cosine of its angle as `anisotropy`",
        ),
        (
            absorption.is_absent(),
            "absorption_per_mm",
            "add `absorption_per_mm: (red, green, blue)`, σa per mm; a `medium` replaces that of a base as a whole",
        ),
        (
            refractive_index.is_absent(),
            "refractive_index",
            "add `refractive_index: 1.4` for tissue, 1.33 for what is watery, 1.5 for stone; 1 for no boundary",
        ),
    ] {
        if is_missing {
            decoder.missing("`medium`", &head, field, help);
            is_whole = false;
        }
    }
    for (one, other, help) in [
        (REDUCED, FULL, "σs′ = (1 - g) σs: keep one of them"),
        (REDUCED, "anisotropy", "σs′ = (1 - g) σs holds it already: remove `anisotropy`, or give σs"),
    ] {
        if let (Some(first), Some(second)) = (fields.get(one), fields.get(other)) {
            decoder.report(
                Diagnostic::error("the scattering is given twice")
                    .label(second.key.span.clone(), "given here")
                    .secondary(first.key.span.clone(), "and here")
                    .help(help),
            );
            is_whole = false;
        }
    }
    let scattering = match (reduced, full) {
        (Given::Value(reduced), Given::Absent) => reduced,
        (Given::Absent, Given::Value(full)) => reduce(decoder, full, &anisotropy, &head)?,
        _ => return None,
    };
    let (absorption, index) = (absorption.value()?.clone(), refractive_index.value()?.clone());
    if anisotropy.is_bad() || !is_whole {
        return None;
    }
    let given =
        MediumGiven { key: key.clone(), reduced_scattering: scattering, absorption, refractive_index: index };
    if let Some(channel) = given.reduced_scattering.values.iter().position(|value| *value == 0.0) {
        decoder.report(
            Diagnostic::warning("a medium that does not scatter sends nothing back")
                .label(given.reduced_scattering.spans[channel].clone(), "no reduced scattering")
                .help("its surface albedo is 0, and what is thin lets light through like coloured glass"),
        );
    }
    let empty = (0..3).find(|&channel| !(1.0 / given.attenuation(channel)).is_finite());
    if let Some(channel) = empty {
        decoder.report(
            Diagnostic::error("the medium neither scatters nor absorbs")
                .label(given.absorption.spans[channel].clone(), "no absorption")
                .secondary(given.reduced_scattering.spans[channel].clone(), "and no scattering")
                .help("give at least one of them a value above 0"),
        );
        return None;
    }
    Some(given)
}

/// σs′ = (1 − g) σs.
fn reduce(
    decoder: &mut Decoder,
    full: Triple,
    anisotropy: &Given<Spanned<f64>>,
    head: &Span,
) -> Option<Triple> {
    match anisotropy {
        Given::Value(g) => Some(Triple { values: full.values.map(|value| (1.0 - g.value) * value), ..full }),
        Given::Bad => None,
        Given::Absent => {
            let help = "add `anisotropy: 0.8`, the mean cosine g of the scattering angle: σs′ = (1 - g) σs";
            decoder.missing("`medium`", head, "anisotropy", help);
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use subsurface_profile::single_scattering_albedo::LARGEST_REFRACTIVE_INDEX;

    #[test]
    fn every_index_that_a_file_may_give_has_an_albedo() {
        assert!(REFRACTIVE_INDEX.bounds.contain(LARGEST_REFRACTIVE_INDEX));
        assert!(!REFRACTIVE_INDEX.bounds.contain(LARGEST_REFRACTIVE_INDEX + 1e-9));
    }
}
