//! One channel of a scattering medium.

use thiserror::Error;

/// One channel of a scattering medium: how much its surface reflects, and how far light travels in it.
///
/// The values are checked once, here, so that no profile has to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Medium {
    surface_albedo: f64,
    mean_free_path_mm: f64,
}

impl Medium {
    /// A medium of surface albedo A in [0, 1], both ends included, and a finite length > 0 in mm.
    ///
    /// Which length `mean_free_path_mm` is, is for the model to say: [`Model::length`](crate::Model::length).
    /// All laws of this crate are tested for lengths from 1e-4 mm to 1e4 mm.
    pub fn new(surface_albedo: f64, mean_free_path_mm: f64) -> Result<Medium, MediumError> {
        if !(0.0..=1.0).contains(&surface_albedo) {
            return Err(MediumError::SurfaceAlbedoOutOfRange { surface_albedo });
        }
        if !(mean_free_path_mm > 0.0 && mean_free_path_mm.is_finite()) {
            return Err(MediumError::LengthNotPositive { mean_free_path_mm });
        }
        // The sum turns -0.0, which the range admits, into 0.0.
        Ok(Medium { surface_albedo: surface_albedo + 0.0, mean_free_path_mm })
    }

    /// Surface albedo A, the total diffuse reflectance, in [0, 1].
    pub fn surface_albedo(&self) -> f64 {
        self.surface_albedo
    }

    /// Mean free path or diffuse mean free path in mm, finite and > 0.
    pub fn mean_free_path_mm(&self) -> f64 {
        self.mean_free_path_mm
    }
}

/// Why a [`Medium`] does not exist.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum MediumError {
    /// The surface albedo is not a number from 0 to 1.
    #[error("surface albedo {surface_albedo} is outside [0, 1]")]
    SurfaceAlbedoOutOfRange {
        /// The value given.
        surface_albedo: f64,
    },
    /// The length is zero, negative, infinite or not a number.
    #[error("length {mean_free_path_mm} mm is not a finite number above 0")]
    LengthNotPositive {
        /// The value given, mm.
        mean_free_path_mm: f64,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_ends_of_the_surface_albedo_are_legal() {
        assert!(Medium::new(0.0, 1.0).is_ok());
        assert!(Medium::new(1.0, 1.0).is_ok());
    }

    #[test]
    fn what_is_no_albedo_or_no_length_is_refused() {
        for surface_albedo in [-1e-300, 1.0 + f64::EPSILON, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(matches!(
                Medium::new(surface_albedo, 1.0),
                Err(MediumError::SurfaceAlbedoOutOfRange { .. })
            ));
        }
        for mean_free_path_mm in [0.0, -0.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(matches!(
                Medium::new(0.5, mean_free_path_mm),
                Err(MediumError::LengthNotPositive { .. })
            ));
        }
    }

    #[test]
    fn negative_zero_becomes_zero() {
        assert!(Medium::new(-0.0, 1.0).is_ok_and(|medium| medium.surface_albedo().is_sign_positive()));
    }
}
