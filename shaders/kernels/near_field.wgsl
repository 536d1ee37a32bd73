// The light that stays within a pixel and its eight neighbours.

/// Radius of the disc with the area of a pixel, pixels: 1 / √π.
const NEAR_RADIUS_PIXELS: f32 = 0.56418958;

/// Radius of the disc with the area of nine pixels, pixels: 3 / √π.
const FAR_RADIUS_PIXELS: f32 = 1.6925688;

/// ½ log₃ 2
const HALF_LOG_3_OF_2: f32 = 0.31546488;

/// Shares of a profile's light that a pixel and each pixel of the ring around it have on a flat surface.
struct NearField {
    /// Of the pixel itself.
    centre: vec3f,
    /// Of each pixel beside it.
    beside: vec3f,
    /// Of each pixel across its corners.
    across: vec3f,
}

/// The near field of a point.
///
/// The ring's energy is exact. How it falls on beside and across follows from the power law R ∝ r^-s that has the same
/// energy in both discs: their radii are as 1 : 3, so E₃/E₁ = 3^(2 − s), and R(√2)/R(1) = 2^(−s/2).
fn near_field(point: SurfacePoint) -> NearField {
    let centre = channel_radial_cdf(point.profiles, NEAR_RADIUS_PIXELS * point.pixel_mm);
    let inside = channel_radial_cdf(point.profiles, FAR_RADIUS_PIXELS * point.pixel_mm);
    let growth = inside / max(centre, vec3f(SMALLEST_WEIGHT));
    let across = 0.5 * pow(growth, vec3f(HALF_LOG_3_OF_2));
    let beside = (inside - centre) / (4.0 + 4.0 * across);
    return NearField(centre, beside, beside * across);
}

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

/// The eight pixels around one: beside it, and across its corners.
struct Ring {
    left: InputPixel,
    right: InputPixel,
    above: InputPixel,
    below: InputPixel,
    above_left: InputPixel,
    above_right: InputPixel,
    below_left: InputPixel,
    below_right: InputPixel,
}

/// Light of a ring, with the shares that its pixels have on a flat surface.
fn ring_light(at: Receiver, ring: Ring, beside: vec3f, across: vec3f) -> Gathered {
    let left_right = together(
        pixel_light(at, ring.left, vec2i(-1, 0), beside),
        pixel_light(at, ring.right, vec2i(1, 0), beside),
    );
    let above_below = together(
        pixel_light(at, ring.above, vec2i(0, -1), beside),
        pixel_light(at, ring.below, vec2i(0, 1), beside),
    );
    let upper = together(
        pixel_light(at, ring.above_left, vec2i(-1, -1), across),
        pixel_light(at, ring.above_right, vec2i(1, -1), across),
    );
    let lower = together(
        pixel_light(at, ring.below_left, vec2i(-1, 1), across),
        pixel_light(at, ring.below_right, vec2i(1, 1), across),
    );
    return together(together(left_right, above_below), together(upper, lower));
}

/// Light of one pixel of the ring, `apart` from the centre, whose share on a flat surface is `share`.
fn pixel_light(at: Receiver, pixel: InputPixel, apart: vec2i, share: vec3f) -> Gathered {
    let is_other = REJECT_BY_MATERIAL && pixel.material != at.surface.material;
    let apart_by = apart_in_depth(at.depth_scale, pixel.distance_mm, at.surface.distance_mm);
    let steps = BLOCK_DEPTH_PIXELS * apart_by;
    // Close to the centre profiles fall about as r^-2 or slower: what depth leaves of the flat share.
    let squared_radius = f32(dot(apart, apart));
    let by_depth = depth_agreement(apart_by) * squared_radius / (squared_radius + steps * steps);
    let by_normal = accepted_by_normal(at.normal, at.position + apart, at.span_mm);
    let weight = share * select(by_depth * by_normal, 0.0, is_other || pixel.material == NO_MATERIAL);
    return Gathered(weight * pixel.irradiance, weight);
}
