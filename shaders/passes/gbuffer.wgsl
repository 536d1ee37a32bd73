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
    /// Millimetres that a world unit has.
    millimetres_per_world_unit: f32,
}

/// Camera and lights of one frame.
struct GBufferFrame {
    /// Clip space from world space.
    clip_from_world: mat4x4f,
    /// Position of the camera in world space.
    camera_position: vec3f,
    /// Lights in use, at most LIGHT_CAPACITY.
    light_count: u32,
    /// Irradiance that comes from everywhere alike, red, green, blue.
    ambient_irradiance: vec3f,
    /// Factor on every material's transmission: 1, or 0 for none.
    transmission: f32,
    /// The first `light_count` of them shine.
    lights: array<Light, LIGHT_CAPACITY>,
}

/// What one object adds to its material, or has instead of one.
struct GBufferObject {
    /// Factor on the surface albedo texture.
    surface_albedo_factor: vec3f,
    /// Material number in the set, or −1: opaque.
    material: i32,
    /// Scale of the normal map's x and y; 0 without a normal map.
    normal_scale: f32,
    /// 1: texture and factor override the material's surface albedo; 0: the material's holds.
    surface_albedo_override: f32,
    /// Specular reflectance at normal incidence of an opaque object.
    opaque_reflectance_at_normal: f32,
    /// Roughness of an opaque object.
    opaque_roughness: f32,
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
///
/// `texel` holds the map's value in [0, 1], x towards increasing u and y towards decreasing v as in glTF.
fn mapped_normal(normal: vec3f, world_position: vec3f, texture_coordinate: vec2f, texel: vec3f, scale: f32) -> vec3f {
    let position_dx = dpdx(world_position);
    let position_dy = dpdy(world_position);
    let coordinate_dx = dpdx(texture_coordinate);
    let coordinate_dy = dpdy(texture_coordinate);
    // The paper's screen has y up; here it runs down, and a back face mirrors it once more. The sign says which.
    let orientation = sign(dot(cross(position_dx, position_dy), normal));
    let across_dy = orientation * cross(position_dy, normal);
    let across_dx = orientation * cross(normal, position_dx);
    let tangent = across_dy * coordinate_dx.x + across_dx * coordinate_dy.x;
    let bitangent = -(across_dy * coordinate_dx.y + across_dx * coordinate_dy.y);
    let longest = max(dot(tangent, tangent), dot(bitangent, bitangent));
    // (World length × texture coordinate per pixel)²: nothing this small is a frame, only a mesh without coordinates.
    if longest < 1e-30 {
        return normal;
    }
    let slope = (2.0 * texel.xy - 1.0) * scale;
    // A map that points below the surface would turn the normal inside out.
    let height = max(2.0 * texel.z - 1.0, 0.05);
    return normalize((tangent * slope.x + bitangent * slope.y) * inverseSqrt(longest) + normal * height);
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

    let translucent = material_number(f32(object.material), MATERIALS_IN_SET) != NO_MATERIAL;
    let row = material_table[select(0, object.material, translucent)];
    let textured = texel.rgb * object.surface_albedo_factor;
    let override_albedo = select(1.0, object.surface_albedo_override, translucent);
    let surface_albedo = mix(row.surface.surface_albedo, textured, override_albedo);
    let reflectance = select(object.opaque_reflectance_at_normal, row.surface.reflectance_at_normal, translucent);
    let roughness = select(object.opaque_roughness, row.surface.roughness, translucent);
    let profiles = material_profiles(row, surface_albedo);
    let transmission = frame.transmission * select(0.0, row.surface.transmission_strength, translucent);

    // From everywhere alike: what the specular lobe takes on average stays outside.
    var irradiance = frame.ambient_irradiance * (1.0 - fresnel_schlick_mean(reflectance));
    var unscattered = vec3f(0.0);
    for (var i = 0u; i < min(frame.light_count, LIGHT_CAPACITY); i += 1u) {
        let light = frame.lights[i];
        let lifted = interpolated.world_position + light.shadow_normal_offset * smooth_normal;
        let coordinate = (light.shadow_from_world * vec4f(lifted, 1.0)).xyz;
        let visibility = shadow_visibility(shadow_maps, shadow_comparison, coordinate, i, light.shadow_filter_radius);
        // A bent normal must not light a point whose true surface faces away: fade out over the last 7 degrees, where
        // bent and true normals may disagree. Without a normal map they never do.
        let true_cosine = dot(smooth_normal, light.towards_light);
        let facing = select(1.0, clamp(true_cosine * 8.0, 0.0, 1.0), object.normal_scale > 0.0);
        let cosine = max(dot(normal, light.towards_light), 0.0);
        let arriving = light.irradiance * visibility * facing;
        // What the surface reflects specularly does not enter: Lambert · (1 − F).
        irradiance += arriving * cosine * (1.0 - fresnel_schlick(reflectance, cosine));
        unscattered +=
            arriving * specular_reflection(normal, light.towards_light, towards_camera, reflectance, roughness);
        if transmission > 0.0 {
            let position = interpolated.world_position;
            let through = transmitted_irradiance(light, i, position, smooth_normal, profiles, surface_albedo);
            unscattered += transmission * through / PI;
        }
    }

    var targets: GBufferTargets;
    // The targets hold half floats: a mirror's highlight must end at their largest value, not at infinity.
    targets.irradiance = vec4f(min(irradiance, vec3f(LARGEST_HALF)), 1.0);
    targets.unscattered = vec4f(min(unscattered, vec3f(LARGEST_HALF)), 1.0);
    targets.surface = vec4f(surface_albedo, select(-1.0, f32(object.material), translucent));
    return targets;
}
