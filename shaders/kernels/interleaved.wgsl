// Near, middle and far field.
//
// A profile's light splits by radius about the pixel:
//
//     near    the disc of one pixel's area: its share, radial_cdf(r), times the pixel's own irradiance
//     middle  the ring of the eight pixels around: summed exactly
//     far     beyond the disc of nine pixels' area: sampled once per 2×2 block, interleaved between blocks
//
// so noise and blur of the sampling touch only what is smooth at the scale of a block. Each block takes one slice in
// four of a common lattice; a pixel mixes the far fields of its four nearest blocks, which hold all slices, where
// material and depth agree.

/// The four far fields nearest to a pixel: of its own block, of the block beside it along x, along y and along both.
struct NearestFarFields {
    home: FarField,
    beside_x: FarField,
    beside_y: FarField,
    across: FarField,
}

/// Share of a far field that a pixel may take: 1 for one of its own surface, 0 for another's.
fn far_field_agreement(at: Receiver, field: FarField) -> f32 {
    let is_other = REJECT_BY_MATERIAL && field.surface.material != at.surface.material;
    if field.surface.material == NO_MATERIAL || is_other {
        return 0.0;
    }
    return depth_agreement(field.surface.distance_mm, at.surface.distance_mm, at.span_mm);
}

/// Light of a far field and the centre's share, times `share`.
fn share_of_field(field: FarField, own: vec3f, share: f32) -> Gathered {
    return Gathered(
        share * (field.light.irradiance + field.centre * own),
        share * (field.light.weight + field.centre),
    );
}

/// Irradiance of a pixel after it has diffused.
///
/// The far fields are mixed linearly between the middles of their blocks, as their depths agree; the ring is summed with
/// the shares `beside` and `across` of the pixel's own block. A pixel that agrees with no block, such as one of a strand
/// as thin as a pixel, keeps its own light.
fn diffuse_interleaved(
    at: Receiver,
    fields: NearestFarFields,
    ring: Ring,
    beside: vec3f,
    across: vec3f,
) -> vec3f {
    // Three quarters of the nearer middle along each axis.
    let of_home = 0.5625 * far_field_agreement(at, fields.home);
    let of_x = 0.1875 * far_field_agreement(at, fields.beside_x);
    let of_y = 0.1875 * far_field_agreement(at, fields.beside_y);
    let of_across = 0.0625 * far_field_agreement(at, fields.across);
    let agreement = of_home + of_x + of_y + of_across;
    if agreement == 0.0 {
        return at.own;
    }
    let share = 1.0 / agreement;
    let nearer = together(
        share_of_field(fields.home, at.own, share * of_home),
        share_of_field(fields.beside_x, at.own, share * of_x),
    );
    let farther = together(
        share_of_field(fields.beside_y, at.own, share * of_y),
        share_of_field(fields.across, at.own, share * of_across),
    );
    // The ring's shares are those of the pixel's own block, so they count only where it agrees.
    let counts = select(vec3f(0.0), vec3f(1.0), of_home > 0.0);
    let middle = ring_light(at, ring, counts * beside, counts * across);
    return diffused_irradiance(together(together(nearer, farther), middle), at.own);
}
