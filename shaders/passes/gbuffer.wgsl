/// Lights that one frame can hold.
const LIGHT_CAPACITY: u32 = 4u;

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
    /// World-space radius over which the thickness is averaged.
    thickness_filter_radius: f32,
}

/// Camera and lights of one frame.
struct GBufferFrame {
    /// Clip space from world space.
    clip_from_world: mat4x4f,
    /// Position of the camera in world space.
    camera_position: vec3f,
    light_count: u32,
    /// Irradiance that comes from everywhere alike, red, green, blue.
    ambient_irradiance: vec3f,
    /// Factor on every material's transmission: 1, or 0 for none.
    transmission: f32,
    lights: array<Light, 4>,
}

/// What one object adds to its material.
struct GBufferObject {
    /// Factor on the surface albedo texture.
    surface_albedo_factor: vec3f,
    /// Material number in the set, or −1: opaque.
    material: i32,
    /// Scale of the normal map's x and y; 0 without a normal map.
    normal_scale: f32,
    /// 1: the texture overrides the material's surface albedo; 0: the material's holds.
    surface_albedo_override: f32,
}

@group(2) @binding(0) var<uniform> frame: GBufferFrame;
@group(2) @binding(1) var shadow_maps: texture_depth_2d_array;
@group(2) @binding(2) var shadow_comparison: sampler_comparison;

@group(3) @binding(0) var<uniform> object: GBufferObject;
@group(3) @binding(1) var surface_albedo_texture: texture_2d<f32>;
@group(3) @binding(2) var normal_texture: texture_2d<f32>;
@group(3) @binding(3) var surface_sampler: sampler;

/// One vertex of a mesh, world space.
struct GBufferVertex {
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) texture_coordinate: vec2f,
}

struct GBufferInterpolated {
    @builtin(position) clip_position: vec4f,
    @location(0) world_position: vec3f,
    @location(1) normal: vec3f,
    @location(2) texture_coordinate: vec2f,
}

/// The three colour targets.
struct GBufferTargets {
    /// Diffuse irradiance.
    @location(0) irradiance: vec4f,
    /// Specular reflection + transmission: radiance that the subsurface pass leaves alone.
    @location(1) unscattered: vec4f,
    /// Surface albedo and the material number.
    @location(2) surface: vec4f,
}

@vertex
fn gbuffer_vertex(vertex: GBufferVertex) -> GBufferInterpolated {
    var interpolated: GBufferInterpolated;
    interpolated.clip_position = frame.clip_from_world * vec4f(vertex.position, 1.0);
    interpolated.world_position = vertex.position;
    interpolated.normal = vertex.normal;
    interpolated.texture_coordinate = vertex.texture_coordinate;
    return interpolated;
}

/// Normal of the normal map in world space, with the tangent frame from screen-space derivatives
/// (Schüler 2006, "Normal Mapping without Precomputed Tangents", ShaderX5).
fn mapped_normal(normal: vec3f, world_position: vec3f, texture_coordinate: vec2f, texel: vec3f, scale: f32) -> vec3f {
    let position_dx = dpdx(world_position);
    let position_dy = dpdy(world_position);
    let coordinate_dx = dpdx(texture_coordinate);
    let coordinate_dy = dpdy(texture_coordinate);
    let perpendicular_dy = cross(position_dy, normal);
    let perpendicular_dx = cross(normal, position_dx);
    let tangent = perpendicular_dy * coordinate_dx.x + perpendicular_dx * coordinate_dy.x;
    // glTF's v runs down, so its bitangent points against v.
    let bitangent = perpendicular_dy * coordinate_dx.y + perpendicular_dx * coordinate_dy.y;
    let longest = max(dot(tangent, tangent), dot(bitangent, bitangent));
    if longest < 1e-30 {
        return normal; // no texture coordinates, or a texel seen edge-on
    }
    let slope = (2.0 * texel.xy - 1.0) * scale;
    let height = 2.0 * texel.z - 1.0;
    let bent = (tangent * slope.x + bitangent * slope.y) * inverseSqrt(longest) + normal * max(height, 0.05);
    return normalize(bent);
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
    let across = normalize(cross(light.towards_light, select(vec3f(0.0, 1.0, 0.0), vec3f(1.0, 0.0, 0.0), abs(light.towards_light.y) > 0.9)));
    let along = cross(light.towards_light, across);
    var through = vec3f(0.0);
    // The mean over a small disc hides the steps of the shadow map's texels.
    for (var tap = 0u; tap < SHADOW_TAPS; tap += 1u) {
        let offset = light.thickness_filter_radius * vogel_disc(tap, SHADOW_TAPS);
        let point = light.shadow_from_world * vec4f(inside + offset.x * across + offset.y * along, 1.0);
        let nearest = nearest_to_light(shadow_maps, point.xy, layer);
        let thickness_mm = max(point.z - nearest, 0.0) * light.shadow_range_mm;
        through += channel_transmittance(profiles, surface_albedo, thickness_mm);
    }
    return light.irradiance * facing_away * through / f32(SHADOW_TAPS);
}

