/// What every material has, whichever profile model it uses.
struct MaterialSurface {
    /// Length that scales the profile, per channel (red, green, blue), mm: the mean free path ℓ, or the diffuse mean
    /// free path for models that are parametrized by it.
    length_mm: vec3f,
    /// Profile model: one of the `MODEL_…` constants.
    model: u32,
    /// Surface albedo A per channel where no texture overrides it, 0 to 1.
    surface_albedo: vec3f,
    /// Specular reflectance at normal incidence F₀, 0 to 1.
    reflectance_at_normal: f32,
    /// Roughness of the specular lobe (square root of the GGX α), 0 to 1.
    roughness: f32,
    /// Factor on the light that comes through from the far side, 0 for none.
    transmission_strength: f32,
    /// First row of the quantile curves of its profile in `profile_curves`.
    first_curve: u32,
    /// Number of its curves: one per node of the surface albedo, or one per channel.
    curve_count: u32,
    /// First row of the edge curves of its profile; 0 where the kernel reads none.
    first_edge: u32,
    /// Distance from an edge, in lengths of the material, at which the edge curves end; 0 where the kernel reads none.
    edge_reach: f32,
}

/// A profile model with its coefficients evaluated: what the functions `<model>_area_pdf` and its siblings take.
struct Profile {
    model: u32,
    coefficients: vec4f,
    /// Constants of the model that are not functions of the surface albedo; 0 for models without any.
    shape: vec4f,
    /// Where its quantile curve is: see `albedo_curve`.
    curve: vec3f,
}

/// The profiles of the three channels at one pixel.
struct ChannelProfiles {
    red: Profile,
    green: Profile,
    blue: Profile,
}

/// R(r) / A per unit area of the three channels, mm⁻².
fn channel_area_pdf(profiles: ChannelProfiles, radius_mm: f32) -> vec3f {
    return vec3f(
        profile_area_pdf(profiles.red, radius_mm),
        profile_area_pdf(profiles.green, radius_mm),
        profile_area_pdf(profiles.blue, radius_mm),
    );
}

/// Fraction of the reflected energy that leaves within `radius_mm`, per channel.
fn channel_radial_cdf(profiles: ChannelProfiles, radius_mm: f32) -> vec3f {
    return vec3f(
        profile_radial_cdf(profiles.red, radius_mm),
        profile_radial_cdf(profiles.green, radius_mm),
        profile_radial_cdf(profiles.blue, radius_mm),
    );
}

/// Fraction of the diffusely reflected light that would leave beyond `thickness_mm`, per channel, times the surface
/// albedo: ∫ R(√(r² + t²)) 2πr dr = A (1 − cdf(t)), the light that a slab of thickness t lets through.
fn channel_transmittance(profiles: ChannelProfiles, surface_albedo: vec3f, thickness_mm: f32) -> vec3f {
    return surface_albedo * (vec3f(1.0) - channel_radial_cdf(profiles, thickness_mm));
}

/// The profile of one channel, by its number.
fn channel_profile(profiles: ChannelProfiles, channel: u32) -> Profile {
    switch channel {
        case 0u: {
            return profiles.red;
        }
        case 1u: {
            return profiles.green;
        }
        default: {
            return profiles.blue;
        }
    }
}
