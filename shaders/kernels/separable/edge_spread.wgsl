// uses: gather/{curve, material, profile}, kernel/constants

/// Fraction of the light beyond a line `offset_mm` from an edge, per channel, which is 1 − F.
fn beyond_line(surface: MaterialSurface, profiles: ChannelProfiles, offset_mm: f32) -> vec3f {
    return vec3f(
        curve_beyond_line(surface, profiles.red.curve, offset_mm),
        curve_beyond_line(surface, profiles.green.curve, offset_mm),
        curve_beyond_line(surface, profiles.blue.curve, offset_mm),
    );
}

/// The same for one channel: a row of the edge curves holds F at even steps of the fourth root of the offset.
fn curve_beyond_line(surface: MaterialSurface, curve: Curve, offset_mm: f32) -> f32 {
    let reach_mm = surface.edge_reach * curve.mean_free_path_mm;
    // What little is left where the curve ends is no light: a share of it would be whole.
    if offset_mm >= reach_mm {
        return 0.0;
    }
    let place = sqrt(sqrt(clamp(offset_mm / reach_mm, 0.0, 1.0))) * f32(CURVE_STEPS);
    let step = min(floor(place), f32(CURVE_STEPS) - 1.0);
    let row = curve.row - i32(surface.first_curve) + i32(surface.first_edge);
    let texel = curve_texel(row, i32(step));
    let start_and_rise = mix(texel.xy, texel.zw, curve.upper);
    return max(1.0 - start_and_rise.x - start_and_rise.y * (place - step), 0.0);
}

/// Share of a strip's light that is left of it where the surface lies `depth_mm` deeper or higher: what lies beyond the
/// strip's middle is taken at its distance in space.
fn line_share(
    surface: MaterialSurface,
    profiles: ChannelProfiles,
    beyond: vec3f,
    offset_mm: f32,
    depth_mm: f32,
) -> vec3f {
    let path_mm = sqrt(offset_mm * offset_mm + depth_mm * depth_mm);
    let left = beyond_line(surface, profiles, path_mm);
    return clamp(left / max(beyond, vec3f(SMALLEST_WEIGHT)), vec3f(0.0), vec3f(1.0));
}
