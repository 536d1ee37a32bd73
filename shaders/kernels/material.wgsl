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
}

/// A profile model with its coefficients evaluated: what the functions `<model>_area_pdf` and its siblings take.
struct Profile {
    model: u32,
    coefficients: vec4f,
    /// Constants of the model that are not functions of the surface albedo; 0 for models without any.
    shape: vec4f,
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

/// Fraction of the diffusely reflected light that would leave beyond `thickness_mm`, per channel, times the surface
/// albedo: ∫ R(√(r² + t²)) 2πr dr = A (1 − cdf(t)), the light that a slab of thickness t lets through.
fn channel_transmittance(profiles: ChannelProfiles, surface_albedo: vec3f, thickness_mm: f32) -> vec3f {
    let inside = vec3f(
        profile_radial_cdf(profiles.red, thickness_mm),
        profile_radial_cdf(profiles.green, thickness_mm),
        profile_radial_cdf(profiles.blue, thickness_mm),
    );
    return surface_albedo * (vec3f(1.0) - inside);
}

/// Quantile by which profiles are compared in width: far enough out to see the tail that needs the radii.
const WIDTH_QUANTILE: f32 = 0.9;

/// Number of the channel with the widest profile at this pixel: radii are drawn from it.
fn widest_channel(profiles: ChannelProfiles) -> u32 {
    let red = profile_sample_radius(profiles.red, WIDTH_QUANTILE);
    let green = profile_sample_radius(profiles.green, WIDTH_QUANTILE);
    let blue = profile_sample_radius(profiles.blue, WIDTH_QUANTILE);
    if red >= green && red >= blue {
        return 0u;
    }
    return select(2u, 1u, green >= blue);
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
