// uses: lib/exponential, profile/constants

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

/// B of one channel: (1 − e^(−y))/(1 − A²), and k τ in its place where nothing is absorbed.
fn slab_return(depth: f32, lost: f32) -> f32 {
    let y = lost * depth;
    return select(one_minus_exp(y) / lost, depth, y == 0.0);
}

/// B of all channels, of k τ and 1 − A².
fn channel_slab_return(depth: vec3f, lost: vec3f) -> vec3f {
    return vec3f(slab_return(depth.r, lost.r), slab_return(depth.g, lost.g), slab_return(depth.b, lost.b));
}

/// Fraction of the light that leaves through the far face of a slab of `thickness_mm`, per channel.
fn slab_transmittance(surface_albedo: vec3f, mean_free_path_mm: vec3f, thickness_mm: f32) -> vec3f {
    let depth = slab_strength(surface_albedo) * (thickness_mm / mean_free_path_mm);
    let lost = (1.0 - surface_albedo) * (1.0 + surface_albedo);
    let returned = channel_slab_return(depth, lost);
    return exp(-0.5 * lost * depth) / (1.0 + surface_albedo * surface_albedo * returned);
}

/// Fraction of the light that comes back from the near face, per channel.
fn slab_reflectance(surface_albedo: vec3f, mean_free_path_mm: vec3f, thickness_mm: f32) -> vec3f {
    let depth = slab_strength(surface_albedo) * (thickness_mm / mean_free_path_mm);
    let lost = (1.0 - surface_albedo) * (1.0 + surface_albedo);
    let returned = channel_slab_return(depth, lost);
    return surface_albedo * returned / (1.0 + surface_albedo * surface_albedo * returned);
}
