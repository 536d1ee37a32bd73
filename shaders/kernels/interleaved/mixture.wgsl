// uses: gather/{gathered, input}, kernels/interleaved/{agreement, far_fields, receiver}, the material set

/// Whether a pixel may take the far field of a block at `surface`.
fn accepts_far_field(at: Receiver, surface: InputSurface) -> bool {
    return select(surface.material != NO_MATERIAL, surface.material == at.surface.material, REJECT_BY_MATERIAL);
}

/// Share of a far field that a pixel may take: 1 for one of its own surface, 0 for another material's.
fn far_field_agreement(at: Receiver, field: FarField) -> f32 {
    let apart = apart_in_depth(at.depth_scale * field.depth_factor, field.surface.distance_mm, at.surface.distance_mm);
    return select(0.0, depth_agreement(apart), accepts_far_field(at, field.surface));
}

/// The light of `mixture` with the part `share` of a field, as far as it agrees with the pixel.
///
/// What does not agree is missing, and the pixel and its ring count for more: at a silhouette little arrives from afar.
fn with_field(mixture: Gathered, at: Receiver, field: FarField, share: f32) -> Gathered {
    let agreed = share * far_field_agreement(at, field);
    return together(mixture, Gathered(agreed * field.light.irradiance, agreed * field.light.weight));
}

/// `mixture` with three fields that lie side by side.
fn with_row(
    mixture: Gathered,
    at: Receiver,
    left: FarField,
    middle: FarField,
    right: FarField,
    shares: vec3f,
) -> Gathered {
    let begun = with_field(mixture, at, left, shares.x);
    return with_field(with_field(begun, at, middle, shares.y), at, right, shares.z);
}
