// uses: gather/{curve, material, profile}, kernel/constants

/// The edge spread F of a point's three profiles: rows of the edge curves, which hold F at even steps of the fourth
/// root of the offset.
struct EdgeSpread {
    /// Row of the lower curve, per channel.
    rows: vec3i,
    /// Fraction of the upper one.
    upper: vec3f,
    /// Steps of a curve by the fourth root of the offset in mm.
    steps: vec3f,
}

/// That of `profiles`.
fn edge_spread_of(surface: MaterialSurface, profiles: ChannelProfiles) -> EdgeSpread {
    let red = profiles.red.curve;
    let green = profiles.green.curve;
    let blue = profiles.blue.curve;
    let lengths_mm = vec3f(red.mean_free_path_mm, green.mean_free_path_mm, blue.mean_free_path_mm);
    return EdgeSpread(
        vec3i(red.row, green.row, blue.row) + i32(surface.first_edge) - i32(surface.first_curve),
        vec3f(red.upper, green.upper, blue.upper),
        f32(CURVE_STEPS) / sqrt(sqrt(surface.edge_reach * lengths_mm)),
    );
}

/// Fraction of the light beyond a line `offset_mm` from where it enters, per channel, which is 1 − F.
fn beyond_line(spread: EdgeSpread, offset_mm: f32) -> vec3f {
    let places = sqrt(sqrt(offset_mm)) * spread.steps;
    return vec3f(
        curve_beyond(spread.rows.r, spread.upper.r, places.r),
        curve_beyond(spread.rows.g, spread.upper.g, places.g),
        curve_beyond(spread.rows.b, spread.upper.b, places.b),
    );
}

/// The same for one channel, at a place of its curve in steps.
fn curve_beyond(row: i32, upper: f32, place: f32) -> f32 {
    // A weight is a share of what is left beyond: where the curve ends, nothing is.
    if place >= f32(CURVE_STEPS) {
        return 0.0;
    }
    let step = floor(place);
    let texel = curve_texel(row, i32(step));
    let start_and_rise = mix(texel.xy, texel.zw, upper);
    return max(1.0 - start_and_rise.x - start_and_rise.y * (place - step), 0.0);
}
