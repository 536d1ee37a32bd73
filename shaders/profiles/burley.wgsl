// uses: lib/{angle, exponential, numeric_limits}

// Normalized diffusion: R(r) = A (e^(−r/d) + e^(−r/3d)) / (8π d r).
// [CB15] Christensen and Burley 2015, "Approximate Reflectance Profiles for Efficient Subsurface Scattering".

/// Coefficients of the shape s(A) = constant + slope·A + amplitude·|A − pivot|^exponent, [CB15] eq. (5), (6), (8).
struct BurleyModel {
    constant: f32,
    slope: f32,
    amplitude: f32,
    pivot: f32,
    exponent: f32,
}

/// (d, 0, 0, 0): the scattering distance d = length / s(A), mm, [CB15] eq. (3).
fn burley_profile(model: BurleyModel, surface_albedo: f32, mean_free_path_mm: f32) -> vec4f {
    // pow(0, y) is undefined where it is lowered to exp2(y log2(0)).
    let distance_to_pivot = max(abs(surface_albedo - model.pivot), 1e-20);
    let s = model.constant + model.slope * surface_albedo + model.amplitude * pow(distance_to_pivot, model.exponent);
    return vec4f(mean_free_path_mm / s, 0.0, 0.0, 0.0);
}

/// R(r) / A per unit area, mm⁻². Diverges at r = 0.
fn burley_area_pdf(profile: vec4f, radius_mm: f32) -> f32 {
    return burley_radial_pdf(profile, radius_mm) / (TAU * max(radius_mm, SMALLEST_RADIUS_MM));
}

/// 2πr R(r) / A per unit radius, mm⁻¹.
fn burley_radial_pdf(profile: vec4f, radius_mm: f32) -> f32 {
    let d = profile.x;
    let e = exp(-radius_mm / (3.0 * d)); // e^(−r/3d)
    return 0.25 * (e * e * e + e) / d;
}

/// Fraction of the reflected energy that leaves within `radius_mm`, [CB15] eq. (11):
/// 1 − ¼ e^(−r/d) − ¾ e^(−r/3d).
fn burley_radial_cdf(profile: vec4f, radius_mm: f32) -> f32 {
    let x = radius_mm / profile.x;
    return 0.25 * one_minus_exp(x) + 0.75 * one_minus_exp(x / 3.0);
}

/// Inverse of `burley_radial_cdf`, exact (Golubev 2018).
///
/// With y = e^(−r/3d) the CDF reads y³ + 3y = 4(1 − u), whose real root is y = G − 1/G,
/// G³ = 2(1 − u) + √(1 + 4(1 − u)²). Written as 4(1 − u) / (G² + 1 + G⁻²) it does not cancel as u → 1.
fn burley_sample_radius(profile: vec4f, u: f32) -> f32 {
    let rest = 1.0 - min(u, LARGEST_BELOW_ONE);
    let g = pow(2.0 * rest + sqrt(1.0 + 4.0 * rest * rest), 1.0 / 3.0);
    let y = 4.0 * rest / (g * g + 1.0 + 1.0 / (g * g));
    return max(-3.0 * profile.x * log(y), 0.0);
}
