//! Surface albedos that no measured material has.

use crate::diagnostics::Diagnostic;
use crate::draft::Draft;

/// Warns of a surface albedo of exactly 1: nothing is absorbed, the profile falls only as r⁻³ and its mean radius is
/// infinite. 0 is not warned of: a black channel of a saturated colour is common, and harmless.
pub(super) fn check(material: &Draft<'_>, diagnostics: &mut Vec<Diagnostic>) {
    let surface_albedo = &material.surface_albedo;
    for (value, span) in surface_albedo.values.into_iter().zip(&surface_albedo.spans) {
        if value >= 1.0 {
            diagnostics.push(
                Diagnostic::warning("a surface albedo of 1 absorbs nothing")
                    .label(span.clone(), "light spreads without limit")
                    .help("the whitest materials measured have 0.99; give 0.99 unless this is a test"),
            );
        }
    }
}
