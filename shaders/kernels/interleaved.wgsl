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
/// is. For the pixels of a block at once: see `FarFields`.
///
/// The ring is summed with the shares `beside` and `across` of the pixel's own block.
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
    let above = with_row(
        empty_mixture(),
        at,
        fields.above_left,
        fields.above,
        fields.above_right,
        rows.x * columns,
    );
    let upper = with_row(above, at, fields.left, fields.home, fields.right, rows.y * columns);
    let mixture = with_row(upper, at, fields.below_left, fields.below, fields.below_right, rows.z * columns);
    let counts = ring_counts(at, fields.home);
    return mixed_light(at, mixture, ring_light(at, ring, counts * beside, counts * across));
}

/// 1 where a pixel agrees with its block, else 0: the ring's shares are those of the block, so they count only there.
fn ring_counts(at: Receiver, home: FarField) -> f32 {
    return select(0.0, 1.0, far_field_agreement(at, home) > 0.0);
}

/// Irradiance of a pixel whose far field is `mixture` and whose ring gives `middle`. A pixel that agrees with no block,
/// such as one of a strand as thin as a pixel, keeps its own light.
fn mixed_light(at: Receiver, mixture: Mixture, middle: Gathered) -> vec3f {
    if mixture.window == 0.0 {
        return at.own;
    }
    // By what leaves it: where nothing does this is 1, however a driver rounds, and the light comes back as it was.
    let centre = at.own_counts * (vec3f(1.0) - mixture.leaving / mixture.window);
    let near = Gathered(centre * at.own, centre);
    let far = Gathered(mixture.far.irradiance / mixture.window, mixture.far.weight / mixture.window);
    return diffused_irradiance(together(together(near, far), middle), at.own);
}
