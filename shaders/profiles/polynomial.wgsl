// uses: lib/{angle, exponential, numeric_limits, single_scattering_albedo}

// Polynomial profile: r R(r) = (a r + b) / (r + c) for r < r_max = −b/a, else 0.
// [L23] Liang et al. 2023. r_max is printed there as −a/b; only −b/a is a length.

/// Coefficients of [L23] eq. (11)–(15) in the single-scattering albedo α, for a mean free path of 1.
struct PolynomialModel {
    /// a(α) = linear·α + amplitude·10^(decades·(α − 1))
    a_linear: f32,
    a_amplitude: f32,
    a_decades: f32,
    /// b(α) = scale·α^((curvature·(α − pivot)² + offset)·α + exponent)
    b_scale: f32,
    b_curvature: f32,
    b_pivot: f32,
    b_offset: f32,
    b_exponent: f32,
    /// c(α) = amplitude·e^(rate·α) + offset
    c_amplitude: f32,
    c_rate: f32,
    c_offset: f32,
}

/// Below this surface albedo r_max shrinks to 0 with α^0.3: the shape is held, since nothing is reflected anyway.
const POLYNOMIAL_SMALLEST_SURFACE_ALBEDO: f32 = 1e-6;

/// (a′, b′, c, r_max): 2π r R(r) / A = (a′ r + b′) / (r + c), mm; normalized by its own cdf(r_max), [L23] eq. (18).
fn polynomial_profile(model: PolynomialModel, surface_albedo: f32, mean_free_path_mm: f32) -> vec4f {
    let held = max(surface_albedo, POLYNOMIAL_SMALLEST_SURFACE_ALBEDO);
    let alpha = single_scattering_albedo_searchlight(held);
    let a = model.a_linear * alpha + model.a_amplitude * exp2(LOG2_10 * model.a_decades * (alpha - 1.0));
    let from_pivot = alpha - model.b_pivot;
    let b = model.b_scale
        * pow(alpha, (model.b_curvature * from_pivot * from_pivot + model.b_offset) * alpha + model.b_exponent);
    let c = model.c_amplitude * exp(model.c_rate * alpha) + model.c_offset;
    let r_max = -b / a;
    // ∫₀^r_max (a r + b) / (r + c) dr, [L23] eq. (17) without its 2π/A.
    let integral = a * r_max + (b - a * c) * log_one_plus(r_max / c);
    return vec4f(
        a / (integral * mean_free_path_mm),
        b / integral,
        c * mean_free_path_mm,
        r_max * mean_free_path_mm,
    );
}

const LOG2_10: f32 = 3.32192809;

/// R(r) / A per unit area, mm⁻². Diverges at r = 0.
fn polynomial_area_pdf(profile: vec4f, radius_mm: f32) -> f32 {
    return polynomial_radial_pdf(profile, radius_mm) / (TAU * max(radius_mm, SMALLEST_RADIUS_MM));
}

/// 2πr R(r) / A per unit radius, mm⁻¹; 0 beyond r_max.
fn polynomial_radial_pdf(profile: vec4f, radius_mm: f32) -> f32 {
    if radius_mm >= profile.w {
        return 0.0;
    }
    return (profile.x * radius_mm + profile.y) / (radius_mm + profile.z);
}

/// Fraction of the reflected energy that leaves within `radius_mm`, [L23] eq. (17), (18):
/// a′ r + (b′ − a′ c) ln(1 + r/c).
fn polynomial_radial_cdf(profile: vec4f, radius_mm: f32) -> f32 {
    let r = min(radius_mm, profile.w);
    let log_term = (profile.y - profile.x * profile.z) * log_one_plus(r / profile.z);
    return min(profile.x * r + log_term, 1.0);
}

/// Inverse of `polynomial_radial_cdf`.
///
/// The CDF is concave, so Newton's method rises monotonically from any start left of the root. Two such starts: the
/// tangent at 0, and the parabola at r_max, where the density falls to 0 at its slowest.
fn polynomial_sample_radius(profile: vec4f, u: f32) -> f32 {
    let r_max = profile.w;
    let slope_at_end = -profile.x / (r_max + profile.z);
    let from_tangent = u * profile.z / profile.y;
    let from_parabola = r_max - sqrt(2.0 * max(1.0 - u, 0.0) / slope_at_end);
    var radius = clamp(max(from_tangent, from_parabola), 0.0, r_max);
    for (var step = 0; step < 8; step += 1) {
        let density = polynomial_radial_pdf(profile, radius);
        if density <= 0.0 {
            break;
        }
        let advance = (u - polynomial_radial_cdf(profile, radius)) / density;
        radius = clamp(radius + advance, 0.0, r_max);
        if advance <= 1e-7 * radius {
            break;
        }
    }
    return radius;
}
