//! Why a model has no profile.

use thiserror::Error;

use crate::Channel;

/// Why coefficients describe no profile, or none for a certain medium.
///
/// Each variant names what is wrong and where, so that a caller can point at the place it came from.
/// `coefficient` is the path of a field from its model, such as `a.linear`, `shape.pivot`,
/// `terms[2].variance_mm2` or `dipole_depth[0]`.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ModelError {
    /// A coefficient is infinite or not a number.
    #[error("coefficient `{coefficient}` is not a finite number")]
    NotFinite {
        /// Path of the field from its model.
        coefficient: String,
    },
    /// A Gaussian sum has no term.
    #[error("a Gaussian sum needs at least one term")]
    NoTerms,
    /// A variance is zero or negative.
    #[error("variance of Gaussian {term} is {variance_mm2} mm², not above 0")]
    VarianceNotPositive {
        /// Index of the term, from 0.
        term: usize,
        /// The variance given, mm².
        variance_mm2: f64,
    },
    /// A Gaussian has a negative weight.
    #[error("{channel} weight of Gaussian {term} is negative: {weight}")]
    NegativeWeight {
        /// Index of the term, from 0.
        term: usize,
        /// The channel of the weight.
        channel: Channel,
        /// The weight given.
        weight: f64,
    },
    /// All weights of a channel are 0, so there is nothing to normalise.
    #[error("{channel} weights of the Gaussians sum to 0")]
    WeightsSumToZero {
        /// The channel without energy.
        channel: Channel,
    },
    /// The polynomial profile reaches 0 at r_max = -b/a ≤ 0, so there is no radius left to scatter in.
    #[error("maximum radius -b/a is {radius_mm} mm at surface albedo {surface_albedo}, not above 0")]
    NegativeMaximumRadius {
        /// -b/a in mm, zero or negative.
        radius_mm: f64,
        /// Surface albedo of the medium.
        surface_albedo: f64,
    },
    /// The polynomial profile never reaches 0: a = 0.
    #[error("the profile has no maximum radius at surface albedo {surface_albedo}: a = 0")]
    NoMaximumRadius {
        /// Surface albedo of the medium.
        surface_albedo: f64,
    },
    /// The profile is negative somewhere within its maximum radius.
    #[error("the profile is negative at radius {radius_mm} mm, surface albedo {surface_albedo}")]
    NegativeProfile {
        /// A radius in mm at which the profile is negative.
        radius_mm: f64,
        /// Surface albedo of the medium.
        surface_albedo: f64,
    },
    /// The polynomial profile has a pole at r = -c inside its range, so its energy is infinite.
    #[error(
        "c is {c_mm} mm at surface albedo {surface_albedo}, not above 0: the profile has a pole at r = -c"
    )]
    PoleNotNegative {
        /// The constant c in mm, zero or negative.
        c_mm: f64,
        /// Surface albedo of the medium.
        surface_albedo: f64,
    },
    /// Burley's s(A) is zero, negative, infinite or not a number, so d = length/s is no distance.
    #[error("shape s is {s} at surface albedo {surface_albedo}, not a finite number above 0")]
    ShapeNotPositive {
        /// Surface albedo of the medium.
        surface_albedo: f64,
        /// The value of s(A).
        s: f64,
    },
    /// The share w of the exponential is no number from 0 to 1.
    #[error("exponential weight w is {weight} at surface albedo {surface_albedo}, outside [0, 1]")]
    ExponentialWeightOutOfRange {
        /// Surface albedo of the medium.
        surface_albedo: f64,
        /// The value of w(A).
        weight: f64,
    },
    /// The decay length d of the exponential is no finite number above 0.
    #[error(
        "exponential length d is {length} at surface albedo {surface_albedo}, not a finite number above 0"
    )]
    ExponentialLengthNotPositive {
        /// Surface albedo of the medium.
        surface_albedo: f64,
        /// The value of d(A), in mean free paths.
        length: f64,
    },
    /// The depth z of the dipole is no finite number above 0.
    #[error("dipole depth z is {depth} at surface albedo {surface_albedo}, not a finite number above 0")]
    DipoleDepthNotPositive {
        /// Surface albedo of the medium.
        surface_albedo: f64,
        /// The value of z(A), in mean free paths.
        depth: f64,
    },
    /// The attenuation s of the dipole is negative or not finite.
    #[error(
        "dipole attenuation s is {attenuation} at surface albedo {surface_albedo}, not a finite number from 0"
    )]
    NegativeDipoleAttenuation {
        /// Surface albedo of the medium.
        surface_albedo: f64,
        /// The value of s(A), in inverse mean free paths.
        attenuation: f64,
    },
    /// A share is no number from 0 to 1.
    #[error("`{coefficient}` is {value}, outside [0, 1]")]
    ShareOutOfRange {
        /// Path of the field from its model.
        coefficient: &'static str,
        /// The value given.
        value: f64,
    },
    /// A ratio of two lengths is zero or negative.
    #[error("`{coefficient}` is {value}, not above 0")]
    RatioNotPositive {
        /// Path of the field from its model.
        coefficient: &'static str,
        /// The value given.
        value: f64,
    },
    /// Finite coefficients gave a quantity that is infinite, or too small to divide by.
    #[error("`{quantity}` is out of the range of numbers at surface albedo {surface_albedo}")]
    OutOfNumericRange {
        /// Symbol of the quantity in the model's equation.
        quantity: &'static str,
        /// Surface albedo of the medium.
        surface_albedo: f64,
    },
}

/// Adds a [`ModelError::NotFinite`] for each of `(path, value)` that is infinite or not a number.
pub(crate) fn require_finite<'a>(
    coefficients: impl IntoIterator<Item = (&'a str, f64)>,
    errors: &mut Vec<ModelError>,
) {
    errors.extend(
        coefficients
            .into_iter()
            .filter(|(_, value)| !value.is_finite())
            .map(|(path, _)| ModelError::NotFinite { coefficient: path.to_owned() }),
    );
}

/// An exponential's share of the energy is in [0, 1], and its decay length is positive.
pub(crate) fn require_exponential(surface_albedo: f64, weight: f64, length: f64) -> Result<(), ModelError> {
    if !(0.0..=1.0).contains(&weight) {
        return Err(ModelError::ExponentialWeightOutOfRange { surface_albedo, weight });
    }
    if !(length > 0.0 && length.is_finite()) {
        return Err(ModelError::ExponentialLengthNotPositive { surface_albedo, length });
    }
    Ok(())
}
