// uses: gather/{footprint, gathered, input, pixel_point}; needs: gather_at, input_surface, subsurface_view

/// Diffused irradiance at `pixel`, whose texel of the irradiance is `own`; a pixel that does not scatter keeps it.
fn diffuse_single_stage(pixel: vec2i, own: vec4f) -> vec4f {
    let surface = input_surface(pixel);
    if surface.material == NO_MATERIAL {
        return own;
    }
    let kept = finite_irradiance(own.rgb);
    let point = surface_point_at(pixel, surface);
    if footprint_taps(point, subsurface_view.taps) == 0u {
        return vec4f(kept, own.a);
    }
    let gathered = gather_at(point, pixel);
    return vec4f(mix(kept, diffused_irradiance(gathered, kept), footprint_blend(point)), own.a);
}
