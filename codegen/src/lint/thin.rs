//! What a sheet does not do.

use crate::diagnostics::Diagnostic;
use crate::draft::Draft;

pub(super) fn check(material: &Draft<'_>, diagnostics: &mut Vec<Diagnostic>) {
    let Some(thin) = material.thin_thickness_mm else { return };
    if let Some(mix) = material.surface_albedo_mix.filter(|mix| mix.value > 0.0) {
        diagnostics.push(
            Diagnostic::warning("nothing diffuses in a sheet, and the surface albedo is not split")
                .label(mix.span.clone(), "does nothing")
                .secondary(thin.span.clone(), "the sheet is given here")
                .help("remove `surface_albedo_mix`, or remove `thin`"),
        );
    }
    if material.transmission_diffused {
        diagnostics.push(
            Diagnostic::warning("what comes through a sheet does not diffuse")
                .label(thin.span.clone(), "`transmission: (diffused: true)` does nothing here")
                .help("remove `diffused: true`, or remove `thin`"),
        );
    }
}
