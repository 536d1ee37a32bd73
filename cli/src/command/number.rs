//! Numbers in arguments, with their ranges: a value out of range is a usage error.

#[cfg(feature = "analysis")]
mod analysis;

#[cfg(feature = "analysis")]
pub(super) use analysis::{
    anisotropy, footprint_pixels, fraction, mean_free_path_mm, photons, radius_above_0, radius_mm,
    single_scattering_albedo, standard_error, surface_albedo, threads, white,
};

/// A vertical field of view in degrees.
pub(super) fn fov_y_degrees(text: &str) -> Result<f32, String> {
    within(text, "between 1 and 170 degrees", |value| (1.0..=170.0).contains(&value))
        .map(|value| value as f32)
}

/// How bright a light is: 1 lights white up to white.
pub(super) fn intensity(text: &str) -> Result<f32, String> {
    within(text, "between 0 and 1e6", |value| (0.0..=1e6).contains(&value)).map(|value| value as f32)
}

/// A factor on a picture's light.
#[cfg(feature = "analysis")]
pub(super) fn exposure(text: &str) -> Result<f32, String> {
    within(text, "above 0, and at most 1e6", |value| value > 0.0 && value <= 1e6).map(|value| value as f32)
}

/// A factor on the mean free path, or a thickness in mm.
pub(super) fn detail(text: &str) -> Result<f32, String> {
    within(text, "between 0.001 and 1000", |value| (1e-3..=1e3).contains(&value)).map(|value| value as f32)
}

/// A power of the surface albedo.
pub(super) fn albedo_mix(text: &str) -> Result<f32, String> {
    within(text, "between 0 and 1", |value| (0.0..=1.0).contains(&value)).map(|value| value as f32)
}

/// An angle in degrees.
pub(super) fn turn_degrees(text: &str) -> Result<f32, String> {
    within(text, "between -360 and 360 degrees", |value| (-360.0..=360.0).contains(&value))
        .map(|value| value as f32)
}

/// A length in mm that a shader can hold.
pub(super) fn pixel_mm(text: &str) -> Result<f32, String> {
    // Outside this range a square underflows or overflows in f32.
    within(text, "between 1e-9 and 1e9 millimetres", |value| (1e-9..=1e9).contains(&value))
        .map(|value| value as f32)
}

fn within(text: &str, range: &str, holds: impl Fn(f64) -> bool) -> Result<f64, String> {
    let value: f64 = text.trim().parse().map_err(|_| "not a number".to_owned())?;
    if holds(value) { Ok(value) } else { Err(format!("must be {range}")) }
}
