/// A directional light.
struct Light {
    /// Coordinates in the light's shadow map (x, y in [0, 1], depth) from world space.
    shadow_from_world: mat4x4f,
    /// Unit vector from the surface towards the light, world space.
    towards_light: vec3f,
    /// Millimetres between the depths 0 and 1 of the shadow map.
    shadow_range_mm: f32,
    /// Irradiance on a surface that faces the light, red, green, blue.
    irradiance: vec3f,
    /// Radius of the shadow filter in texture coordinates of the shadow map.
    shadow_filter_radius: f32,
    /// World-space distance by which a point is lifted off the surface before it is compared, against self-shadowing.
    shadow_normal_offset: f32,
    /// World-space radius of the disc over which what comes through is averaged.
    thickness_filter_radius: f32,
    /// World-space distance by which a point is moved into the object before its thickness is measured, so that a rim
    /// is not taken for the lit face.
    thickness_normal_offset: f32,
    /// Millimetres that a world unit has.
    millimetres_per_world_unit: f32,
}
