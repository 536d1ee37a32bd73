//! Angles: the twin of `shaders/lib/angle.wgsl`.

/// `direction` turned by an angle (cos, sin).
pub(crate) fn turned([x, y]: [f64; 2], [cos, sin]: [f64; 2]) -> [f64; 2] {
    [x * cos - y * sin, x * sin + y * cos]
}
