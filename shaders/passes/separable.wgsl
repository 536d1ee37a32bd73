// uses: gather/{footprint, point, view}, kernels/separable, kernels/separable/taps, passes/{subsurface, subsurface_fragment}

/// Taps per pixel.
fn taps_at(point: SurfacePoint) -> f32 {
    return taps_of_passes(footprint_taps(point, budget_beside_centre()));
}

/// What the first pass keeps of a pixel.
@fragment
fn first_fragment(@builtin(position) position: vec4f) -> @location(0) vec2u {
    // The first pass reads no intermediate texture; whichever is bound serves.
    return blur_first(vec2i(position.xy), intermediate_texture);
}

/// Diffused irradiance of translucent pixels; every other pixel keeps its irradiance.
@fragment
fn subsurface_fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = viewport_position(subsurface_view, position);
    return blur_second(pixel, intermediate_texture);
}
