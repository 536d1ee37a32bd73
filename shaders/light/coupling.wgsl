// uses: kernel/constants, light/{fresnel, specular_surface}

// How diffuse light knows of the specular lobe above it: what that sends back does not enter.

/// Share of the light that enters at this cosine: 1 − F(μ), or 1 − E(μ).
fn entering_share(surface: SpecularSurface, cosine: f32) -> f32 {
    if surface.coupling == COUPLING_NONE {
        return 1.0;
    }
    if surface.coupling == COUPLING_ENTRY {
        return 1.0 - fresnel_schlick(surface.reflectance_at_normal, cosine);
    }
    return 1.0 - surface_specular_albedo(surface, cosine);
}

/// The same of light that comes from everywhere alike.
fn entering_ambient_share(surface: SpecularSurface) -> f32 {
    if surface.coupling == COUPLING_NONE {
        return 1.0;
    }
    if surface.coupling == COUPLING_ENTRY {
        return 1.0 - fresnel_schlick_mean(surface.reflectance_at_normal);
    }
    return 1.0 - surface_specular_albedo_mean(surface);
}

/// Radiance that leaves where the lobe sends `specular` of the light back, over the mean of all directions, which
/// enters by `ambient_share`: (1 − E(μ))/(1 − Ē), Real-Time Rendering 4, eq. 9.65. It makes the surface reciprocal, and
/// white where nothing is absorbed.
fn leaving_share(surface: SpecularSurface, specular: f32, ambient_share: f32) -> f32 {
    return select(1.0, (1.0 - specular) / max(ambient_share, 1e-4), surface.coupling == COUPLING_FULL);
}
