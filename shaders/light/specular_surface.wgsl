// uses: light/{specular, specular_albedo}, the material set

/// A boundary with its lobes: f = (1 − w) f(r₁) + w f(r₂), over one F₀.
struct SpecularSurface {
    /// One of the `COUPLING_…` constants: how the diffuse light below knows of it.
    coupling: u32,
    /// F₀.
    reflectance_at_normal: f32,
    /// r₁.
    roughness: f32,
    /// r₂.
    second_roughness: f32,
    /// w.
    second_weight: f32,
}

/// BRDF of both lobes times n·l, sr⁻¹.
fn surface_reflection(surface: SpecularSurface, normal: vec3f, light: vec3f, view: vec3f) -> f32 {
    let first = specular_reflection(normal, light, view, surface.reflectance_at_normal, surface.roughness);
    if !SECOND_LOBES {
        return first;
    }
    let second = specular_reflection(normal, light, view, surface.reflectance_at_normal, surface.second_roughness);
    return first + surface.second_weight * (second - first);
}

/// E(μ) of both.
fn surface_specular_albedo(surface: SpecularSurface, cosine: f32) -> f32 {
    let first = specular_albedo(cosine, surface.roughness, surface.reflectance_at_normal);
    if !SECOND_LOBES {
        return first;
    }
    let second = specular_albedo(cosine, surface.second_roughness, surface.reflectance_at_normal);
    return first + surface.second_weight * (second - first);
}

/// E(μ) of the second alone.
fn second_specular_albedo(surface: SpecularSurface, cosine: f32) -> f32 {
    return specular_albedo(cosine, surface.second_roughness, surface.reflectance_at_normal);
}

/// Ē of both.
fn surface_specular_albedo_mean(surface: SpecularSurface) -> f32 {
    let first = specular_albedo_mean(surface.roughness, surface.reflectance_at_normal);
    if !SECOND_LOBES {
        return first;
    }
    let second = specular_albedo_mean(surface.second_roughness, surface.reflectance_at_normal);
    return first + surface.second_weight * (second - first);
}
