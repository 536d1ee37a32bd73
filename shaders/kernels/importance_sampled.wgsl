// Importance-sampled gather in screen space, [L23] eq. (22):
//
//     L = Σ wᵢ Eᵢ / Σ wᵢ,   wᵢ = R(√(rᵢ² + dᵢ²)) / p(rᵢ)
//
// with rᵢ drawn from the profile of the widest channel, p its density per area, dᵢ the difference in depth and one
// weight per channel. Radii take the centres of equal strata of the CDF (the quantile diverges at u = 1, so strata are
// centred); directions follow the golden angle from a start that each pixel takes from a fixed pattern.

/// Largest weight of a tap. A narrow channel's density over the widest one's grows as the ratio of their lengths at
/// small radii; a ratio of 1e4 and more belongs to materials whose narrow channel does not leave the pixel anyway.
const LARGEST_WEIGHT: f32 = 1e4;

/// Taps farther than this many pixels count as this far: outside of any target, and exact as i32.
const LARGEST_TAP_DISTANCE: f32 = 32768.0;

/// cos and sin of the golden angle: a step from tap to tap without a transcendental.
const GOLDEN_TURN: vec2f = vec2f(-0.73736888, 0.67549029);

/// Light gathered for `point` by `taps` taps.
fn gather_importance_sampled(point: SurfacePoint, taps: u32, turn: f32) -> Gathered {
    var direction = vec2f(cos(turn), sin(turn));
    var gathered = Gathered(vec3f(0.0), vec3f(0.0));
    for (var tap = 0u; tap < taps; tap += 1u) {
        let u = (f32(tap) + 0.5) / f32(taps);
        let quantile = curve_quantile(point.widest.curve, u);
        gathered = together(gathered, tap_light(point, quantile, direction));
        direction = turned(direction, GOLDEN_TURN);
    }
    let share = 1.0 / f32(max(taps, 1u));
    return Gathered(share * gathered.irradiance, share * gathered.weight);
}

/// Light of one tap whose radius was drawn from `quantile`: (radius in mm, dr/du).
fn tap_light(point: SurfacePoint, quantile: vec2f, direction: vec2f) -> Gathered {
    let position = tap_position(point, quantile.x, direction);
    return light_of_tap(point, quantile, position, input_pixel(position));
}

/// Pixel that a tap reads, `radius_mm` from the point.
fn tap_position(point: SurfacePoint, radius_mm: f32, direction: vec2f) -> vec2i {
    let radius_pixels = min(radius_mm / point.pixel_mm, LARGEST_TAP_DISTANCE);
    return vec2i(round(point.position + radius_pixels * direction));
}

/// Light of one tap that found `pixel` at `position`.
fn light_of_tap(point: SurfacePoint, quantile: vec2f, position: vec2i, pixel: InputPixel) -> Gathered {
    if !accepts_material(point, pixel.material) {
        return Gathered(vec3f(0.0), vec3f(0.0));
    }
    let radius_mm = quantile.x;
    let depth_mm = depth_difference_mm(point, pixel.distance_mm);
    let path_mm = sqrt(radius_mm * radius_mm + depth_mm * depth_mm);
    // 1 / p(r) = 2πr · dr/du.
    let ratio = channel_area_pdf(point.profiles, path_mm) * (TAU * radius_mm * quantile.y);
    let normal_share = accepted_by_normal(point.normal, position, point.span_mm);
    let weight = min(ratio, vec3f(LARGEST_WEIGHT)) * normal_share;
    return Gathered(weight * pixel.irradiance, weight);
}

/// `direction` turned by the angle whose cosine and sine are `turn`.
fn turned(direction: vec2f, turn: vec2f) -> vec2f {
    return vec2f(
        direction.x * turn.x - direction.y * turn.y,
        direction.x * turn.y + direction.y * turn.x,
    );
}
