//! Numbers of the commands that the feature `analysis` brings.

use super::within;
use subsurface_reference::HalfSpace;

/// A surface albedo, in [0, 1].
pub(in crate::command) fn surface_albedo(text: &str) -> Result<f64, String> {
    within(text, "in [0, 1]", |value| (0.0..=1.0).contains(&value))
}

/// A length in mm, finite and above 0.
pub(in crate::command) fn mean_free_path_mm(text: &str) -> Result<f64, String> {
    within(text, "a finite number of millimetres above 0", |value| value > 0.0 && value.is_finite())
}

/// A radius in mm, finite and not negative.
pub(in crate::command) fn radius_mm(text: &str) -> Result<f64, String> {
    within(text, "a finite number of millimetres, 0 or more", |value| value >= 0.0 && value.is_finite())
}

/// A radius in mean free paths, finite and above 0.
pub(in crate::command) fn radius_above_0(text: &str) -> Result<f64, String> {
    within(text, "a finite number of mean free paths above 0", |value| value > 0.0 && value.is_finite())
}

/// A single-scattering albedo, in [0, 1].
pub(in crate::command) fn single_scattering_albedo(text: &str) -> Result<f64, String> {
    within(text, "in [0, 1]", |value| (0.0..=1.0).contains(&value))
}

/// A mean cosine of the scattering angle that can be simulated, in (-1, 0.999].
pub(in crate::command) fn anisotropy(text: &str) -> Result<f64, String> {
    within(text, "in (-1, 0.999]", |value| value > -1.0 && value <= HalfSpace::MAXIMUM_ANISOTROPY)
}

/// A relative standard error, in (0, 1).
pub(in crate::command) fn standard_error(text: &str) -> Result<f64, String> {
    within(text, "between 0 and 1, for example 0.001 for a tenth of a percent", |value| {
        value > 0.0 && value < 1.0
    })
}

/// A number of photons: digits, or a number such as 1e6.
pub(in crate::command) fn photons(text: &str) -> Result<u64, String> {
    const RANGE: &str = "a whole number from 1 to 1e15, for example 1000000 or 1e6";
    let value = match text.trim().parse::<u64>() {
        Ok(value) => value as f64,
        Err(_) => text.trim().parse::<f64>().map_err(|_| "not a number".to_owned())?,
    };
    // Whole numbers up to 1e15 are exact in f64.
    if (1.0..=1e15).contains(&value) && value.fract() == 0.0 {
        Ok(value as u64)
    } else {
        Err(format!("must be {RANGE}"))
    }
}

/// A number of threads.
pub(in crate::command) fn threads(text: &str) -> Result<usize, String> {
    match text.trim().parse() {
        Ok(threads @ 1..=1024) => Ok(threads),
        _ => Err("must be a whole number from 1 to 1024".into()),
    }
}

/// A fraction of the energy, in [0, 1).
pub(in crate::command) fn fraction(text: &str) -> Result<f64, String> {
    within(text, "in [0, 1)", |value| (0.0..1.0).contains(&value))
}

/// A footprint in pixels.
pub(in crate::command) fn footprint_pixels(text: &str) -> Result<f64, String> {
    // Below a hundredth nothing moves; above a hundred the dense kernel would not end.
    within(text, "between 0.01 and 100 pixels", |value| (0.01..=100.0).contains(&value))
}

/// An irradiance that counts as white.
pub(in crate::command) fn white(text: &str) -> Result<f64, String> {
    within(text, "a finite number above 0", |value| value > 0.0 && value.is_finite())
}
