//! Numbers in arguments, with their ranges: a value out of range is a usage error.

/// A surface albedo, in [0, 1].
pub(super) fn surface_albedo(text: &str) -> Result<f64, String> {
    within(text, "in [0, 1]", |value| (0.0..=1.0).contains(&value))
}

/// A length in mm, finite and above 0.
pub(super) fn length_mm(text: &str) -> Result<f64, String> {
    within(text, "a finite number of millimetres above 0", |value| value > 0.0 && value.is_finite())
}

/// A radius in mm, finite and not negative.
pub(super) fn radius_mm(text: &str) -> Result<f64, String> {
    within(text, "a finite number of millimetres, 0 or more", |value| value >= 0.0 && value.is_finite())
}

/// A fraction of the energy, in [0, 1).
pub(super) fn fraction(text: &str) -> Result<f64, String> {
    within(text, "in [0, 1)", |value| (0.0..1.0).contains(&value))
}

/// A vertical field of view in degrees.
pub(super) fn fov_y_degrees(text: &str) -> Result<f32, String> {
    within(text, "between 1 and 170 degrees", |value| (1.0..=170.0).contains(&value))
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
