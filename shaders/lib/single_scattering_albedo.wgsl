// uses: profile/constants

/// Single-scattering albedo α of an index-matched half-space whose total diffuse reflectance under a perpendicular
/// pencil of light is `surface_albedo`.
///
/// α = 1 − q², q = (1 − A)(1 + c₁A) / (1 + c₂A + c₃A²): exact at A = 0 and A = 1, within 2.9e-4 of
/// Chandrasekhar's H functions between. Evaluated as (1 − q)(1 + q) with the difference 1 − q = A (1 − c₁ + c₂ +
/// (c₁ + c₃) A) / (1 + c₂A + c₃A²), which keeps its digits as A → 0.
fn single_scattering_albedo_searchlight(surface_albedo: f32) -> f32 {
    let a = surface_albedo;
    let c1 = SEARCHLIGHT_ALBEDO.x;
    let c2 = SEARCHLIGHT_ALBEDO.y;
    let c3 = SEARCHLIGHT_ALBEDO.z;
    let one_minus_q = a * (1.0 - c1 + c2 + (c1 + c3) * a) / (1.0 + a * (c2 + c3 * a));
    return one_minus_q * (2.0 - one_minus_q);
}
