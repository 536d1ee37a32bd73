//! What a file's author reads when the coefficients of a model give no profile.

use std::collections::BTreeMap;

use subsurface_profile::ModelError;

use crate::diagnostics::Diagnostic;
use crate::schema::quantity::COEFFICIENT;
use crate::schema::rounded::rounded;
use crate::source::Span;

/// The error of a model, at the coefficients that are to blame; `head` is the model's name.
pub(super) fn describe(error: &ModelError, head: &Span, spans: &BTreeMap<String, Span>) -> Diagnostic {
    // Numbers are rounded: the last digits of e^x differ between systems, and a message must not.
    let at = |surface_albedo: &f64| format!("at surface albedo {}", rounded(*surface_albedo));
    let (path, message, label, help): (&str, String, &str, &str) = match error {
        ModelError::NotFinite { coefficient } => {
            (coefficient, error.to_string(), "not a finite number", COEFFICIENT.meaning)
        }
        ModelError::WeightsSumToZero { channel } => (
            "",
            format!("{channel} weights of the Gaussians sum to 0"),
            "all weights of this channel are 0",
            "give one Gaussian a weight above 0 in each channel; for a black channel set `surface_albedo` to 0",
        ),
        ModelError::NegativeMaximumRadius { radius_mm, surface_albedo } => (
            "a",
            format!("the maximum radius is {} mean free paths {}", rounded(*radius_mm), at(surface_albedo)),
            "r_max = -b/a must be above 0",
            "a = (linear α + amplitude 10^(decades (α - 1)))/ℓ must be negative: Liang et al. have `linear: -0.0064`",
        ),
        ModelError::NoMaximumRadius { surface_albedo } => (
            "a",
            format!("the profile has no maximum radius {}", at(surface_albedo)),
            "a = 0 here, so the profile never falls to 0",
            "a = (linear α + amplitude 10^(decades (α - 1)))/ℓ must be negative: Liang et al. have `linear: -0.0064`",
        ),
        ModelError::NegativeProfile { surface_albedo, .. } => (
            "b",
            format!("the profile is negative {}", at(surface_albedo)),
            "b/c is the profile's value at the origin, so b must be above 0",
            "b = scale α^(…): give `scale` a value above 0; Liang et al., corrected, have 0.0635",
        ),
        ModelError::PoleNotNegative { c_mm, surface_albedo } => (
            "c",
            format!("c is {} mean free paths {}", rounded(*c_mm), at(surface_albedo)),
            "c must be above 0: the profile has a pole at r = -c",
            "c = (amplitude e^(rate α) + offset) ℓ: make `offset` larger; Liang et al. have 0.166",
        ),
        ModelError::ShapeNotPositive { s, surface_albedo } => (
            "shape",
            format!("Burley's s is {} {}", rounded(*s), at(surface_albedo)),
            "s(A) must be above 0",
            "s(A) = constant + slope A + amplitude |A - pivot|^exponent: make `constant` larger",
        ),
        ModelError::ExponentialWeightOutOfRange { weight, surface_albedo } => (
            "exponential_weight",
            format!("the exponential's weight is {} {}", rounded(*weight), at(surface_albedo)),
            "w(A) must be from 0 to 1",
            "the polynomial `exponential_weight` must stay within [0, 1] for all A in [0, 1]",
        ),
        ModelError::ExponentialLengthNotPositive { length, surface_albedo } => (
            "exponential_length",
            format!("the exponential's length is {} {}", rounded(*length), at(surface_albedo)),
            "d(A) must be above 0",
            "the polynomial `exponential_length` must stay above 0 for all A in [0, 1]",
        ),
        ModelError::ShareOutOfRange { coefficient, value } => (
            coefficient,
            format!("`{coefficient}` is {}", rounded(*value)),
            "expected a share from 0 to 1",
            "it divides light between two parts: 0 gives all to the first, 1 all to the second",
        ),
        ModelError::RatioNotPositive { coefficient, value } => (
            coefficient,
            format!("`{coefficient}` is {}", rounded(*value)),
            "expected a ratio above 0",
            "it is a length in multiples of another: 1 makes both equal",
        ),
        ModelError::DipoleDepthNotPositive { depth, surface_albedo } => (
            "dipole_depth",
            format!("the dipole's depth is {} {}", rounded(*depth), at(surface_albedo)),
            "z(A) must be above 0",
            "the polynomial `dipole_depth` must stay above 0 for all A in [0, 1]",
        ),
        ModelError::NegativeDipoleAttenuation { attenuation, surface_albedo } => (
            "dipole_attenuation",
            format!("the dipole's attenuation is {} {}", rounded(*attenuation), at(surface_albedo)),
            "s(A) must be 0 or more",
            "the polynomial `dipole_attenuation` must not be negative for any A in [0, 1]",
        ),
        _ => (
            "",
            error.to_string(),
            "this model has no profile",
            "compare with a published set of coefficients",
        ),
    };
    let span = spans.get(path).unwrap_or(head).clone();
    let diagnostic = Diagnostic::error(message).label(span, label).help(help);
    let of_coefficients_alone = matches!(
        error,
        ModelError::NotFinite { .. }
            | ModelError::NoTerms
            | ModelError::VarianceNotPositive { .. }
            | ModelError::NegativeWeight { .. }
            | ModelError::WeightsSumToZero { .. }
            | ModelError::ShareOutOfRange { .. }
            | ModelError::RatioNotPositive { .. }
    );
    if of_coefficients_alone {
        diagnostic
    } else {
        diagnostic.help(
            "a texture may set the surface albedo of a pixel: a model needs a profile for all of [0, 1]",
        )
    }
}
