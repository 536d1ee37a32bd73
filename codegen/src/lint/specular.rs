//! Specular values outside what translucent materials have.

use crate::diagnostics::Diagnostic;
use crate::draft::Draft;
use crate::schema::{reflectance_at_normal, rounded};

/// Below this the highlight of a light is narrower than a pixel and flickers.
const SMOOTHEST: f64 = 0.02;
/// F0 of diamond is 0.17; above 0.2 only metals follow, and no light enters those.
const MOST_REFLECTING: f64 = 0.2;
/// What rounding to three digits may move F0 by.
const MOST_APART: f64 = 5e-3;

pub(super) fn check(material: &Draft<'_>, diagnostics: &mut Vec<Diagnostic>) {
    if let Some(roughness) = material.roughness.filter(|roughness| roughness.value < SMOOTHEST) {
        diagnostics.push(
            Diagnostic::warning(format!(
                "a roughness of {} is smoother than a pixel can show",
                rounded(roughness.value)
            ))
            .label(roughness.span.clone(), format!("expected at least {SMOOTHEST}"))
            .help("highlights of a point light flicker or vanish; give 0.05 for a wet surface"),
        );
    }
    if let (Some(given), Some(index)) = (material.reflectance_at_normal, material.refractive_index) {
        let expected = reflectance_at_normal(index.value);
        if (given.value - expected).abs() > MOST_APART {
            diagnostics.push(
                Diagnostic::warning(
                    "the reflectance at normal incidence is not that of the refractive index",
                )
                .label(given.span.clone(), format!("expected {}", rounded(expected)))
                .secondary(index.span.clone(), "the index is given here")
                .help("remove it: F0 = ((n - 1)/(n + 1))² follows from the index"),
            );
        }
    }
    if let Some(reflectance) = material.reflectance_at_normal.filter(|f0| f0.value > MOST_REFLECTING) {
        diagnostics.push(
            Diagnostic::warning(format!(
                "a reflectance of {} belongs to a metal",
                rounded(reflectance.value)
            ))
            .label(reflectance.span.clone(), format!("expected at most {MOST_REFLECTING}"))
            .help(
                "F0 = ((n - 1)/(n + 1))²: 0.02 for water, 0.028 for skin, 0.04 for n = 1.5, 0.17 for diamond",
            ),
        );
    }
}
