// uses: lib/vogel_disc

/// Taps of the shadow filter.
const SHADOW_TAPS: u32 = 16u;

/// Fraction of the light that reaches a point: `coordinate` is its position in the shadow map (x, y in [0, 1], depth),
/// `layer` the light's layer, `radius` the filter's radius in texture coordinates.
///
/// Percentage-closer filtering, Reeves et al. 1987. Points outside the map are lit.
fn shadow_visibility(
    maps: texture_depth_2d_array,
    comparison: sampler_comparison,
    coordinate: vec3f,
    layer: u32,
    radius: f32,
) -> f32 {
    if any(coordinate < vec3f(0.0)) || any(coordinate > vec3f(1.0)) {
        return 1.0;
    }
    var lit = 0.0;
    for (var tap = 0u; tap < SHADOW_TAPS; tap += 1u) {
        let offset = radius * vogel_disc(tap, SHADOW_TAPS);
        lit += textureSampleCompareLevel(maps, comparison, coordinate.xy + offset, layer, coordinate.z);
    }
    return lit / f32(SHADOW_TAPS);
}
