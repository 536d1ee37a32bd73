// uses: lib/{angle, dipole_source, exponential_source_sum}, profile/constants

// The dipole of diffusion theory: R(r) = α′/4π (z_r (1 + s d_r) e^(−s d_r)/d_r³ + z_v (1 + s d_v) e^(−s d_v)/d_v³),
// d = √(r² + z²).
// [J01] Jensen, Marschner, Levoy and Hanrahan 2001, "A Practical Model for Subsurface Light Transport", eq. (4).

/// What was measured of a medium, per channel (red, green, blue).
struct DipoleModel {
    /// σs′, mm⁻¹.
    reduced_scattering_per_mm: vec3f,
    /// σa, mm⁻¹.
    absorption_per_mm: vec3f,
    /// η, of the medium against what is outside.
    refractive_index: f32,
}

/// F_dr: the share of diffuse light that the surface reflects back inside.
fn dipole_internal_reflectance(refractive_index: f32) -> f32 {
    let n = refractive_index;
    if n >= 1.0 {
        let c = INTERNAL_REFLECTANCE;
        return c.x / (n * n) + c.y / n + c.z + c.w * n;
    }
    let c = INTERNAL_REFLECTANCE_BELOW_1;
    return c.x + c.y / n + c.z / (n * n) + c.w / (n * n * n);
}

/// (z_r, z_v, s, share of the source at z_r); z in mm, s in mm⁻¹. The medium is what it is: neither the surface albedo
/// nor a length enters.
fn dipole_profile(model: DipoleModel, channel: u32) -> vec4f {
    let absorption = model.absorption_per_mm[channel];
    let extinction = model.reduced_scattering_per_mm[channel] + absorption;
    let attenuation = sqrt(3.0 * absorption * extinction);
    let reflectance = dipole_internal_reflectance(model.refractive_index);
    let depth = 1.0 / extinction;
    // z_v = z_r (1 + 4A/3), A = (1 + F)/(1 − F).
    let image_depth = depth * (1.0 + 4.0 / 3.0 * (1.0 + reflectance) / (1.0 - reflectance));
    // A source sends e^(−sz) of its light through the surface in all.
    let share = 1.0 / (1.0 + exp(-attenuation * (image_depth - depth)));
    return vec4f(depth, image_depth, attenuation, share);
}

/// 2πr R(r) / A, divided by r.
fn dipole_field(profile: vec4f, radius_mm: f32) -> f32 {
    let real = dipole_source_field(profile.x, profile.z, radius_mm);
    let image = dipole_source_field(profile.y, profile.z, radius_mm);
    return mix(image, real, profile.w);
}

/// R(r) / A per unit area, mm⁻².
fn dipole_area_pdf(profile: vec4f, radius_mm: f32) -> f32 {
    return dipole_field(profile, radius_mm) / TAU;
}

/// 2πr R(r) / A per unit radius, mm⁻¹.
fn dipole_radial_pdf(profile: vec4f, radius_mm: f32) -> f32 {
    return radius_mm * dipole_field(profile, radius_mm);
}

/// Fraction of the reflected energy that leaves within `radius_mm`.
fn dipole_radial_cdf(profile: vec4f, radius_mm: f32) -> f32 {
    let real = dipole_source_cdf(profile.x, profile.z, radius_mm);
    let image = dipole_source_cdf(profile.y, profile.z, radius_mm);
    return mix(image, real, profile.w);
}

/// Inverse of `dipole_radial_cdf`.
fn dipole_sample_radius(profile: vec4f, u: f32) -> f32 {
    let weights = vec4f(0.0, 0.0, profile.w, 1.0 - profile.w);
    // There are no exponentials: lengths as good as any.
    return exponential_source_radius(weights, profile.xy, profile.xy, profile.z, u);
}
