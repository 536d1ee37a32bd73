// uses: light/light

/// The surface nearest to the light, as its shadow map has it around a point.
struct LitSurface {
    /// World-space distance along the map's axis: straight between the middles of texels, so that it does not step with
    /// the map's size.
    distance: f32,
    /// How it grows with both texture coordinates; 0 where a part of it is not seen.
    slope: vec2f,
    /// Whether the map saw one there.
    is_seen: bool,
}

/// The nearest surface at `position` of the light's map.
fn lit_surface(maps: texture_depth_2d_array, light: Light, position: vec2f) -> LitSurface {
    let size = vec2i(textureDimensions(maps));
    let place = position * vec2f(size) - 0.5;
    let first = vec2i(floor(place));
    let part = place - floor(place);
    // From left to right and from the top; 1 is the depth where no surface is.
    let depths = vec4f(
        shadow_map_depth(maps, first, size, light.layer),
        shadow_map_depth(maps, first + vec2i(1, 0), size, light.layer),
        shadow_map_depth(maps, first + vec2i(0, 1), size, light.layer),
        shadow_map_depth(maps, first + vec2i(1, 1), size, light.layer),
    );
    let is_seen = depths < vec4f(1.0);
    let distances = map_distances(light, depths);
    let rest = 1.0 - part;
    let shares = vec4f(rest.x * rest.y, part.x * rest.y, rest.x * part.y, part.x * part.y);
    let weights = select(vec4f(0.0), shares, is_seen);
    let weight = dot(weights, vec4f(1.0));
    let growth = vec2f(
        mix(distances.y - distances.x, distances.w - distances.z, part.y),
        mix(distances.z - distances.x, distances.w - distances.y, part.x),
    );
    let slope = select(vec2f(0.0), growth * vec2f(size), all(is_seen));
    return LitSurface(dot(weights, distances) / max(weight, 1e-6), slope, weight > 1e-6);
}

/// A texel of a shadow map; 1 outside of it.
fn shadow_map_depth(maps: texture_depth_2d_array, texel: vec2i, size: vec2i, layer: u32) -> f32 {
    if any(texel < vec2i(0)) || any(texel >= size) {
        return 1.0;
    }
    return textureLoad(maps, texel, i32(layer), 0);
}

/// Normal of a lit surface at a place of the map, in world space, turned to the light.
fn lit_normal(light: Light, lit: LitSurface, coordinate: vec2f) -> vec3f {
    // How the point moves with both coordinates; half the width grows with the distance.
    let half_width = light.half_width + light.spread * lit.distance;
    let growth = light.spread * lit.slope;
    let aside = 2.0 * coordinate - 1.0;
    let by_u = light.right * (2.0 * half_width + aside.x * growth.x)
        - light.up * (aside.y * growth.x)
        + light.forward * lit.slope.x;
    let by_v = light.right * (aside.x * growth.y)
        - light.up * (2.0 * half_width + aside.y * growth.y)
        + light.forward * lit.slope.y;
    return normalize(cross(by_v, by_u));
}
