// uses: lib/{angle, numeric_limits, object_transform}, light/{absorption, environment, fresnel, light, refraction, specular}

/// Camera and light from everywhere of one frame.
struct ClearFrame {
    /// Clip space from world space.
    clip_from_world: mat4x4f,
    /// Position of the camera in world space.
    camera_position: vec3f,
    /// Lights in use.
    light_count: u32,
    /// Direction in which the camera looks, unit vector.
    forward: vec3f,
    /// Distance of the near plane, by which a depth stands for the distance near/depth along that direction.
    near: f32,
    /// Irradiance that comes from everywhere alike, red, green, blue.
    ambient_irradiance: vec3f,
    /// Millimetres that a world unit has.
    millimetres_per_world_unit: f32,
    /// Light that comes from everywhere, but not alike.
    environment: Environment,
    /// Pixels that a world unit spans at the distance of one.
    pixels_at_one: f32,
}

/// A clear object.
struct ClearObject {
    /// Where it stands.
    transform: ObjectTransform,
    /// Absorption coefficient per mm, red, green, blue.
    absorption_per_mm: vec3f,
    /// Refractive index over that of what is outside.
    refractive_index: f32,
    /// Roughness of its boundary, 0 to 1.
    roughness: f32,
    /// Thickness of its walls, mm; 0 for what is filled.
    shell_thickness_mm: f32,
    /// Share of each pixel that it covers, 0 to 1.
    coverage: f32,
}

/// World-space distance at which what is behind counts as far away.
const FARTHEST_BEHIND: f32 = 1e6;

@group(0) @binding(0) var<uniform> clear_frame: ClearFrame;
/// The first `light_count` of them shine.
@group(0) @binding(1) var<storage, read> clear_lights: array<Light>;
/// The picture without what is clear, with all smaller levels.
@group(0) @binding(2) var behind_texture: texture_2d<f32>;
@group(0) @binding(3) var behind_sampler: sampler;
/// Depth of what is opaque.
@group(0) @binding(4) var opaque_depth_texture: texture_2d<f32>;
/// Distance along the ray at which it leaves the last clear object.
@group(0) @binding(5) var exit_texture: texture_2d<f32>;
@group(0) @binding(6) var clear_environment_radiance: texture_2d<f32>;
@group(0) @binding(7) var clear_environment_sampler: sampler;

@group(1) @binding(0) var<uniform> clear_object: ClearObject;

struct ClearInterpolated {
    @builtin(position) clip_position: vec4f,
    @location(0) world_position: vec3f,
    @location(1) normal: vec3f,
}

@vertex
fn clear_vertex(@location(0) position: vec3f, @location(1) normal: vec3f) -> ClearInterpolated {
    let world = world_position(clear_object.transform, position);
    let clip = clear_frame.clip_from_world * vec4f(world, 1.0);
    return ClearInterpolated(clip, world, world_normal(clear_object.transform, normal));
}

