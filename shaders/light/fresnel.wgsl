/// Schlick 1994: F = F₀ + (1 − F₀)(1 − cosθ)⁵.
fn fresnel_schlick(reflectance_at_normal: f32, cosine: f32) -> f32 {
    let grazing = 1.0 - clamp(cosine, 0.0, 1.0);
    let grazing2 = grazing * grazing;
    return reflectance_at_normal + (1.0 - reflectance_at_normal) * grazing2 * grazing2 * grazing;
}

/// Cosine-weighted mean of Schlick's F over the hemisphere: F₀ + (1 − F₀)/21, since ∫₀¹ 2μ (1 − μ)⁵ dμ = 1/21.
fn fresnel_schlick_mean(reflectance_at_normal: f32) -> f32 {
    return reflectance_at_normal + (1.0 - reflectance_at_normal) / 21.0;
}
