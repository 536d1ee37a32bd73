//! Reflection at the surface.

/// Fraction of unpolarised light that a smooth boundary reflects (Fresnel).
///
/// `cosine` is that of the angle with the normal in the denser medium, `refractive_index` ≥ 1 the denser medium's
/// over the other's. It is the same from either side. 1 beyond the critical angle.
#[inline]
pub(crate) fn reflectance(cosine: f64, refractive_index: f64) -> f64 {
    let sine_squared_outside = refractive_index * refractive_index * (1.0 - cosine * cosine);
    if sine_squared_outside >= 1.0 {
        return 1.0;
    }
    let cosine_outside = (1.0 - sine_squared_outside).sqrt();
    let perpendicular =
        (refractive_index * cosine - cosine_outside) / (refractive_index * cosine + cosine_outside);
    let parallel =
        (cosine - refractive_index * cosine_outside) / (cosine + refractive_index * cosine_outside);
    0.5 * (perpendicular * perpendicular + parallel * parallel)
}

/// Cosine inside of a ray that arrives with `cosine` outside (Snell).
#[inline]
pub(crate) fn refracted_cosine(cosine: f64, refractive_index: f64) -> f64 {
    (1.0 - (1.0 - cosine * cosine) / (refractive_index * refractive_index)).max(0.0).sqrt()
}
