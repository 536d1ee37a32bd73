// Two passes along one axis each: Jimenez et al. 2015, "Separable Subsurface Scattering".
//
// The weight of a tap is the light that a line source sends into the tap's strip: the difference of the profile's edge
// spread F at the strip's ends, not a sample of the line spread at its middle. Taps lie closer together near the
// centre, at the squares of even steps as in that paper but a pixel apart at least; strips meet half way between taps,
// and the last ones are open.

/// Fraction of the light beyond a line `offset_mm` from an edge, per channel, which is 1 − F.
fn beyond_line(surface: MaterialSurface, profiles: ChannelProfiles, offset_mm: f32) -> vec3f {
    return vec3f(
        curve_beyond_line(surface, profiles.red.curve, offset_mm),
        curve_beyond_line(surface, profiles.green.curve, offset_mm),
        curve_beyond_line(surface, profiles.blue.curve, offset_mm),
    );
}

/// The same for one channel: a row of the edge curves holds F at even steps of the fourth root of the offset.
fn curve_beyond_line(surface: MaterialSurface, curve: vec3f, offset_mm: f32) -> f32 {
    let reach_mm = surface.edge_reach * curve.z;
    // What little is left where the curve ends is no light: a share of it would be whole.
    if offset_mm >= reach_mm {
        return 0.0;
    }
    let place = sqrt(sqrt(clamp(offset_mm / reach_mm, 0.0, 1.0))) * CURVE_STEPS;
    let step = min(floor(place), CURVE_STEPS - 1.0);
    let row = i32(curve.x) - i32(surface.first_curve) + i32(surface.first_edge);
    let texel = curve_texel(row, i32(step));
    let start_and_rise = mix(texel.xy, texel.zw, curve.y);
    return max(1.0 - start_and_rise.x - start_and_rise.y * (place - step), 0.0);
}

/// Distance of tap `tap` of `taps` on one side of the centre, in whole pixels: the squares of even steps up to the
/// reach, but no two taps on one pixel, so that strips end between pixels.
fn tap_offset(tap: f32, taps: f32, reach_pixels: f32) -> f32 {
    let step = tap / taps;
    return max(round(step * step * min(reach_pixels, LARGEST_TAP_DISTANCE)), tap);
}

/// Axis along which the first of the two passes blurs at `pixel`: the rows of the target, or another direction for each
/// pixel where the compiler says so. The second pass is perpendicular.
fn first_axis(pixel: vec2i, frame: u32) -> vec2f {
    if !SEPARABLE_ROTATED {
        return vec2f(1.0, 0.0);
    }
    let angle = 0.25 * TAU * interleaved_gradient_noise(pixel, frame);
    return vec2f(cos(angle), sin(angle));
}

/// Taps on each side of the centre, of `beside_centre` on both; an odd one is rounded up.
fn taps_per_side(beside_centre: u32) -> u32 {
    return (beside_centre + 1u) / 2u;
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
