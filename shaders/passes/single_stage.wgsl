// Kernels of one stage. Such a kernel declares
//
//     fn gather_at(point: SurfacePoint, pixel: vec2i) -> Gathered     light for the point that `pixel` shows
//     fn taps_at(point: SurfacePoint) -> f32                          taps per pixel, for the debug view
//     fn most_taps() -> f32                                           the largest number of them

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

/// Diffused irradiance of translucent pixels; every other pixel keeps its irradiance.
@fragment
fn subsurface_fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(position.xy);
    return diffuse_single_stage(pixel, textureLoad(irradiance_texture, pixel, 0));
}
