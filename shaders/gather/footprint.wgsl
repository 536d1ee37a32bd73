// uses: gather/point, kernel/constants, lib/angle

/// Taps for a point: a quarter of the pixels within its filter radius, up to the budget, as in Golubev 2018, "Efficient
/// Screen-Space Subsurface Scattering Using Burley's Normalized Diffusion in Real-Time". A filter of less than a pixel
/// needs none.
fn footprint_taps(point: SurfacePoint, budget: u32) -> u32 {
    if point.filter_radius_pixels < 1.0 {
        return 0u;
    }
    let radius = min(point.filter_radius_pixels, LARGEST_FILTER_RADIUS);
    return min(u32(ceil(0.125 * TAU * radius * radius)), min(budget, LARGEST_TAP_COUNT));
}

/// Share of the diffused irradiance in the result: it comes in while the filter radius grows from one pixel to two, so
/// that nothing pops when a surface comes near.
fn footprint_blend(point: SurfacePoint) -> f32 {
    return clamp(point.filter_radius_pixels - 1.0, 0.0, 1.0);
}
