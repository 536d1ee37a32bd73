// uses: gather/gathered, kernels/interleaved/{far_fields, mixture, near, receiver, ring, window}

// Near field, ring and far field.
//
// A profile's light splits by radius about the pixel:
//
//     near    the disc of one pixel's area: its share, radial_cdf(r), times the pixel's own irradiance
//     ring    the eight pixels around: summed for each pixel
//     far     beyond the disc of nine pixels' area, once per block of 2×2 pixels:
//             the eight blocks around are summed; what lies beyond the disc of 36 pixels' area is sampled from squares
//
// so noise and blur of the sampling touch only what is smooth at the scale of a block. Each block takes one slice in
// four of a common lattice. A pixel mixes the far fields that its window touches, where material and depth agree.

/// Irradiance of a pixel after it has diffused, with `taps` taps per pixel; `side` says which of its block's pixels it
/// is. For the pixels of a block at once: see `FarFields`. The block has `shares`.
fn diffuse_interleaved(
    at: Receiver,
    side: vec2i,
    taps: u32,
    fields: FarFields,
    ring: Ring,
    shares: PixelShares,
) -> vec3f {
    let columns = window_shares(side.x, taps);
    let rows = window_shares(side.y, taps);
    let above = with_row(
        Gathered(vec3f(0.0), vec3f(0.0)),
        at,
        fields.above_left,
        fields.above,
        fields.above_right,
        rows.x * columns,
    );
    let upper = with_row(above, at, fields.left, fields.home, fields.right, rows.y * columns);
    let mixture = with_row(upper, at, fields.below_left, fields.below, fields.below_right, rows.z * columns);
    let ring_light = ring_light(at, ring, shares.beside, shares.across);
    return mixed_light(at, mixture, shares.centre, ring_light, accepts_far_field(at, fields.home.surface));
}

/// Irradiance of a pixel whose far field is `far`.
///
/// Its own share `centre` and that of the ring are those of its block. Where that is another material's, which
/// `is_home` denies, the pixel keeps what does not come from afar.
fn mixed_light(at: Receiver, far: Gathered, centre: vec3f, ring: Gathered, is_home: bool) -> vec3f {
    let own = at.own_counts * select(max(vec3f(1.0) - far.weight, vec3f(0.0)), centre, is_home);
    let counts = select(0.0, 1.0, is_home);
    let near = Gathered(own * at.own + counts * ring.irradiance, own + counts * ring.weight);
    return diffused_irradiance(together(near, far), at.own);
}
