// uses: lib/{angle, dipole_source, exponential, exponential_source_sum, numeric_limits}

// Two exponentials + dipole: 1 − cdf(r) = w ((1 − a) e^(−r/d) + a e^(−r/bd)) + (1 − w) ((1 − h) D(z) + h D(kz)),
// D(z) = (z/ρ) e^(−s(ρ − z)), ρ = √(r² + z²).
// Exponentials for the light that scattered a few times near the entry, and the two sources of a dipole for the rest.

/// Coefficients of 1, x, x² and x³ for a mean free path of 1; x = 6A / (1 + 5A).
struct TwoExponentialDipoleModel {
    /// w: share of the exponentials.
    exponential_weight: vec4f,
    /// d: length of the long exponential.
    exponential_length: vec4f,
    /// z: depth of the first source.
    dipole_depth: vec4f,
    /// s / (1 − A): attenuation of the field of both sources.
    dipole_attenuation: vec4f,
    /// (a, b, h, k): share and relative length of the short exponential, share and relative depth of the second source.
    shape: vec4f,
}

/// (w, d, z, s) at this surface albedo; d and z in mm, s in mm⁻¹.
fn two_exponential_dipole_profile(
    model: TwoExponentialDipoleModel,
    surface_albedo: f32,
    mean_free_path_mm: f32,
) -> vec4f {
    let x = 6.0 * surface_albedo / (1.0 + 5.0 * surface_albedo);
    let powers = vec4f(1.0, x, x * x, x * x * x);
    return vec4f(
        dot(model.exponential_weight, powers),
        dot(model.exponential_length, powers) * mean_free_path_mm,
        dot(model.dipole_depth, powers) * mean_free_path_mm,
        (1.0 - surface_albedo) * dot(model.dipole_attenuation, powers) / mean_free_path_mm,
    );
}

/// Shares of the energy: long and short exponential, first and second source.
fn two_exponential_dipole_weights(profile: vec4f, shape: vec4f) -> vec4f {
    let dipole = 1.0 - profile.x;
    return vec4f(
        profile.x * (1.0 - shape.x),
        profile.x * shape.x,
        dipole * (1.0 - shape.z),
        dipole * shape.z,
    );
}

/// What the exponentials add to 2πr R(r) / A.
fn two_exponential_dipole_near(profile: vec4f, shape: vec4f, radius_mm: f32) -> f32 {
    let lengths = profile.y * vec2f(1.0, shape.y);
    let shares = profile.x * vec2f(1.0 - shape.x, shape.x);
    return dot(shares / lengths, exp(-radius_mm / lengths));
}

/// What the sources add to 2πr R(r) / A, divided by r.
fn two_exponential_dipole_field(profile: vec4f, shape: vec4f, radius_mm: f32) -> f32 {
    let first = dipole_source_field(profile.z, profile.w, radius_mm);
    let second = dipole_source_field(profile.z * shape.w, profile.w, radius_mm);
    return (1.0 - profile.x) * mix(first, second, shape.z);
}

/// R(r) / A per unit area, mm⁻². Diverges at r = 0.
fn two_exponential_dipole_area_pdf(profile: vec4f, shape: vec4f, radius_mm: f32) -> f32 {
    let near = two_exponential_dipole_near(profile, shape, radius_mm) / max(radius_mm, SMALLEST_RADIUS_MM);
    return (near + two_exponential_dipole_field(profile, shape, radius_mm)) / TAU;
}

/// 2πr R(r) / A per unit radius, mm⁻¹.
fn two_exponential_dipole_radial_pdf(profile: vec4f, shape: vec4f, radius_mm: f32) -> f32 {
    let near = two_exponential_dipole_near(profile, shape, radius_mm);
    return near + radius_mm * two_exponential_dipole_field(profile, shape, radius_mm);
}

/// Fraction of the reflected energy that leaves within `radius_mm`.
fn two_exponential_dipole_radial_cdf(profile: vec4f, shape: vec4f, radius_mm: f32) -> f32 {
    let long = radius_mm / profile.y;
    let near = mix(one_minus_exp(long), one_minus_exp(long / shape.y), shape.x);
    let first = dipole_source_cdf(profile.z, profile.w, radius_mm);
    let second = dipole_source_cdf(profile.z * shape.w, profile.w, radius_mm);
    return mix(mix(first, second, shape.z), near, profile.x);
}

/// Inverse of `two_exponential_dipole_radial_cdf`.
fn two_exponential_dipole_sample_radius(profile: vec4f, shape: vec4f, u: f32) -> f32 {
    let weights = two_exponential_dipole_weights(profile, shape);
    let lengths = profile.y * vec2f(1.0, shape.y);
    let depths = profile.z * vec2f(1.0, shape.w);
    return exponential_source_radius(weights, lengths, depths, profile.w, u);
}