/// c = c_s + T c_b: what the boundary reflects, and what is left of the picture behind (Real-Time Rendering 4, eq. 14.22
/// to 14.29).
@fragment
fn clear_fragment(interpolated: ClearInterpolated, @builtin(front_facing) front_facing: bool) -> @location(0) vec4f {
    let frame = clear_frame;
    let pixel = vec2i(interpolated.clip_position.xy);
    let size = vec2f(textureDimensions(behind_texture));
    let offset = interpolated.world_position - frame.camera_position;
    let along_axis = dot(offset, frame.forward);
    let opaque_axis = frame.near / max(textureLoad(opaque_depth_texture, pixel, 0).r, 1e-20);
    if along_axis > opaque_axis {
        discard;
    }
    let ray_length = length(offset);
    let ray = offset / ray_length;
    let towards_camera = -ray;
    let normal = normalize(select(-interpolated.normal, interpolated.normal, front_facing));
    let cosine = clamp(dot(normal, towards_camera), 0.0, 1.0);
    let index = clear_object.refractive_index;
    let reflectance = reflectance_of_index(index);
    let fresnel = fresnel_schlick(reflectance, cosine);

    // Through what is filled a ray goes to where it leaves, or to what is opaque within; as far as through a slab, whose
    // faces are parallel. What is opaque is looked up where the ray ends without it, and once more where it then ends.
    let is_shell = clear_object.shell_thickness_mm > 0.0;
    let per_axis = 1.0 / max(dot(ray, frame.forward), 1e-6);
    let longest = select(max(textureLoad(exit_texture, pixel, 0).r - ray_length, 0.0), 0.0, is_shell);
    let bent = refracted_direction(towards_camera, normal, 1.0 / index);
    let bent_growth = cosine / max(-dot(bent, normal), 1e-3);
    let own_place = (vec2f(pixel) + 0.5) / size;
    var inside = longest;
    var place = own_place;
    var behind_axis = opaque_axis;
    for (var look = 0; look < 2; look += 1) {
        let end = interpolated.world_position + inside * bent_growth * bent;
        let clip = frame.clip_from_world * vec4f(end, 1.0);
        let projected = vec2f(0.5, -0.5) * clip.xy / max(clip.w, frame.near) + 0.5;
        place = clamp(projected, vec2f(0.0), vec2f(1.0));
        let seen = vec2i(min(place * size, size - 1.0));
        behind_axis = frame.near / max(textureLoad(opaque_depth_texture, seen, 0).r, 1e-20);
        // What stands before the surface is not seen through it, and a ray may bend to behind the camera.
        if behind_axis < along_axis || clip.w <= frame.near {
            place = own_place;
            behind_axis = opaque_axis;
        }
        inside = min(longest, (behind_axis - along_axis) * per_axis);
    }
    let way_mm = select(
        inside * frame.millimetres_per_world_unit,
        shell_way_mm(clear_object.shell_thickness_mm, cosine),
        is_shell,
    );
    let is_far = behind_axis > FARTHEST_BEHIND;
    behind_axis = min(behind_axis, FARTHEST_BEHIND);
    // A face that is turned by an angle bends a ray by (1 − 1/η) times that inside, and by (η − 1) times behind a far
    // face that is not; faces turn by about α.
    let alpha = clear_object.roughness * clear_object.roughness;
    let inside_axis = inside * dot(ray, frame.forward);
    let outside_axis = max(behind_axis - along_axis - inside_axis, 0.0);
    let spread = 2.0 * alpha * ((1.0 - 1.0 / index) * inside_axis + (index - 1.0) * outside_axis);
    let spread_pixels = spread * frame.pixels_at_one / max(behind_axis, along_axis);
    let level = log2(max(spread_pixels, 1.0));
    var behind = textureSampleLevel(behind_texture, behind_sampler, place, level).rgb;
    if is_far && frame.environment.intensity > 0.0 {
        // Where nothing is behind there is the light from all around.
        let leaving = select(bent, ray, is_shell);
        behind = environment_reflection(
            clear_environment_radiance,
            clear_environment_sampler,
            frame.environment,
            leaving,
            clear_object.roughness,
        );
    }

    let mirrored = reflect(ray, normal);
    let reflected = frame.ambient_irradiance / PI
        + environment_reflection(
            clear_environment_radiance,
            clear_environment_sampler,
            frame.environment,
            mirrored,
            clear_object.roughness,
        );
    // A wall has two faces that reflect; what is filled loses to its sides what its far face reflects.
    let sent_back = select(fresnel, wall_reflectance(fresnel), is_shell);
    let let_through = select((1.0 - fresnel) * (1.0 - fresnel), 1.0 - sent_back, is_shell);
    var colour = sent_back * reflected
        + let_through * absorption_transmittance(clear_object.absorption_per_mm, way_mm) * behind;
    for (var i = 0u; i < frame.light_count; i += 1u) {
        let arrival = light_arrival(clear_lights[i], interpolated.world_position);
        let lobe = specular_reflection(normal, arrival.towards, towards_camera, reflectance, clear_object.roughness);
        // As much as of light from everywhere: a wall reflects by both faces.
        colour += arrival.irradiance * lobe * select(1.0, 2.0 / (1.0 + fresnel), is_shell);
    }
    let uncovered = textureLoad(behind_texture, pixel, 0).rgb;
    let picture = mix(uncovered, min(colour, vec3f(LARGEST_HALF)), clear_object.coverage);
    return vec4f(picture, 1.0);
}
