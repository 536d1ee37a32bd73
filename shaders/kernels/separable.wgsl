// uses: gather/{footprint, gathered, input, material, pixel_point, point, rejection}, kernels/separable/{edge_spread, packed_line, taps}, lib/numeric_limits, the material set; needs: input_pixel, input_surface, irradiance_at, subsurface_view

// Two passes along one axis each: Jimenez et al. 2015, "Separable Subsurface Scattering".
//
// The weight of a tap is the light that a line source sends into the tap's strip: the difference of the profile's edge
// spread F at the strip's ends, not a sample of the line spread at its middle. Taps lie closer together near the
// centre, at the squares of even steps as in that paper but a pixel apart at least; strips meet half way between taps,
// and the last ones are open.

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
    let sides = taps_per_side(footprint_taps(point, budget_beside_centre()));
    let reach = point.filter_radius_pixels;
    let steps = f32(max(sides, 1u));
    // The centre's strip ends half way to the first tap, on both sides.
    let edge_mm = 0.5 * tap_offset(1.0, steps, reach) * point.pixel_mm;
    var beyond_edge = beyond_line(surface, point.profiles, edge_mm);
    let centre = select(vec3f(0.0), vec3f(1.0) - 2.0 * beyond_edge, own_counts);
    var gathered = Gathered(centre * own, centre);
    for (var tap = 1u; tap <= sides; tap += 1u) {
        let offset = tap_offset(f32(tap), steps, reach);
        let offset_mm = offset * point.pixel_mm;
        let next_edge_mm = 0.5 * (offset + tap_offset(f32(tap) + 1.0, steps, reach)) * point.pixel_mm;
        let beyond_next = select(beyond_line(surface, point.profiles, next_edge_mm), vec3f(0.0), tap == sides);
        let strip = beyond_edge - beyond_next;
        let beyond_middle = beyond_line(surface, point.profiles, offset_mm);
        for (var side = -1.0; side <= 1.0; side += 2.0) {
            let position = vec2i(round(point.position + side * offset * axis));
            let pixel = line_pixel(position, blurred, is_second);
            if !accepts_material(point, pixel.material) {
                continue;
            }
            let depth_mm = depth_difference_mm(point, pixel.distance_mm);
            let share = line_share(surface, point.profiles, beyond_middle, offset_mm, depth_mm);
            let weight = strip * share * accepted_by_normal(point.normal, position, point.span_mm);
            gathered = together(gathered, Gathered(weight * pixel.irradiance, weight));
        }
        beyond_edge = beyond_next;
    }
    return gathered;
}

/// The pixel that a tap sees: of the inputs in the first pass, of what that left in the second.
fn line_pixel(position: vec2i, blurred: texture_2d<u32>, is_second: bool) -> InputPixel {
    if !is_second {
        return input_pixel(position);
    }
    let surface = input_surface(position);
    if surface.material == NO_MATERIAL {
        return InputPixel(vec3f(0.0), 0.0, NO_MATERIAL);
    }
    return InputPixel(unpack_line(textureLoad(blurred, position, 0).rg), surface.distance_mm, surface.material);
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
    return pack_line(diffused_irradiance(gathered, own));
}

/// Irradiance of the pixel after the second pass, from its texel of the irradiance.
fn blur_second(pixel: vec2i, texel: vec4f, blurred: texture_2d<u32>) -> vec4f {
    let surface = input_surface(pixel);
    if surface.material == NO_MATERIAL {
        return texel;
    }
    let own = finite_irradiance(texel.rgb);
    let point = surface_point_at(pixel, surface);
    if footprint_taps(point, subsurface_view.taps) == 0u {
        return vec4f(own, texel.a);
    }
    let row = material_table[surface.material].surface;
    let along = first_axis(pixel, subsurface_view.frame_index);
    let half_way = unpack_line(textureLoad(blurred, pixel, 0).rg);
    let gathered = gather_line(point, row, half_way, true, vec2f(-along.y, along.x), blurred, true);
    let diffused = diffused_irradiance(gathered, half_way);
    return vec4f(mix(own, diffused, footprint_blend(point)), texel.a);
}
