/// A light, and the camera of its shadow map.
struct Light {
    /// Where the map is seen from, world space; a lamp's own position.
    eye: vec3f,
    /// Layer of its map, or NO_SHADOW_MAP.
    layer: u32,
    /// To the right in the map, unit vector in world space.
    right: vec3f,
    /// Half of the map's width at the eye, world units: 0 in perspective.
    half_width: f32,
    /// Upwards in the map.
    up: vec3f,
    /// Growth of half the width per world unit of distance: 0 where the map is orthographic.
    spread: f32,
    /// Axis of the map, away from the eye; the way of the light, or the axis of its cone.
    forward: vec3f,
    /// Distance along the axis at which the map begins.
    near: f32,
    /// Irradiance on a surface that faces the light; of a lamp, at the distance of one world unit. Red, green, blue.
    irradiance: vec3f,
    /// Distance along the axis at which the map ends.
    far: f32,
    /// Scale and offset of the cosine to the axis: its square, within 0 and 1, is the share of the light in a cone.
    cone_scale: f32,
    cone_offset: f32,
    /// Tangent of half the angle that it spans in the sky; of a lamp, its radius in world units.
    source: f32,
    /// 1: a lamp; 0: parallel rays.
    is_lamp: u32,
    /// World-space distance below which a lamp's light grows no more.
    least_distance: f32,
    /// World-space radius of the disc over which what comes through is averaged.
    thickness_filter_radius: f32,
    /// Millimetres that a world unit has.
    millimetres_per_world_unit: f32,
}

/// Light that arrives at a point.
struct Arrival {
    /// Unit vector towards the light.
    towards: vec3f,
    /// Irradiance on a surface that faces it.
    irradiance: vec3f,
}

/// What arrives at a point of a light, were nothing between.
fn light_arrival(light: Light, position: vec3f) -> Arrival {
    let offset = light.eye - position;
    let square = dot(offset, offset);
    let towards_lamp = offset * inverseSqrt(max(square, 1e-30));
    let part = clamp(light.cone_scale * -dot(towards_lamp, light.forward) + light.cone_offset, 0.0, 1.0);
    let least = max(light.source, light.least_distance);
    let of_lamp = light.irradiance * (part * part / max(square, least * least));
    let is_lamp = light.is_lamp != 0u;
    return Arrival(
        select(-light.forward, towards_lamp, is_lamp),
        select(light.irradiance, of_lamp, is_lamp),
    );
}

/// Where a point is in a light's map.
struct MapPlace {
    /// Texture coordinates.
    coordinate: vec2f,
    /// World-space distance along the map's axis.
    distance: f32,
    /// Half of the map's width there, world units.
    half_width: f32,
}

fn map_place(light: Light, position: vec3f) -> MapPlace {
    let offset = position - light.eye;
    let distance = dot(offset, light.forward);
    let half_width = light.half_width + light.spread * distance;
    let across = vec2f(dot(offset, light.right), -dot(offset, light.up));
    return MapPlace(0.5 + 0.5 * across / max(half_width, 1e-20), distance, half_width);
}

/// Depth of a distance along the axis.
fn map_depth(light: Light, distance: f32) -> f32 {
    let part = (distance - light.near) / (light.far - light.near);
    return select(part, part * light.far / max(distance, 1e-20), light.spread > 0.0);
}

/// Distances along the axis of four depths.
fn map_distances(light: Light, depths: vec4f) -> vec4f {
    let range = light.far - light.near;
    let in_perspective = light.near * light.far / (light.far - depths * range);
    return select(light.near + depths * range, in_perspective, vec4<bool>(light.spread > 0.0));
}
