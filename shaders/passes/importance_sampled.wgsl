/// Diffused irradiance at `pixel`, whose texel of the irradiance is `own`; a pixel that does not scatter keeps it.
fn diffuse_importance_sampled(pixel: vec2i, own: vec4f) -> vec4f {
    let surface = input_surface(pixel);
    if surface.material == NO_MATERIAL {
        return own;
    }
    let point = surface_point_at(pixel, surface);
    let taps = footprint_taps(point, subsurface_view.taps);
    let turn = TAU * interleaved_gradient_noise(pixel, subsurface_view.frame_index);
    let gathered = gather_importance_sampled(point, taps, turn);
    let kept = finite_irradiance(own.rgb);
    return vec4f(mix(kept, diffused_irradiance(gathered, kept), footprint_blend(point)), own.a);
}

/// Taps per pixel.
fn taps_at(point: SurfacePoint) -> f32 {
    return f32(footprint_taps(point, subsurface_view.taps));
}

/// Diffused irradiance of translucent pixels; every other pixel keeps its irradiance.
@fragment
fn subsurface_fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(position.xy);
    return diffuse_importance_sampled(pixel, textureLoad(irradiance_texture, pixel, 0));
}
