// uses: gather/gathered, kernels/interleaved/{far_fields, mixture, receiver, ring, window}

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
