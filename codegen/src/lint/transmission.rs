//! Transmission that adds light.

use crate::diagnostics::Diagnostic;
use crate::draft::Draft;
use crate::schema::rounded;

/// Up to here the factor is taste; beyond, thin parts outshine the light behind them.
const STRONGEST: f64 = 4.0;

pub(super) fn check(material: &Draft<'_>, diagnostics: &mut Vec<Diagnostic>) {
    if let Some(strength) = material.transmission_strength.filter(|strength| strength.value > STRONGEST) {
        diagnostics.push(
            Diagnostic::warning(format!("a transmission strength of {} adds light", rounded(strength.value)))
                .label(strength.span.clone(), format!("expected at most {STRONGEST}"))
                .help("1 is the transmittance of the material; to let more light through, make the mean free path longer"),
        );
    }
}
