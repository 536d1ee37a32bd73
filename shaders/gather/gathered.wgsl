// uses: kernel/constants, the material set

/// Light that was gathered, and the energy that was found for it: 1 per channel where nothing was rejected.
struct Gathered {
    /// Σ wᵢ Eᵢ
    irradiance: vec3f,
    /// Σ wᵢ
    weight: vec3f,
}

/// Sum of two lights.
fn together(a: Gathered, b: Gathered) -> Gathered {
    return Gathered(a.irradiance + b.irradiance, a.weight + b.weight);
}

/// Diffused irradiance from what was gathered. Missing energy is renormalized or, if the policy says so, returned to
/// the centre.
fn diffused_irradiance(gathered: Gathered, own: vec3f) -> vec3f {
    let least = select(SMALLEST_ENERGY, 1.0, RETURN_TO_CENTRE);
    let returned = max(vec3f(least) - gathered.weight, vec3f(0.0));
    return (gathered.irradiance + returned * own) / (gathered.weight + returned);
}
