// uses: gather/profile, the material set

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
