//! Light of lit half planes and of lit lines, by a quadrature that is quick rather than exact to ten digits.

use std::f64::consts::PI;

use subsurface_profile::RadialProfile;

/// Step of the trapezoidal rule.
///
/// Both integrands are even and analytic in t, so the rule converges exponentially: at this step the sum differs from
/// `EdgeSpread`, which is good to 1e-10, by less than 1e-6.
const STEP: f64 = 0.25;

/// Largest t: cosh t = 2.7e6, more than a profile spans.
const STEPS: u32 = 62;

/// ∫ f(cosh t) dt from 0 to ∞.
fn over_cosh(f: impl Fn(f64) -> f64) -> f64 {
    let mut sum = 0.5 * f(1.0);
    for step in 1..=STEPS {
        let term = f((STEP * f64::from(step)).cosh());
        sum += term;
        if term <= 1e-9 * sum {
            break;
        }
    }
    STEP * sum
}

/// Fraction of the light that lands beyond a line at `distance` ≥ 0 from where it entered.
///
/// (1/π) ∫ radial_tail(X/sin φ) dφ over (0, π/2), see `EdgeSpread`, with 1/sin φ = cosh t.
pub(crate) fn beyond_line(profile: &dyn RadialProfile, distance: f64) -> f64 {
    if distance <= 0.0 {
        return 0.5;
    }
    over_cosh(|cosh| profile.radial_tail(distance * cosh) / cosh) / PI
}

/// Fraction of the light that lands on the lit side of an edge, at the signed `distance` from it.
pub(crate) fn edge_spread(profile: &dyn RadialProfile, distance: f64) -> f64 {
    let beyond = beyond_line(profile, distance.abs());
    if distance >= 0.0 { 1.0 - beyond } else { beyond }
}

/// Light per unit length beside a line, at `distance` > 0: the derivative of `edge_spread`.
///
/// ∫ radial_pdf(r) / (π √(r² - X²)) dr over r > X, with r = X cosh t.
pub(crate) fn line_spread(profile: &dyn RadialProfile, distance: f64) -> f64 {
    over_cosh(|cosh| profile.radial_pdf(distance * cosh)) / PI
}
