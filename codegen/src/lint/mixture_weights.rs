//! Weights of a mixture's parts that do not sum to 1.

use subsurface_profile::description::Contents;

use crate::diagnostics::Diagnostic;
use crate::draft::Draft;
use crate::schema::rounded;

/// Weights are written with three decimals, so a sum may miss by one unit of the last.
const TOLERANCE: f64 = 0.001;

/// Weights are shares of the reflected light. Another sum is normalised away, but is more likely a typing error.
pub(super) fn check(material: &Draft<'_>, diagnostics: &mut Vec<Diagnostic>) {
    let Contents::Parts(mixture) = material.profile.model.contents() else { return };
    let sum: f64 = mixture.parts.iter().map(|part| part.weight).sum();
    if (sum - 1.0).abs() <= TOLERANCE + 1e-9 {
        return; // the slack covers the rounding of the sum
    }
    let sum = rounded(sum);
    let mut diagnostic = Diagnostic::warning("the weights of the parts do not sum to 1")
        .label(material.profile.span.clone(), format!("the weights sum to {sum}"))
        .help(format!(
            "weights are divided by their sum, so nothing is lost if only their ratios count; else divide them by {sum}"
        ));
    if let Some(span) = material.profile_name {
        let label = format!("used by material `{}`", material.name);
        diagnostic = diagnostic.secondary(span.clone(), label);
    }
    diagnostics.push(diagnostic);
}
