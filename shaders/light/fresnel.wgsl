/// F₉₀: reflectance at grazing angles of a boundary that reflects F₀ at normal incidence. 1; below F₀ = 1 % (a
/// refractive index of 1.22) less, so that 0 is no boundary.
fn grazing_reflectance(reflectance_at_normal: f32) -> f32 {
    return min(100.0 * reflectance_at_normal, 1.0);
}

/// Schlick 1994: F = F₀ + (F₉₀ − F₀)(1 − cosθ)⁵.
fn fresnel_schlick(reflectance_at_normal: f32, cosine: f32) -> f32 {
    let grazing = 1.0 - clamp(cosine, 0.0, 1.0);
    let grazing2 = grazing * grazing;
    let rise = grazing_reflectance(reflectance_at_normal) - reflectance_at_normal;
    return reflectance_at_normal + rise * grazing2 * grazing2 * grazing;
}

/// Cosine-weighted mean of Schlick's F over the hemisphere: F₀ + (F₉₀ − F₀)/21, since ∫₀¹ 2μ (1 − μ)⁵ dμ = 1/21.
fn fresnel_schlick_mean(reflectance_at_normal: f32) -> f32 {
    return mix(reflectance_at_normal, grazing_reflectance(reflectance_at_normal), 1.0 / 21.0);
}
