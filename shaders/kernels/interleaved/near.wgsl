// uses: gather/{channel, point}, kernel/constants

// The light that stays within a pixel and its eight neighbours.

/// Shares of a profile's light that a pixel and each pixel of the ring around it have on a flat surface.
struct NearField {
    /// Of the pixel itself.
    centre: vec3f,
    /// Of each pixel beside it.
    beside: vec3f,
    /// Of each pixel across its corners.
    across: vec3f,
}

/// The near field of a point.
///
/// The ring's energy is exact. How it falls on beside and across follows from the power law R ∝ r^-s that has the same
/// energy in both discs: their radii are as 1 : 3, so E₃/E₁ = 3^(2 − s), and R(√2)/R(1) = 2^(−s/2).
fn near_field(point: SurfacePoint) -> NearField {
    let centre = channel_radial_cdf(point.profiles, NEAR_RADIUS_PIXELS * point.pixel_mm);
    let inside = channel_radial_cdf(point.profiles, FAR_RADIUS_PIXELS * point.pixel_mm);
    let growth = inside / max(centre, vec3f(SMALLEST_WEIGHT));
    let across = 0.5 * pow(growth, vec3f(HALF_LOG_3_OF_2));
    let beside = (inside - centre) / (4.0 + 4.0 * across);
    return NearField(centre, beside, beside * across);
}
