// uses: lib/object_transform

/// The light's projection of one shadow map.
struct ShadowProjection {
    /// Clip space of the light from world space; depth 0 nearest the light.
    light_from_world: mat4x4f,
}

@group(0) @binding(0) var<uniform> projection: ShadowProjection;
@group(1) @binding(0) var<uniform> object_transform: ObjectTransform;

/// Depth only: the nearest surface along the light.
@vertex
fn shadow_vertex(@location(0) position: vec3f) -> @builtin(position) vec4f {
    return projection.light_from_world * vec4f(world_position(object_transform, position), 1.0);
}
