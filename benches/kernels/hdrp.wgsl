// [G18] Golubev 2018, "Efficient Screen-Space Subsurface Scattering Using Burley's Normalized Diffusion in Real-Time",
// SIGGRAPH Advances in Real-Time Rendering: a disc sampled by importance, radii by the exact inverse at the centres of
// equal strata, directions by the golden angle, one static rotation per pixel; weights R(√(r² + Δz²)) / p(r),
// normalised per channel. As many taps as a quarter of the pixels in the disc, up to a budget.

fn gather(pixel: vec2i, own: vec4f, distance_mm: f32) -> vec3f {
    let d = settings.scattering_distance_mm;
    let widest = max(d.x, max(d.y, d.z));
    let scale = pixel_mm(distance_mm);
    let reach_pixels = settings.reach_mm / scale;
    // A filter within the pixel leaves it as it is.
    if reach_pixels < 1.0 {
        return own.rgb;
    }
    let count = clamp(u32(0.25 * PI * reach_pixels * reach_pixels), 1u, settings.taps);
    let turn = pixel_angle(pixel);
    var light = vec3f(0.0);
    var weights = vec3f(0.0);
    for (var tap = 0u; tap < count; tap += 1u) {
        let radius_mm = widest * burley_quantile((f32(tap) + 0.5) / f32(count));
        let angle = turn + GOLDEN_ANGLE * f32(tap);
        let position = pixel + vec2i(round(radius_mm / scale * vec2f(cos(angle), sin(angle))));
        let there_mm = tap_distance_mm(position);
        if there_mm == 0.0 {
            continue;
        }
        let rise = there_mm - distance_mm;
        let path_mm = sqrt(radius_mm * radius_mm + rise * rise);
        // R(path) / p(radius): the factor 8π r of `burley` leaves the ratio of the radii behind.
        let weight = burley(path_mm, d) / burley(radius_mm, vec3f(widest)) * (radius_mm / path_mm);
        light += weight * textureLoad(irradiance_texture, position, 0).rgb;
        weights += weight;
    }
    return select(own.rgb, light / weights, weights > vec3f(0.0));
}
