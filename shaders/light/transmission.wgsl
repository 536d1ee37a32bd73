// uses: gather/{channel, material, profile}, lib/{slab, vogel_disc}, light/{directional_light, lit_surface}; needs: shadow_maps

// Light that enters on the far side of an object and leaves on this one. How far it travels in between, the light's
// shadow map says; what is left of it, the material's law.

/// Taps over which the transmittance is averaged.
const THICKNESS_TAPS: u32 = 4u;

/// Share of a profile's light beyond a radius of `thickness_mm`, times the surface albedo: ∫ R(√(r² + t²)) 2πr dr =
/// A (1 − cdf(t)). Jimenez et al. 2010, "Real-Time Realistic Skin Translucency", take it for what a slab lets through.
fn profile_transmittance(profiles: ChannelProfiles, surface_albedo: vec3f, thickness_mm: f32) -> vec3f {
    return surface_albedo * (vec3f(1.0) - channel_radial_cdf(profiles, thickness_mm));
}

/// Thickness of an object, mm: `way_mm` is the light's way through it to a point that was moved in by `moved_mm`, and
/// may be below 0 where that came out on the lit side.
///
/// Where the lit face is perpendicular to the light it is that way; where it is parallel to the shaded face, the way
/// times the cosine that both have: a slab is as thick for every angle (Green 2004, "Real-Time Approximations to
/// Subsurface Scattering"; d'Eon and Luebke 2007, "Advanced Techniques for Realistic Real-Time Skin Rendering").
fn thickness_between(way_mm: f32, moved_mm: f32, facing_away: f32, parallel: f32) -> f32 {
    let along_light = max(way_mm + moved_mm * facing_away, 0.0);
    let across_slab = max(way_mm * facing_away + moved_mm, 0.0);
    return mix(along_light, across_slab, parallel);
}

/// Share of the light that enters on the far side which comes through: the mean transmittance around the point.
fn transmitted_share(
    light: Light,
    layer: u32,
    world_position: vec3f,
    normal: vec3f,
    surface: MaterialSurface,
    profiles: ChannelProfiles,
    surface_albedo: vec3f,
) -> vec3f {
    let facing_away = max(-dot(normal, light.towards_light), 0.0);
    let moved_mm = light.thickness_normal_offset * light.millimetres_per_world_unit;
    let inside = light.shadow_from_world * vec4f(world_position - light.thickness_normal_offset * normal, 1.0);
    // A disc in the shaded face, not across the light: there a slab has one thickness.
    let axis = select(vec3f(0.0, 1.0, 0.0), vec3f(1.0, 0.0, 0.0), abs(normal.y) > 0.9);
    let across = normalize(cross(normal, axis));
    let along = cross(normal, across);
    let radius = light.thickness_filter_radius;
    let step_across = (light.shadow_from_world * vec4f(radius * across, 0.0)).xyz;
    let step_along = (light.shadow_from_world * vec4f(radius * along, 0.0)).xyz;
    let is_slab = surface.slab_mean_free_path_mm.r > 0.0;
    var through = vec3f(0.0);
    var thickness_mm = 0.0;
    var seen = 0.0;
    for (var tap = 0u; tap < THICKNESS_TAPS; tap += 1u) {
        let offset = vogel_disc(tap, THICKNESS_TAPS);
        let point = inside.xyz + offset.x * step_across + offset.y * step_along;
        let lit = lit_surface(shadow_maps, point.xy, layer);
        let way_mm = (point.z - lit.depth) * light.shadow_range_mm;
        let parallel = clamp(-dot(lit_normal(light, lit), normal), 0.0, 1.0);
        let found_mm = thickness_between(way_mm, moved_mm, facing_away, parallel);
        // Where the map saw nothing, nothing comes through: what was not measured does not glow.
        let counts = select(0.0, 1.0, lit.is_seen);
        through += counts * slab_transmittance(surface_albedo, surface.slab_mean_free_path_mm, found_mm);
        thickness_mm += counts * found_mm;
        seen += counts;
    }
    if is_slab {
        return through / f32(THICKNESS_TAPS);
    }
    // The profile's integral is dear: once, at the mean.
    let mean_mm = thickness_mm / max(seen, 1.0);
    return profile_transmittance(profiles, surface_albedo, mean_mm) * (seen / f32(THICKNESS_TAPS));
}
