// Importance-sampled gather in screen space, [L23] eq. (22):
//
//     L = Σ wᵢ Eᵢ / Σ wᵢ,   wᵢ = R(√(rᵢ² + dᵢ²)) / p(rᵢ)
//
// with rᵢ drawn from the profile of the widest channel, p its density per area, dᵢ the difference in depth and one
// weight per channel. Radii take the centres of equal strata of the CDF (the quantile diverges at u = 1, so strata are
// centred); directions follow the golden angle from a start that each pixel takes from a fixed pattern.

/// Irradiance above this counts as this: 4096 taps at the largest weight still add up to a finite f32.
const LARGEST_IRRADIANCE: f32 = 1e30;

/// Largest weight of a tap. A narrow channel's density over the widest one's grows as the ratio of their lengths at
/// small radii; a ratio of 1e4 and more belongs to materials whose narrow channel does not leave the pixel anyway.
const LARGEST_WEIGHT: f32 = 1e4;

/// A depth difference above this counts as this: its square and cube stay finite, and every profile is 0 there.
const LARGEST_DEPTH_DIFFERENCE_MM: f32 = 1e9;

/// A channel whose weights add up to less than this has lost every tap.
const SMALLEST_WEIGHT: f32 = 1e-20;

/// Irradiance at `pixel` after it has diffused under the surface.
///
/// `irradiance` holds the irradiance, `surface` the surface albedo and the material number, `depth` the depth;
/// `view` says how to read it. A tap counts only if it is inside the target, on the same material and finite; what is
/// lost is renormalized, so that a constant irradiance stays constant.
fn gather_importance_sampled(
    irradiance: texture_2d<f32>,
    surface: texture_2d<f32>,
    depth: texture_2d<f32>,
    view: SubsurfaceView,
    pixel: vec2i,
    material: i32,
    profiles: ChannelProfiles,
    distance_mm: f32,
) -> vec3f {
    let size = vec2i(textureDimensions(irradiance));
    let millimetres_per_pixel = view.millimetres_per_pixel.x + view.millimetres_per_pixel.y * distance_mm;
    let sampled = channel_profile(profiles, widest_channel(profiles));
    let turn = TAU * interleaved_gradient_noise(pixel, view.seed);

    var weighted = vec3f(0.0);
    var weights = vec3f(0.0);
    for (var tap = 0u; tap < view.taps; tap += 1u) {
        let u = (f32(tap) + 0.5) / f32(view.taps);
        let radius_mm = profile_sample_radius(sampled, u);
        let angle = turn + GOLDEN_ANGLE * f32(tap);
        // A radius of thousands of pixels leaves the target anyway; the bound keeps the conversion to i32 defined.
        let radius_pixels = min(radius_mm / millimetres_per_pixel, 32768.0);
        let offset = radius_pixels * vec2f(cos(angle), sin(angle));
        let position = pixel + vec2i(round(offset));
        if any(position < vec2i(0)) || any(position >= size) {
            continue;
        }
        let tap_surface = textureLoad(surface, position, 0);
        if material_number(tap_surface.w, MATERIALS_IN_SET) != material {
            continue;
        }
        let tap_distance_mm = distance_from_depth_mm(textureLoad(depth, position, 0).r, view.distance_from_depth);
        let tap_irradiance = textureLoad(irradiance, position, 0).rgb;
        if tap_distance_mm == 0.0 || !is_finite_rgb(tap_irradiance) {
            continue;
        }
        let depth_difference_mm = min(abs(tap_distance_mm - distance_mm), LARGEST_DEPTH_DIFFERENCE_MM);
        let path_mm = sqrt(radius_mm * radius_mm + depth_difference_mm * depth_difference_mm);
        let ratio = channel_area_pdf(profiles, path_mm) / profile_area_pdf(sampled, radius_mm);
        let weight = min(ratio, vec3f(LARGEST_WEIGHT));
        weighted += weight * clamp(tap_irradiance, vec3f(0.0), vec3f(LARGEST_IRRADIANCE));
        weights += weight;
    }

    // Channels whose every tap was rejected keep the irradiance of the pixel itself.
    let own = textureLoad(irradiance, pixel, 0).rgb;
    let kept = select(vec3f(0.0), clamp(own, vec3f(0.0), vec3f(LARGEST_IRRADIANCE)), is_finite_rgb(own));
    return select(kept, weighted / max(weights, vec3f(SMALLEST_WEIGHT)), weights > vec3f(SMALLEST_WEIGHT));
}
