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

/// Share of the light that counts as all of it where the reach of a profile is asked for.
const FILTER_QUANTILE: f32 = 0.997;

/// Scales of the mean free path are kept within these: enough for a factor of a thousand on any material.
const SMALLEST_MEAN_FREE_PATH_SCALE: f32 = 1e-3;
const LARGEST_MEAN_FREE_PATH_SCALE: f32 = 1e3;

/// Smallest length of a pixel, mm: the number of pixels in a radius stays a finite f32.
const SMALLEST_PIXEL_MM: f32 = 1e-12;

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

/// The surface albedo that a texel of the surface texture gives, or the material's own where it is none.
fn texel_surface_albedo(texel: vec4f, surface: MaterialSurface) -> vec3f {
    return select(
        surface.surface_albedo,
        clamp(texel.rgb, vec3f(0.0), vec3f(1.0)),
        is_finite_rgb(texel.rgb),
    );
}

/// Taps for a point: a quarter of the pixels within its filter radius, up to the budget, as in Golubev 2018, "Efficient
/// Screen-Space Subsurface Scattering Using Burley's Normalized Diffusion in Real-Time". A filter of less than a pixel
/// needs none.
fn footprint_taps(point: SurfacePoint, budget: u32) -> u32 {
    if point.filter_radius_pixels < 1.0 {
        return 0u;
    }
    let radius = min(point.filter_radius_pixels, 4096.0);
    return min(u32(ceil(0.125 * TAU * radius * radius)), min(budget, LARGEST_TAP_COUNT));
}

/// Bound of every loop over taps.
const LARGEST_TAP_COUNT: u32 = 4096u;

/// Share of the diffused irradiance in the result: it comes in while the filter radius grows from one pixel to two, so
/// that nothing pops when a surface comes near.
fn footprint_blend(point: SurfacePoint) -> f32 {
    return clamp(point.filter_radius_pixels - 1.0, 0.0, 1.0);
}

/// Millimetres that a pixel spans at a distance.
fn span_mm(view: SubsurfaceView, distance_mm: f32) -> f32 {
    let span = abs(view.millimetres_per_pixel.x + view.millimetres_per_pixel.y * distance_mm);
    return max(span, SMALLEST_PIXEL_MM);
}
