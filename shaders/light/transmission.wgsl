// uses: gather/{channel, material, profile}, lib/{slab, vogel_disc}, light/{light, lit_surface}, the material set; needs: shadow_maps

// Light that enters on the far side of an object and leaves on this one. How far it travels in between, the light's
// shadow map says; what is left of it, the material's law.

/// Taps over which the transmittance is averaged.
const THICKNESS_TAPS: u32 = 4u;

/// Share of a profile's light beyond a radius of `thickness_mm`, times the surface albedo: ∫ R(√(r² + t²)) 2πr dr =
/// A (1 − cdf(t)). Jimenez et al. 2010, "Real-Time Realistic Skin Translucency", take it for what a slab lets through.
fn profile_transmittance(profiles: ChannelProfiles, surface_albedo: vec3f, thickness_mm: f32) -> vec3f {
    return surface_albedo * (vec3f(1.0) - channel_radial_cdf(profiles, thickness_mm));
}

/// What a thickness of a material lets through, by the law that it has; its lengths are `length_scale` times as long.
fn material_transmittance(
    surface: MaterialSurface,
    profiles: ChannelProfiles,
    surface_albedo: vec3f,
    slab_albedo: vec3f,
    length_scale: f32,
    thickness_mm: f32,
) -> vec3f {
    let scaled_mm = thickness_mm / length_scale;
    if !PROFILES_TRANSMIT {
        return slab_transmittance(slab_albedo, surface.slab_mean_free_path_mm, scaled_mm);
    }
    let is_slab = surface.slab_mean_free_path_mm.r > 0.0;
    let slab_length = select(vec3f(1.0), surface.slab_mean_free_path_mm, is_slab);
    let of_slab = slab_transmittance(slab_albedo, slab_length, scaled_mm);
    return select(profile_transmittance(profiles, surface_albedo, scaled_mm), of_slab, is_slab);
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

/// Light that comes through to a point.
struct Transmitted {
    /// Share of what enters on the far side.
    share: vec3f,
    /// Cosine by which it enters there: those of the faces of a slab are alike, those of a rim are not.
    cosine: f32,
}

/// The mean transmittance around the point, where that `is_wanted`. The material's lengths are `length_scale` times as
/// long.
fn transmitted(
    is_wanted: bool,
    light: Light,
    towards: vec3f,
    world_position: vec3f,
    normal: vec3f,
    surface: MaterialSurface,
    profiles: ChannelProfiles,
    surface_albedo: vec3f,
    slab_albedo: vec3f,
    length_scale: f32,
) -> Transmitted {
    let facing_away = max(-dot(normal, towards), 0.0);
    // A texel's neighbours, and half the disc: a rim as round as that stays outside.
    let texel = 2.0 * map_place(light, world_position).half_width / f32(textureDimensions(shadow_maps).x);
    let moved = 1.5 * texel + 0.5 * light.thickness_filter_radius;
    let inside = world_position - moved * normal;
    // A disc in the shaded face, not across the light: there a slab has one thickness.
    let axis = select(vec3f(0.0, 1.0, 0.0), vec3f(1.0, 0.0, 0.0), abs(normal.y) > 0.9);
    let across = light.thickness_filter_radius * normalize(cross(normal, axis));
    let along = cross(normal, across);
    // A ray's way is longer than that along the axis.
    let per_axis = light.millimetres_per_world_unit / max(-dot(towards, light.forward), 0.05);
    // A lamp is nearer to where its light entered: that falls by the square of the distance from there.
    let is_lamp = light.is_lamp != 0u;
    let from_lamp = length(light.eye - world_position);
    var through = vec3f(0.0);
    var thickness_mm = 0.0;
    var seen = 0.0;
    var cosines = 0.0;
    var direction = vec2f(1.0, 0.0);
    // Software drivers run both sides of a branch, but no more of a loop than there is to do.
    let taps = select(0u, THICKNESS_TAPS, is_wanted);
    for (var tap = 0u; tap < taps; tap += 1u) {
        let offset = vogel_radius(tap, THICKNESS_TAPS) * direction;
        direction = next_vogel_direction(direction);
        let place = map_place(light, inside + offset.x * across + offset.y * along);
        let lit = lit_surface(shadow_maps, light, place.coordinate);
        let way_mm = (place.distance - lit.distance) * per_axis;
        let lit_facing = lit_normal(light, lit, place.coordinate);
        let parallel = clamp(-dot(lit_facing, normal), 0.0, 1.0);
        let moved_mm = moved * light.millimetres_per_world_unit;
        let found_mm = thickness_between(way_mm, moved_mm, facing_away, parallel);
        // Where the map saw nothing, nothing comes through: what was not measured does not glow.
        let seen_here = select(0.0, 1.0, lit.is_seen);
        let way = max(way_mm, 0.0) / light.millimetres_per_world_unit;
        let nearer = from_lamp / max(from_lamp - way, max(light.source, light.least_distance));
        let counts = seen_here * select(1.0, nearer * nearer, is_lamp);
        through += counts * slab_transmittance(slab_albedo, surface.slab_mean_free_path_mm * length_scale, found_mm);
        thickness_mm += seen_here * found_mm;
        seen += seen_here;
        // Where a part of it is not seen the lit face has no slope.
        let has_slope = any(lit.slope != vec2f(0.0)) || facing_away > 0.999;
        cosines += seen_here * select(facing_away, clamp(dot(lit_facing, towards), 0.0, 1.0), has_slope);
    }
    through /= f32(THICKNESS_TAPS);
    // The geometric mean of both faces' cosines: of a slab either, and at the terminator 0, where the light of the lit
    // side diffuses to already.
    let cosine = sqrt(facing_away * select(facing_away, cosines / max(seen, 1.0), seen > 0.0));
    if !PROFILES_TRANSMIT {
        return Transmitted(through, cosine);
    }
    // The profile's integral is dear: once, at the mean.
    let mean_mm = thickness_mm / max(seen, 1.0) / length_scale;
    let of_profile = profile_transmittance(profiles, surface_albedo, mean_mm) * (seen / f32(THICKNESS_TAPS));
    let is_slab = surface.slab_mean_free_path_mm.r > 0.0;
    return Transmitted(select(of_profile, through, is_slab), cosine);
}
