// uses: gather/{footprint, gathered, input, pixel_point}; needs: gather_at, input_surface, irradiance_at, subsurface_view

/// Diffused irradiance at `pixel`; a pixel that does not scatter keeps its own. That is read where it is needed: held
/// through the loops it would take registers.
fn diffuse_single_stage(pixel: vec2i) -> vec4f {
    let surface = input_surface(pixel);
    if surface.material == NO_MATERIAL {
        return irradiance_at(pixel);
    }
    let point = surface_point_at(pixel, surface);
    if footprint_taps(point, subsurface_view.taps) == 0u {
        let own = irradiance_at(pixel);
        return vec4f(finite_irradiance(own.rgb), own.a);
    }
    let gathered = gather_at(point, pixel);
    let own = irradiance_at(pixel);
    let kept = finite_irradiance(own.rgb);
    return vec4f(mix(kept, diffused_irradiance(gathered, kept), footprint_blend(point)), own.a);
}
