// uses: gather/{input, pixel_point, view}, kernel/constants, kernels/debug_view, passes/subsurface

/// The debug view in place of the diffused irradiance; alpha is 0 where the pixel does not scatter.
@fragment
fn debug_fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = viewport_position(subsurface_view, position);
    let surface = input_surface(pixel);
    let scatters = surface.material != NO_MATERIAL;
    if subsurface_view.debug_view == DEBUG_TILES {
        return vec4f(tile_colour(pixel, scatters), select(0.0, 1.0, scatters));
    }
    if !scatters {
        return vec4f(0.0);
    }
    return vec4f(debug_colour(pixel, surface_point_at(pixel, surface)), 1.0);
}
