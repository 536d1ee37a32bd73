/// Where an object stands.
struct ObjectTransform {
    /// World space from the space of the object's vertices.
    world_from_object: mat4x4f,
    /// Directions of normals in world space from those of the vertices: the cofactors of the upper left 3×3 of
    /// `world_from_object`, which point as its inverse transpose does, and exist where that does not.
    world_from_object_normal: mat3x3f,
}

/// A vertex in world space.
fn world_position(transform: ObjectTransform, position: vec3f) -> vec3f {
    return (transform.world_from_object * vec4f(position, 1.0)).xyz;
}

/// The normal of a vertex in world space, as long as it was: between vertices normals are weighted by their length.
fn world_normal(transform: ObjectTransform, normal: vec3f) -> vec3f {
    let turned = transform.world_from_object_normal * normal;
    let turned_length = length(turned);
    // A transform that flattens the object leaves no direction to the normals within the plane.
    if turned_length == 0.0 {
        return normal;
    }
    return turned * (length(normal) / turned_length);
}
