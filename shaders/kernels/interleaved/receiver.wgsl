// uses: gather/{input, normal, packed_pixel, view}, kernels/interleaved/agreement, lib/numeric_limits; needs: subsurface_view

/// A pixel that light diffuses to.
struct Receiver {
    position: vec2i,
    surface: InputSurface,
    /// Millimetres that a pixel spans there.
    span_mm: f32,
    /// See `depth_scale`.
    depth_scale: f32,
    /// See `surface_normal`.
    normal: vec3f,
    /// Its irradiance before.
    own: vec3f,
    /// 1 where that is finite; 0 where it is not and so is no light.
    own_counts: f32,
}

/// The pixel at `position`, which shows `surface` and whose texel of the irradiance is `texel`.
fn receiver_at(position: vec2i, surface: InputSurface, texel: vec4f) -> Receiver {
    let span = span_mm(subsurface_view, surface.distance_mm);
    // The limit of the pixels around: a constant irradiance stays one.
    let own = min(finite_irradiance(texel.rgb), vec3f(LARGEST_PACKED_IRRADIANCE));
    let own_counts = select(0.0, 1.0, is_finite_rgb(texel.rgb));
    let normal = surface_normal(position, span);
    return Receiver(position, surface, span, depth_scale(span), normal, own, own_counts);
}
