// uses: light/directional_light

/// The surface nearest to the light, as its shadow map has it around a point.
struct LitSurface {
    /// Depth in the map: straight between the middles of texels, so that it does not step with the map's size.
    depth: f32,
    /// How the depth grows with both texture coordinates; 0 where a part of it is not seen.
    slope: vec2f,
    /// Whether the map saw one there.
    is_seen: bool,
}

/// The nearest surface at `position` of the shadow map.
fn lit_surface(maps: texture_depth_2d_array, position: vec2f, layer: u32) -> LitSurface {
    let size = vec2i(textureDimensions(maps));
    let place = position * vec2f(size) - 0.5;
    let first = vec2i(floor(place));
    let part = place - floor(place);
    // From left to right and from the top; 1 is the depth where no surface is.
    let depths = vec4f(
        shadow_map_depth(maps, first, size, layer),
        shadow_map_depth(maps, first + vec2i(1, 0), size, layer),
        shadow_map_depth(maps, first + vec2i(0, 1), size, layer),
        shadow_map_depth(maps, first + vec2i(1, 1), size, layer),
    );
    let is_seen = depths < vec4f(1.0);
    let rest = 1.0 - part;
    let shares = vec4f(rest.x * rest.y, part.x * rest.y, rest.x * part.y, part.x * part.y);
    let weights = select(vec4f(0.0), shares, is_seen);
    let weight = dot(weights, vec4f(1.0));
    let growth = vec2f(
        mix(depths.y - depths.x, depths.w - depths.z, part.y),
        mix(depths.z - depths.x, depths.w - depths.y, part.x),
    );
    let slope = select(vec2f(0.0), growth * vec2f(size), all(is_seen));
    return LitSurface(dot(weights, depths) / max(weight, 1e-6), slope, weight > 1e-6);
}

/// A texel of a shadow map; 1 outside of it.
fn shadow_map_depth(maps: texture_depth_2d_array, texel: vec2i, size: vec2i, layer: u32) -> f32 {
    if any(texel < vec2i(0)) || any(texel >= size) {
        return 1.0;
    }
    return textureLoad(maps, texel, i32(layer), 0);
}

/// Normal of a lit surface in world space, turned to the light.
fn lit_normal(light: Light, lit: LitSurface) -> vec3f {
    // Rows of the map's matrix: directions in which its coordinates grow, as long as they grow per world unit. A step
    // of one coordinate is 1/length long, and takes the surface away from the light by slope · range.
    let matrix = light.shadow_from_world;
    let right = vec3f(matrix[0].x, matrix[1].x, matrix[2].x);
    let down = vec3f(matrix[0].y, matrix[1].y, matrix[2].y);
    let range = light.shadow_range_mm / light.millimetres_per_world_unit;
    return normalize(light.towards_light + range * (lit.slope.x * right + lit.slope.y * down));
}
