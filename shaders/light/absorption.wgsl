// Light on its way through what is clear (Akenine-Möller et al. 2018, "Real-Time Rendering", section 14.5).

/// T = e^(−σ d): what is left after `way_mm` of a medium that absorbs σ per mm (Beer 1852). T(d₁ + d₂) = T(d₁) T(d₂).
fn absorption_transmittance(absorption_per_mm: vec3f, way_mm: f32) -> vec3f {
    return exp(-absorption_per_mm * way_mm);
}

/// Way through a wall that a ray crosses at this cosine to its normal, mm: t/max(0.001, n·v).
fn shell_way_mm(thickness_mm: f32, cosine: f32) -> f32 {
    return thickness_mm / max(0.001, cosine);
}

/// Share that two faces of a wall send back, each of which reflects `fresnel`, with all that goes to and fro between them:
/// R = 2F/(1 + F).
fn wall_reflectance(fresnel: f32) -> f32 {
    return 2.0 * fresnel / (1.0 + fresnel);
}
