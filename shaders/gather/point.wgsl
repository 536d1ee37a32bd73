// uses: gather/{curve, normal, profile, view}, kernel/constants, the material set

/// The point of a surface that light is gathered for.
///
/// A factor on the mean free path scales every radius alike, so it is taken out of all lengths once: `pixel_mm` and
/// `per_mm` are in the lengths that the material's own profile has.
struct SurfacePoint {
    /// Where it is seen, pixels; whole numbers are the centres of pixels.
    position: vec2f,
    /// Material number.
    material: i32,
    /// Distance along the view axis, mm.
    distance_mm: f32,
    /// Length that a pixel spans, mm.
    span_mm: f32,
    /// The same over the scale of the mean free path.
    pixel_mm: f32,
    /// Reciprocal of the scale of the mean free path.
    per_mm: f32,
    profiles: ChannelProfiles,
    /// The widest of the profiles: radii are drawn from it.
    widest: Profile,
    /// Its number.
    widest_channel: u32,
    /// Radius that holds FILTER_QUANTILE of the widest profile's light, pixels.
    filter_radius_pixels: f32,
    /// See `surface_normal`.
    normal: vec3f,
}

/// The point at `position`, with the profiles that its material has at this surface albedo, and the normal of `pixel`.
/// The scale is within its limits.
fn surface_point(
    view: SubsurfaceView,
    pixel: vec2i,
    position: vec2f,
    material: i32,
    row: SubsurfaceMaterial,
    distance_mm: f32,
    surface_albedo: vec3f,
    mean_free_path_scale: f32,
) -> SurfacePoint {
    let per_mm = 1.0 / mean_free_path_scale;
    let profiles = material_profiles(row, surface_albedo);
    let reach = vec3f(
        curve_quantile(profiles.red.curve, FILTER_QUANTILE).x,
        curve_quantile(profiles.green.curve, FILTER_QUANTILE).x,
        curve_quantile(profiles.blue.curve, FILTER_QUANTILE).x,
    );
    let red_or_green = select(1u, 0u, reach.r >= reach.g);
    let widest = select(2u, red_or_green, max(reach.r, reach.g) >= reach.b);
    let span = span_mm(view, distance_mm);
    let pixel_mm = max(span * per_mm, SMALLEST_PIXEL_MM);
    return SurfacePoint(
        position,
        material,
        distance_mm,
        span,
        pixel_mm,
        per_mm,
        profiles,
        channel_profile(profiles, widest),
        widest,
        max(reach.r, max(reach.g, reach.b)) / pixel_mm,
        surface_normal(pixel, span),
    );
}
