// uses: gather/curve, kernel/constants, light/fresnel, the material set

// How much of the light the specular lobe sends back: E(μ) = F₀ a + F₉₀ b, since Schlick's term is linear in both. The
// compiler bakes a and b over the root of the cosine and the roughness, from the very lobe of light/specular.

/// A row of the curves at a place in steps, with the next row as far as `upper` says.
fn specular_curve(row: i32, upper: f32, place: f32) -> f32 {
    let step = clamp(floor(place), 0.0, f32(CURVE_STEPS) - 1.0);
    let texel = curve_texel(row, i32(step));
    let start_and_rise = mix(texel.xy, texel.zw, upper);
    return start_and_rise.x + start_and_rise.y * (place - step);
}

/// E(μ): share of the light that the lobe sends back where light enters, or would leave, at this cosine.
fn specular_albedo(cosine: f32, roughness: f32, reflectance_at_normal: f32) -> f32 {
    let place = clamp(roughness, 0.0, 1.0) * f32(SPECULAR_ROUGHNESSES - 1);
    let lower = min(floor(place), f32(SPECULAR_ROUGHNESSES - 2));
    let row = SPECULAR_ALBEDO_ROW + i32(lower);
    let steps = sqrt(clamp(cosine, 0.0, 1.0)) * f32(CURVE_STEPS);
    return reflectance_at_normal * specular_curve(row, place - lower, steps)
        + grazing_reflectance(reflectance_at_normal)
            * specular_curve(row + SPECULAR_ROUGHNESSES, place - lower, steps);
}

/// Ē = 2 ∫ E(μ) μ dμ: the same of light that comes from everywhere alike.
fn specular_albedo_mean(roughness: f32, reflectance_at_normal: f32) -> f32 {
    let place = clamp(roughness, 0.0, 1.0) * f32(CURVE_STEPS);
    let step = min(floor(place), f32(CURVE_STEPS) - 1.0);
    // Both means in one texel: a row and the next.
    let texel = curve_texel(SPECULAR_MEAN_ROW, i32(step));
    let means = texel.xz + texel.yw * (place - step);
    return reflectance_at_normal * means.x + grazing_reflectance(reflectance_at_normal) * means.y;
}
