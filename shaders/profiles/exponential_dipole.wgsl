// uses: lib/{angle, dipole_source, exponential, exponential_source_sum, numeric_limits}

// Exponential + dipole: 1 − cdf(r) = w e^(−r/d) + (1 − w) (z/ρ) e^(−s(ρ − z)), ρ = √(r² + z²).
// An exponential for the light that scattered a few times near the entry, and the field of one source at depth z
// for the rest.

/// Coefficients of 1, A and A² for a mean free path of 1.
struct ExponentialDipoleModel {
    /// w: share of the exponential.
    exponential_weight: vec3f,
    /// d: length of the exponential.
    exponential_length: vec3f,
    /// z: depth of the source.
    dipole_depth: vec3f,
    /// s / (1 − A): attenuation of the source's field.
    dipole_attenuation: vec3f,
}

/// (w, d, z, s) at this surface albedo; d and z in mm, s in mm⁻¹.
fn exponential_dipole_profile(model: ExponentialDipoleModel, surface_albedo: f32, mean_free_path_mm: f32) -> vec4f {
    let powers = vec3f(1.0, surface_albedo, surface_albedo * surface_albedo);
    return vec4f(
        dot(model.exponential_weight, powers),
        dot(model.exponential_length, powers) * mean_free_path_mm,
        dot(model.dipole_depth, powers) * mean_free_path_mm,
        (1.0 - surface_albedo) * dot(model.dipole_attenuation, powers) / mean_free_path_mm,
    );
}

/// R(r) / A per unit area, mm⁻². Diverges at r = 0.
fn exponential_dipole_area_pdf(profile: vec4f, radius_mm: f32) -> f32 {
    let exponential = profile.x * exp(-radius_mm / profile.y) / (profile.y * max(radius_mm, SMALLEST_RADIUS_MM));
    let field = (1.0 - profile.x) * dipole_source_field(profile.z, profile.w, radius_mm);
    return (exponential + field) / TAU;
}

/// 2πr R(r) / A per unit radius, mm⁻¹.
fn exponential_dipole_radial_pdf(profile: vec4f, radius_mm: f32) -> f32 {
    let exponential = profile.x * exp(-radius_mm / profile.y) / profile.y;
    return exponential + (1.0 - profile.x) * radius_mm * dipole_source_field(profile.z, profile.w, radius_mm);
}

/// Fraction of the reflected energy that leaves within `radius_mm`.
fn exponential_dipole_radial_cdf(profile: vec4f, radius_mm: f32) -> f32 {
    let dipole = dipole_source_cdf(profile.z, profile.w, radius_mm);
    return profile.x * one_minus_exp(radius_mm / profile.y) + (1.0 - profile.x) * dipole;
}

/// Inverse of `exponential_dipole_radial_cdf`.
fn exponential_dipole_sample_radius(profile: vec4f, u: f32) -> f32 {
    let weights = vec4f(profile.x, 0.0, 1.0 - profile.x, 0.0);
    return exponential_source_radius(weights, profile.yy, profile.zz, profile.w, u);
}
