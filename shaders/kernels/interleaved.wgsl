// Near, middle and far field.
//
// A profile's light splits by radius about the pixel:
//
//     near    the disc of one pixel's area: its share, radial_cdf(r), times the pixel's own irradiance
//     middle  the ring of the eight pixels around: summed
//     far     beyond the disc of nine pixels' area: sampled once per 2×2 block, interleaved between blocks
//
// so noise and blur of the sampling touch only what is smooth at the scale of a block. Each block takes one slice in
// four of a common lattice. A pixel mixes the far fields that its window touches, where material and depth agree.

/// Shares of a window in the blocks along an axis: in the block on the pixel's farther side, in its own, and on its
/// nearer side. The pixel lies a quarter of a block off the middle of its own.
///
/// This window is as wide as two blocks: wherever the pixel lies, every slice has a quarter of it.
const EVEN_WINDOW: vec3f = vec3f(0.125, 0.5, 0.375);

/// Linear between the middles of the blocks: less blur, but the slices count unevenly.
const LINEAR_WINDOW: vec3f = vec3f(0.0, 0.75, 0.25);

/// Taps per pixel up to which the window is the even one. With more of them a slice alone has less noise.
const EVEN_WINDOW_TAPS: f32 = 4.0;

/// The far fields around a pixel: of its own block and of the eight blocks around that.
struct FarFields {
    above_left: FarField,
    above: FarField,
    above_right: FarField,
    left: FarField,
    home: FarField,
    right: FarField,
    below_left: FarField,
    below: FarField,
    below_right: FarField,
}

/// The far fields around a pixel of block `home`.
fn load_far_fields(blocks: texture_2d<u32>, home: vec2i) -> FarFields {
    return FarFields(
        load_far_field(blocks, home + vec2i(-1, -1)),
        load_far_field(blocks, home + vec2i(0, -1)),
        load_far_field(blocks, home + vec2i(1, -1)),
        load_far_field(blocks, home + vec2i(-1, 0)),
        load_far_field(blocks, home),
        load_far_field(blocks, home + vec2i(1, 0)),
        load_far_field(blocks, home + vec2i(-1, 1)),
        load_far_field(blocks, home + vec2i(0, 1)),
        load_far_field(blocks, home + vec2i(1, 1)),
    );
}

/// What the far fields under a window hold together.
struct Mixture {
    /// Their light.
    far: Gathered,
    /// Share of the light that leaves the centre.
    leaving: vec3f,
    /// The part of the window that agrees with the pixel.
    window: f32,
}

/// Shares of the window in the blocks before a pixel's own along an axis, in it and behind it. `side` is −1 for the
/// first pixel of a block and 1 for the second.
fn window_shares(side: i32, taps: u32) -> vec3f {
    let window = mix(LINEAR_WINDOW, EVEN_WINDOW, min(EVEN_WINDOW_TAPS / f32(max(taps, 1u)), 1.0));
    return select(window.zyx, window, side > 0);
}

/// Share of a far field that a pixel may take: 1 for one of its own surface, 0 for another's.
fn far_field_agreement(at: Receiver, field: FarField) -> f32 {
    let is_other = REJECT_BY_MATERIAL && field.surface.material != at.surface.material;
    if field.surface.material == NO_MATERIAL || is_other {
        return 0.0;
    }
    return depth_agreement(apart_in_depth(at.depth_scale, field.surface.distance_mm, at.surface.distance_mm));
}

/// `mixture` with the part `share` of a field, as far as it agrees with the pixel.
fn with_field(mixture: Mixture, at: Receiver, field: FarField, share: f32) -> Mixture {
    let agreed = share * far_field_agreement(at, field);
    let far = Gathered(agreed * field.light.irradiance, agreed * field.light.weight);
    let leaving = agreed * (vec3f(1.0) - field.centre);
    return Mixture(together(mixture.far, far), mixture.leaving + leaving, mixture.window + agreed);
}

/// `mixture` with three fields that lie side by side.
fn with_row(
    mixture: Mixture,
    at: Receiver,
    left: FarField,
    middle: FarField,
    right: FarField,
    shares: vec3f,
) -> Mixture {
    let begun = with_field(mixture, at, left, shares.x);
    return with_field(with_field(begun, at, middle, shares.y), at, right, shares.z);
}

/// Irradiance of a pixel after it has diffused, with `taps` taps per pixel; `side` says which of its block's pixels it
/// is.
///
/// The ring is summed with the shares `beside` and `across` of the pixel's own block. A pixel that agrees with no
/// block, such as one of a strand as thin as a pixel, keeps its own light.
fn diffuse_interleaved(
    at: Receiver,
    side: vec2i,
    taps: u32,
    fields: FarFields,
    ring: Ring,
    beside: vec3f,
    across: vec3f,
) -> vec3f {
    let columns = window_shares(side.x, taps);
    let rows = window_shares(side.y, taps);
    let nothing = Mixture(Gathered(vec3f(0.0), vec3f(0.0)), vec3f(0.0), 0.0);
    let above = with_row(nothing, at, fields.above_left, fields.above, fields.above_right, rows.x * columns);
    let upper = with_row(above, at, fields.left, fields.home, fields.right, rows.y * columns);
    let mixture = with_row(upper, at, fields.below_left, fields.below, fields.below_right, rows.z * columns);
    if mixture.window == 0.0 {
        return at.own;
    }
    // By what leaves it: where nothing does this is 1, however a driver rounds, and the light comes back as it was.
    let centre = at.own_counts * (vec3f(1.0) - mixture.leaving / mixture.window);
    let near = Gathered(centre * at.own, centre);
    let far = Gathered(mixture.far.irradiance / mixture.window, mixture.far.weight / mixture.window);
    // The ring's shares are those of the pixel's own block, so they count only where it agrees.
    let counts = select(0.0, 1.0, far_field_agreement(at, fields.home) > 0.0);
    let middle = ring_light(at, ring, counts * beside, counts * across);
    return diffused_irradiance(together(together(near, far), middle), at.own);
}
