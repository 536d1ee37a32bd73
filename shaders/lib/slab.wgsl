// uses: profile/constants

// A slab of a medium, light falling on one face: two fluxes after Kubelka and Munk 1931, with a strength k that was
// fitted to random walks. A is the surface albedo of a slab without end, τ = t/ℓ its thickness in mean free paths.
//
//     y = (1 − A²) k τ,   B = k τ (1 − e^(−y))/y,   T = e^(−y/2)/(1 + A² B),   R = A B/(1 + A² B)
//
// A = 0 gives T = e^(−τ), A = 1 gives T = 1/(1 + k τ) = 1 − R.

/// k = 2 (1 + s₁A)/(1 + s₂A + s₃A²).
fn slab_strength(surface_albedo: vec3f) -> vec3f {
    let s = SLAB_STRENGTH;
    return 2.0 * (1.0 + s.x * surface_albedo) / (1.0 + (s.y + s.z * surface_albedo) * surface_albedo);
}

/// (1 − e^(−y))/y for y ≥ 0, of e^(−y/2): where y is small by its series, whose next term is y⁵/720.
fn mean_exponential(y: vec3f, root: vec3f) -> vec3f {
    let series = 1.0 - y / 2.0 * (1.0 - y / 3.0 * (1.0 - y / 4.0 * (1.0 - y / 5.0)));
    return select((1.0 - root * root) / max(y, vec3f(SMALL_LOSS)), series, y < vec3f(SMALL_LOSS));
}

/// Below it the series is exact to f32 rounding.
const SMALL_LOSS: f32 = 0.125;

/// Fraction of the light that leaves through the far face of a slab of `thickness_mm`, per channel.
fn slab_transmittance(surface_albedo: vec3f, mean_free_path_mm: vec3f, thickness_mm: f32) -> vec3f {
    let depth = slab_strength(surface_albedo) * (thickness_mm / mean_free_path_mm);
    let y = (1.0 - surface_albedo) * (1.0 + surface_albedo) * depth;
    let root = exp(-0.5 * y);
    return root / (1.0 + surface_albedo * surface_albedo * depth * mean_exponential(y, root));
}

/// Light that comes back from the near face, over what does from a slab without end: R/A, per channel.
fn slab_returned(surface_albedo: vec3f, mean_free_path_mm: vec3f, thickness_mm: f32) -> vec3f {
    let depth = slab_strength(surface_albedo) * (thickness_mm / mean_free_path_mm);
    let y = (1.0 - surface_albedo) * (1.0 + surface_albedo) * depth;
    let returned = depth * mean_exponential(y, exp(-0.5 * y));
    return returned / (1.0 + surface_albedo * surface_albedo * returned);
}

/// Fraction of the light that comes back from the near face, per channel.
fn slab_reflectance(surface_albedo: vec3f, mean_free_path_mm: vec3f, thickness_mm: f32) -> vec3f {
    return surface_albedo * slab_returned(surface_albedo, mean_free_path_mm, thickness_mm);
}
