// uses: gather/{input, pixel_point, tile}, kernels/debug_view, passes/subsurface

/// The debug view in place of the diffused irradiance.
@fragment
fn debug_fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(position.xy);
    let surface = input_surface(pixel);
    if subsurface_view.debug_view == DEBUG_TILES {
        let listed = select(vec3f(0.05, 0.05, 0.1), vec3f(0.1, 0.4, 0.15), tile_has_surface(pixel));
        let is_border = any(pixel % i32(TILE_SIDE) == vec2i(0));
        let covered = select(0.0, 0.4, surface.material != NO_MATERIAL);
        return vec4f(select(listed + covered, vec3f(0.0), is_border), 1.0);
    }
    if surface.material == NO_MATERIAL {
        return vec4f(0.0, 0.0, 0.0, 1.0);
    }
    return vec4f(debug_colour(pixel, surface_point_at(pixel, surface)), 1.0);
}
