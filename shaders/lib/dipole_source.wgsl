// uses: lib/exponential

// One source of a dipole: a point of light at depth z below the surface, whose field decays with s. It sends the
// fraction (z/ρ) e^(−s(ρ − z)) of its light through the surface outside of r, ρ = √(r² + z²) (Jensen et al. 2001,
// eq. 4, divided by its integral).

/// ρ − z = r² / (ρ + z): the direct difference cancels for r ≪ z.
fn dipole_source_detour(rho: f32, depth: f32, radius_mm: f32) -> f32 {
    return radius_mm * radius_mm / (rho + depth);
}

/// Density per unit radius, divided by r: z (1 + sρ) e^(−s(ρ − z)) / ρ³.
fn dipole_source_field(depth: f32, attenuation: f32, radius_mm: f32) -> f32 {
    let rho = sqrt(radius_mm * radius_mm + depth * depth);
    let detour = dipole_source_detour(rho, depth, radius_mm);
    return (depth / rho) * (1.0 + attenuation * rho) * exp(-attenuation * detour) / (rho * rho);
}

/// Fraction of the source's light that leaves within `radius_mm`.
fn dipole_source_cdf(depth: f32, attenuation: f32, radius_mm: f32) -> f32 {
    let rho = sqrt(radius_mm * radius_mm + depth * depth);
    let detour = dipole_source_detour(rho, depth, radius_mm);
    // 1 − (z/ρ) e^(−s(ρ−z)) as a sum of two terms that are both small with r.
    return detour / rho + (depth / rho) * one_minus_exp(attenuation * detour);
}

/// Fractions of the source's light that leave within and outside of `radius_mm`, and r times the density per radius.
fn dipole_source_distribution(depth: f32, attenuation: f32, radius_mm: f32) -> vec3f {
    let rho = sqrt(radius_mm * radius_mm + depth * depth);
    let detour = dipole_source_detour(rho, depth, radius_mm);
    let decay = attenuation * detour;
    let within = detour / rho + (depth / rho) * one_minus_exp(decay);
    let outside = (depth / rho) * exp(-decay);
    let sine = radius_mm / rho;
    return vec3f(within, outside, outside * sine * sine * (1.0 + attenuation * rho));
}

/// Bounds of the radius within which the fraction u of the source's light leaves, given −ln(1 − u).
///
/// (z/ρ) e^(−s(ρ−z)) = 1 − u reads τ + sz (e^τ − 1) = −ln(1 − u) in τ = ln(ρ/z): each term alone gives an upper bound
/// of τ, and e^τ − 1 ≤ τ e^τ with that bound in the exponent gives a lower one.
fn dipole_source_radius_bounds(depth: f32, attenuation: f32, target_log: f32) -> vec2f {
    let optical_depth = attenuation * depth;
    let highest = min(target_log, log_one_plus(target_log / max(optical_depth, 1e-20)));
    let lowest = target_log / (1.0 + optical_depth * exp(highest));
    return depth * vec2f(
        exp(lowest) * sqrt(one_minus_exp(2.0 * lowest)),
        exp(highest) * sqrt(one_minus_exp(2.0 * highest)),
    );
}
