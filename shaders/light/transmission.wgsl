// uses: gather/{channel, profile}, lib/vogel_disc, light/{directional_light, shadow}; needs: shadow_maps

/// Fraction of the diffusely reflected light that would leave beyond `thickness_mm`, per channel, times the surface
/// albedo: ∫ R(√(r² + t²)) 2πr dr = A (1 − cdf(t)), the light that a slab of thickness t lets through.
fn channel_transmittance(profiles: ChannelProfiles, surface_albedo: vec3f, thickness_mm: f32) -> vec3f {
    return surface_albedo * (vec3f(1.0) - channel_radial_cdf(profiles, thickness_mm));
}

/// Light that comes through from the far side: E(−n·l) A (1 − cdf(thickness)), the thickness measured in the shadow map
/// along the inverted normal (Jimenez et al. 2010, "Real-Time Realistic Skin Translucency").
fn transmitted_irradiance(
    light: Light,
    layer: u32,
    world_position: vec3f,
    normal: vec3f,
    profiles: ChannelProfiles,
    surface_albedo: vec3f,
) -> vec3f {
    let facing_away = -dot(normal, light.towards_light);
    if facing_away <= 0.0 {
        return vec3f(0.0);
    }
    let inside = world_position - light.shadow_normal_offset * normal;
    // Moving in shortens the way to the light, which is to be given back.
    let moved_in_mm = light.shadow_normal_offset * facing_away * light.millimetres_per_world_unit;
    // Any axis that is not the light's own spans the disc across its direction.
    let axis = select(vec3f(0.0, 1.0, 0.0), vec3f(1.0, 0.0, 0.0), abs(light.towards_light.y) > 0.9);
    let across = normalize(cross(light.towards_light, axis));
    let along = cross(light.towards_light, across);
    // The mean over a small disc hides the steps of the shadow map's texels.
    var thickness_mm = 0.0;
    var seen = 0.0;
    for (var tap = 0u; tap < SHADOW_TAPS; tap += 1u) {
        let offset = light.thickness_filter_radius * vogel_disc(tap, SHADOW_TAPS);
        let point = light.shadow_from_world * vec4f(inside + offset.x * across + offset.y * along, 1.0);
        let nearest = nearest_to_light(shadow_maps, point.xy, layer);
        if nearest < 1.0 {
            thickness_mm += max(point.z - nearest, 0.0) * light.shadow_range_mm + moved_in_mm;
            seen += 1.0;
        }
    }
    if seen == 0.0 {
        return vec3f(0.0); // the map saw nothing here: what was not measured does not glow
    }
    // Directions in which the map saw nothing let nothing through.
    let through = channel_transmittance(profiles, surface_albedo, thickness_mm / seen) * seen / f32(SHADOW_TAPS);
    return light.irradiance * facing_away * through;
}
