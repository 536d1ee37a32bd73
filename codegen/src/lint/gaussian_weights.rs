//! Weights of Gaussians that sum neither to 1 nor to the surface albedo.

use subsurface_profile::description::Contents;
use subsurface_profile::{Channel, GaussianTerm};

use crate::diagnostics::Diagnostic;
use crate::draft::Draft;
use crate::schema::rounded;

/// Published weights are rounded to three decimals, so a sum may miss by one unit of the last.
const TOLERANCE: f64 = 0.001;

/// Weights are shares of the reflected light: they sum to 1, or to the surface albedo when that is already applied.
/// Any other sum is normalised away as well, but is more likely a typing error.
pub(super) fn check(material: &Draft<'_>, diagnostics: &mut Vec<Diagnostic>) {
    for (_, model) in material.profile.model.leaves() {
        if let Contents::Terms(terms) = model.contents() {
            check_terms(material, terms, diagnostics);
        }
    }
}

fn check_terms(material: &Draft<'_>, terms: &[GaussianTerm], diagnostics: &mut Vec<Diagnostic>) {
    let is_near = |a: f64, b: f64| (a - b).abs() <= TOLERANCE + 1e-9; // the slack covers the rounding of the sum
    let suspect: Vec<(Channel, f64, f64)> = Channel::ALL
        .into_iter()
        .map(|channel| {
            let index = channel.index();
            let sum = terms.iter().map(|term| term.weight[index]).sum();
            (channel, sum, material.surface_albedo.values[index])
        })
        .filter(|&(_, sum, surface_albedo)| !is_near(sum, 1.0) && !is_near(sum, surface_albedo))
        .collect();
    if suspect.is_empty() {
        return;
    }
    let sums: Vec<String> =
        suspect.iter().map(|(channel, sum, _)| format!("{} in {channel}", rounded(*sum))).collect();
    let factors: Vec<String> = suspect.iter().map(|(_, sum, _)| rounded(*sum)).collect();
    let surface_albedos: Vec<String> =
        suspect.iter().map(|(_, _, surface_albedo)| rounded(*surface_albedo)).collect();
    let mut diagnostic = Diagnostic::warning("the weights of the Gaussians do not sum to the surface albedo")
        .label(
            material.profile.span.clone(),
            format!("the weights sum to {}, not to 1 and not to {}", sums.join(", "), surface_albedos.join(", ")),
        )
        .help(format!("weights are divided by their sum, so nothing is lost if only their ratios count; else divide them by {}", factors.join(", ")));
    if let Some(span) = material.profile_name {
        let label = format!("used by material `{}`", material.name);
        diagnostic = diagnostic.secondary(span.clone(), label);
    }
    diagnostics.push(diagnostic.secondary(material.surface_albedo.span.clone(), "the surface albedo"));
}