@fragment
fn gbuffer_fragment(interpolated: GBufferInterpolated, @builtin(front_facing) front_facing: bool) -> GBufferTargets {
    let texel = textureSample(surface_albedo_texture, surface_sampler, interpolated.texture_coordinate);
    let normal_texel = textureSample(normal_texture, surface_sampler, interpolated.texture_coordinate);
    let smooth_normal = normalize(select(-interpolated.normal, interpolated.normal, front_facing));
    let bent_normal = mapped_normal(
        smooth_normal,
        interpolated.world_position,
        interpolated.texture_coordinate,
        normal_texel.xyz,
        object.normal_scale,
    );
    let normal = select(smooth_normal, bent_normal, object.normal_scale > 0.0);
    let towards_camera = normalize(frame.camera_position - interpolated.world_position);

    let material_count = MATERIAL_COUNT;
    let translucent = object.material >= 0 && u32(object.material) < material_count;
    let row = material_table[u32(clamp(object.material, 0, i32(material_count) - 1))];
    let textured = texel.rgb * object.surface_albedo_factor;
    let surface_albedo = mix(row.surface.surface_albedo, textured, object.surface_albedo_override);
    let profiles = material_profiles(row, surface_albedo);

    var irradiance = frame.ambient_irradiance;
    var unscattered = vec3f(0.0);
    for (var i = 0u; i < min(frame.light_count, LIGHT_CAPACITY); i += 1u) {
        let light = frame.lights[i];
        let lifted = interpolated.world_position + light.shadow_normal_offset * smooth_normal;
        let coordinate = (light.shadow_from_world * vec4f(lifted, 1.0)).xyz;
        let visibility = shadow_visibility(shadow_maps, shadow_comparison, coordinate, i, light.shadow_filter_radius);
        // A bent normal must not light a point whose true surface faces away.
        let facing = clamp(dot(smooth_normal, light.towards_light) * 8.0, 0.0, 1.0);
        let cosine = max(dot(normal, light.towards_light), 0.0) * facing;
        let arriving = light.irradiance * visibility;
        // What the surface reflects specularly does not enter: Lambert · (1 − F).
        irradiance += arriving * cosine * (1.0 - fresnel_schlick(row.surface.reflectance_at_normal, cosine));
        unscattered += arriving * facing * specular_reflection(
            normal,
            light.towards_light,
            towards_camera,
            row.surface.reflectance_at_normal,
            row.surface.roughness,
        );
        let transmission = frame.transmission * row.surface.transmission_strength;
        if translucent && transmission > 0.0 {
            let through = transmitted_irradiance(light, i, interpolated.world_position, smooth_normal, profiles, surface_albedo);
            unscattered += transmission * through / PI;
        }
    }

    var targets: GBufferTargets;
    targets.irradiance = vec4f(irradiance, 1.0);
    targets.unscattered = vec4f(unscattered, 1.0);
    targets.surface = vec4f(surface_albedo, select(-1.0, f32(object.material), translucent));
    return targets;
}
