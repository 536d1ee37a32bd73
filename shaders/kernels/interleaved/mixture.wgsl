// uses: gather/{gathered, input}, kernels/interleaved/{agreement, far_fields, receiver}, the material set

/// What the far fields under a window hold together.
struct Mixture {
    /// Their light.
    far: Gathered,
    /// The part of the window that agrees with the pixel.
    window: f32,
}

/// The mixture of no far field.
fn empty_mixture() -> Mixture {
    return Mixture(Gathered(vec3f(0.0), vec3f(0.0)), 0.0);
}

/// Whether a pixel may take the far field of a block at `surface`.
fn accepts_far_field(at: Receiver, surface: InputSurface) -> bool {
    return select(surface.material != NO_MATERIAL, surface.material == at.surface.material, REJECT_BY_MATERIAL);
}

/// Share of a far field that a pixel may take: 1 for one of its own surface, 0 for another material's.
fn far_field_agreement(at: Receiver, field: FarField) -> f32 {
    let apart = at.depth_scale * field.depth_factor * (field.surface.distance_mm - at.surface.distance_mm);
    return select(0.0, remote_agreement(apart), accepts_far_field(at, field.surface));
}

/// `mixture` with the part `share` of a field, as far as it agrees with the pixel.
fn with_field(mixture: Mixture, at: Receiver, field: FarField, share: f32) -> Mixture {
    let agreed = share * far_field_agreement(at, field);
    let far = Gathered(agreed * field.light.irradiance, agreed * field.light.weight);
    return Mixture(together(mixture.far, far), mixture.window + agreed);
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
