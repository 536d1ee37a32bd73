// uses: gather/{channel, point}, kernel/constants

// The light that stays within a pixel and its eight neighbours.

/// Shares of a profile's light on a flat surface.
struct NearField {
    /// Of the pixel itself.
    centre: vec3f,
    /// Of the ring of pixels around it.
    ring: vec3f,
}

/// The near field of a point: discs with the area of a pixel and of nine.
fn near_field(point: SurfacePoint) -> NearField {
    let centre = channel_radial_cdf(point.profiles, NEAR_RADIUS_PIXELS * point.pixel_mm);
    let inside = channel_radial_cdf(point.profiles, RING_RADIUS_PIXELS * point.pixel_mm);
    return NearField(centre, inside - centre);
}

/// Shares of a pixel and of those around it.
struct PixelShares {
    /// Of the pixel itself.
    centre: vec3f,
    /// Of each pixel beside it.
    beside: vec3f,
    /// Of each pixel across its corners.
    across: vec3f,
}

/// How the ring falls on beside and across: by the power law R ∝ r^-s that has the same energy in both discs. Their
/// radii are as 1 : 3, so E₃/E₁ = 3^(2 − s), and R(√2)/R(1) = 2^(−s/2).
fn pixel_shares(near: NearField) -> PixelShares {
    let growth = (near.centre + near.ring) / max(near.centre, vec3f(SMALLEST_WEIGHT));
    let across = 0.5 * pow(growth, vec3f(HALF_LOG_3_OF_2));
    let beside = near.ring / (4.0 + 4.0 * across);
    return PixelShares(near.centre, beside, beside * across);
}
