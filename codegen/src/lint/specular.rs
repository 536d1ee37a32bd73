//! Specular values outside what translucent materials have.

use crate::diagnostics::Diagnostic;
use crate::draft::Draft;
use crate::schema::rounded;

/// Below this the highlight of a light is narrower than a pixel and flickers.
const SMOOTHEST: f64 = 0.02;
/// F0 of diamond is 0.17; above 0.2 only metals follow, and no light enters those.
const MOST_REFLECTING: f64 = 0.2;

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
