// uses: gather/{footprint, gathered, input, material, pixel_point, point, rejection}, kernel/constants, kernels/separable/{edge_spread, packed_line, strips, taps}, lib/numeric_limits, the material set; needs: input_pixel, input_surface, irradiance_at, subsurface_view

// Two passes along one axis each: Jimenez et al. 2015, "Separable Subsurface Scattering".
//
// A tap is a strip beside the centre. Its weight is the light that a line source sends into the strip: the difference
// of the profile's edge spread F at the strip's ends, not a sample of the line spread at its middle. Strips are so wide
// that no line of pixels stands for much more of the widest channel's light than the centre; the last ones are open.

/// Light gathered along `axis` at the point; `is_second` tells the second pass, which reads `blurred`, what the first
/// one left. The centre's own light counts unless it was not finite.
fn gather_line(
    point: SurfacePoint,
    surface: MaterialSurface,
    own: vec3f,
    own_counts: bool,
    axis: vec2f,
    blurred: texture_2d<u32>,
    is_second: bool,
) -> Gathered {
    let strips = taps_per_side(footprint_taps(point, budget_beside_centre()));
    let spread = edge_spread_of(surface, point.profiles);
    var start = 0.5;
    var beyond_start = beyond_line(spread, start * point.pixel_mm);
    let beyond_centre = 2.0 * beyond_start[point.widest_channel];
    let centre = select(vec3f(0.0), vec3f(1.0) - 2.0 * beyond_start, own_counts);
    var gathered = Gathered(centre * own, centre);
    for (var number = 1u; number <= strips; number += 1u) {
        let strip = next_strip(surface, point, beyond_centre, number, strips, start);
        let beyond = beyond_line(spread, strip.end * point.pixel_mm);
        let beyond_end = select(beyond, vec3f(0.0), number == strips);
        // Where the surface lies deeper or higher, as much is left of the strip's light as is left of what lies beyond
        // its middle at that distance in space.
        let middle_mm = 0.5 * (strip.start + strip.end) * point.pixel_mm;
        let per_beyond = (beyond_start - beyond_end) / max(beyond_line(spread, middle_mm), vec3f(SMALLEST_WEIGHT));
        for (var side = -1.0; side <= 1.0; side += 2.0) {
            let lines = lines_of_strip(point, strip, side * axis, blurred, is_second);
            let path_mm = middle_mm * sqrt(1.0 + lines.squared_slope);
            let weight = per_beyond * beyond_line(spread, path_mm);
            gathered = together(gathered, Gathered(weight * lines.irradiance, weight * lines.weight));
        }
        start = strip.end;
        beyond_start = beyond_end;
    }
    return gathered;
}

/// What the two lines of a strip have on one side of the centre.
struct StripLight {
    /// Sum of their irradiances, each by its weight.
    irradiance: vec3f,
    /// Sum of their weights: 1 where both count in full.
    weight: f32,
    /// Square of the slope from the centre to them: mean square of their depths over that of their distances.
    squared_slope: f32,
}

/// The lines of a strip in the direction `axis`.
fn lines_of_strip(
    point: SurfacePoint,
    strip: Strip,
    axis: vec2f,
    blurred: texture_2d<u32>,
    is_second: bool,
) -> StripLight {
    let near_position = vec2i(round(point.position + strip.near * axis));
    let far_position = vec2i(round(point.position + strip.far * axis));
    let near = line_pixel(near_position, blurred, is_second);
    let far = line_pixel(far_position, blurred, is_second);
    let near_weight = line_weight(point, near_position, near);
    let far_weight = line_weight(point, far_position, far);
    let near_mm = depth_difference_mm(point, near.distance_mm);
    let far_mm = depth_difference_mm(point, far.distance_mm);
    let weight = near_weight + far_weight;
    let squared_depth = near_weight * near_mm * near_mm + far_weight * far_mm * far_mm;
    let distances_mm = vec2f(strip.near, strip.far) * point.pixel_mm;
    return StripLight(
        near_weight * near.irradiance + far_weight * far.irradiance,
        weight,
        squared_depth / max(0.5 * weight * dot(distances_mm, distances_mm), SMALLEST_WEIGHT),
    );
}

/// Weight of a line that found `pixel` at `position`: one half where it counts in full.
fn line_weight(point: SurfacePoint, position: vec2i, pixel: InputPixel) -> f32 {
    if !accepts_material(point, pixel.material) {
        return 0.0;
    }
    return 0.5 * accepted_by_normal(point.normal, position, point.span_mm);
}

/// The pixel that a tap sees: of the inputs in the first pass, of what that left in the second.
fn line_pixel(position: vec2i, blurred: texture_2d<u32>, is_second: bool) -> InputPixel {
    if !is_second {
        return input_pixel(position);
    } else {
        let surface = input_surface(position);
        if surface.material == NO_MATERIAL {
            return InputPixel(vec3f(0.0), 0.0, NO_MATERIAL);
        }
        return InputPixel(unpack_line(textureLoad(blurred, position, 0).rg), surface.distance_mm, surface.material);
    }
}

/// Irradiance of the pixel after the first pass.
fn blur_first(pixel: vec2i, blurred: texture_2d<u32>) -> vec2u {
    let surface = input_surface(pixel);
    if surface.material == NO_MATERIAL {
        return vec2u(0u);
    }
    let texel = irradiance_at(pixel).rgb;
    let own = finite_irradiance(texel);
    let point = surface_point_at(pixel, surface);
    if footprint_taps(point, subsurface_view.taps) == 0u {
        return pack_line(own);
    }
    let row = material_table[surface.material].surface;
    let axis = first_axis(pixel, subsurface_view.frame_index);
    let gathered = gather_line(point, row, own, is_finite_rgb(texel), axis, blurred, false);
    // Read once more, so that no register holds it meanwhile.
    let own_again = finite_irradiance(irradiance_at(vec2i(point.position)).rgb);
    return pack_line(diffused_irradiance(gathered, own_again));
}

/// Irradiance of the pixel after the second pass.
fn blur_second(pixel: vec2i, blurred: texture_2d<u32>) -> vec4f {
    let surface = input_surface(pixel);
    if surface.material == NO_MATERIAL {
        return irradiance_at(pixel);
    }
    let point = surface_point_at(pixel, surface);
    if footprint_taps(point, subsurface_view.taps) == 0u {
        let texel = irradiance_at(pixel);
        return vec4f(finite_irradiance(texel.rgb), texel.a);
    }
    let row = material_table[surface.material].surface;
    let along = first_axis(pixel, subsurface_view.frame_index);
    let half_way = unpack_line(textureLoad(blurred, pixel, 0).rg);
    let gathered = gather_line(point, row, half_way, true, vec2f(-along.y, along.x), blurred, true);
    // Read last, and once more, so that no register holds it meanwhile.
    let here = vec2i(point.position);
    let texel = irradiance_at(here);
    let diffused = diffused_irradiance(gathered, unpack_line(textureLoad(blurred, here, 0).rg));
    return vec4f(mix(finite_irradiance(texel.rgb), diffused, footprint_blend(point)), texel.a);
}
