// uses: gather/{input, mean_free_path_scale}, kernel/constants, lib/{albedo_mix, angle, half_space, medium_angles, noise, numeric_limits, object_transform, slab}, light/{coupling, diffuse_lobe, environment, light, normal_map, shadow, specular_surface, transmission}, the material set

/// Camera and light from everywhere of one frame.
struct GBufferFrame {
    /// Clip space from world space.
    clip_from_world: mat4x4f,
    /// Position of the camera in world space.
    camera_position: vec3f,
    /// Lights in use.
    light_count: u32,
    /// Irradiance that comes from everywhere alike, red, green, blue.
    ambient_irradiance: vec3f,
    /// Factor on every material's transmission: 1, or 0 for none.
    transmission: f32,
    /// Light that comes from everywhere, but not alike.
    environment: Environment,
    /// Millimetres that a world unit has.
    millimetres_per_world_unit: f32,
}

/// What one object adds to its material, or has instead of one.
struct GBufferObject {
    /// Where it stands.
    transform: ObjectTransform,
    /// Mean curvature of its surface in the mean, per world unit; 0 and less for what is flat or hollow.
    mean_curvature: f32,
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
    /// Factor on the roughness texture; below 0 without one.
    roughness_factor: f32,
    /// Factor on the specular strength texture.
    specular_strength_factor: f32,
    /// Factor on the mean free path, and on its texture.
    mean_free_path_scale: f32,
    /// Thickness where its texture is 1, mm; 0 where the object does not say how thick it is.
    thickness_mm: f32,
}

/// Surface albedo below which light that came through leaves in part where it arrives.
const LEAST_DIFFUSING_ALBEDO: f32 = 0.02;

/// Whether there is light from all around; the pipeline says it.
override HAS_ENVIRONMENT: bool = false;

/// Whether the object says more of its surface than its colour and its normals; the pipeline says it.
override HAS_DETAILS: bool = false;

@group(2) @binding(0) var<uniform> frame: GBufferFrame;
@group(2) @binding(1) var shadow_maps: texture_depth_2d_array;
@group(2) @binding(2) var shadow_comparison: sampler_comparison;
/// The first `light_count` of them shine.
@group(2) @binding(3) var<storage, read> lights: array<Light>;
@group(2) @binding(4) var environment_radiance: texture_2d<f32>;
@group(2) @binding(5) var environment_sampler: sampler;

@group(3) @binding(0) var<uniform> object: GBufferObject;
@group(3) @binding(1) var surface_albedo_texture: texture_2d<f32>;
@group(3) @binding(2) var normal_texture: texture_2d<f32>;
@group(3) @binding(3) var surface_sampler: sampler;
/// Green.
@group(3) @binding(4) var roughness_texture: texture_2d<f32>;
/// Alpha.
@group(3) @binding(5) var specular_strength_texture: texture_2d<f32>;
/// Red: factor on the mean free path.
@group(3) @binding(6) var object_scale_texture: texture_2d<f32>;
/// Green.
@group(3) @binding(7) var thickness_texture: texture_2d<f32>;

/// One vertex of a mesh, in the object's space.
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

/// The colour targets; the last one where the pass has it.
struct GBufferTargets {
    /// Diffuse irradiance; alpha is what it is multiplied by where it leaves towards the camera, about 1.
    @location(0) irradiance: vec4f,
    /// Specular reflection + transmission: radiance that the subsurface pass leaves alone; alpha: see `pack_exit`.
    @location(1) unscattered: vec4f,
    /// Surface albedo and the material number.
    @location(2) surface: vec4f,
    /// Factor on the mean free path.
    @location(3) mean_free_path_scale: f32,
}

@vertex
fn gbuffer_vertex(vertex: GBufferVertex) -> GBufferInterpolated {
    var interpolated: GBufferInterpolated;
    let position = world_position(object.transform, vertex.position);
    interpolated.clip_position = frame.clip_from_world * vec4f(position, 1.0);
    interpolated.world_position = position;
    interpolated.normal = world_normal(object.transform, vertex.normal);
    interpolated.texture_coordinate = vertex.texture_coordinate;
    return interpolated;
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
    // The triangle's own plane, on the side of the smooth normal; a shadow falls on it.
    let facet = cross(dpdx(interpolated.world_position), dpdy(interpolated.world_position));
    let facet_side = select(-1.0, 1.0, dot(facet, smooth_normal) > 0.0);
    let has_facet = dot(facet, facet) > 0.0;
    let flat_normal = select(smooth_normal, facet_side * facet * inverseSqrt(dot(facet, facet)), has_facet);

    let translucent = material_number(f32(object.material), MATERIALS_IN_SET) != NO_MATERIAL;
    let row = material_table[select(0, object.material, translucent)];
    let textured = texel.rgb * object.surface_albedo_factor;
    let override_albedo = select(1.0, object.surface_albedo_override, translucent);
    let surface_albedo = clamp(mix(row.surface.surface_albedo, textured, override_albedo), vec3f(0.0), vec3f(1.0));
    var reflectance = select(object.opaque_reflectance_at_normal, row.surface.reflectance_at_normal, translucent);
    var roughness = select(object.opaque_roughness, row.surface.roughness, translucent);
    var mean_free_path_scale = 1.0;
    // Of a solid, for light that no map sees through it.
    var thickness_mm = 0.0;
    if HAS_DETAILS {
        let place = interpolated.texture_coordinate;
        let rough = textureSample(roughness_texture, surface_sampler, place).g * object.roughness_factor;
        roughness = select(roughness, clamp(rough, 0.0, 1.0), object.roughness_factor >= 0.0);
        let strength = textureSample(specular_strength_texture, surface_sampler, place).a;
        reflectance = min(reflectance * strength * object.specular_strength_factor, 1.0);
        let scale = textureSample(object_scale_texture, surface_sampler, place).r * object.mean_free_path_scale;
        mean_free_path_scale = clamp(scale, SMALLEST_MEAN_FREE_PATH_SCALE, LARGEST_MEAN_FREE_PATH_SCALE);
        thickness_mm = textureSample(thickness_texture, surface_sampler, place).g * object.thickness_mm;
    }
    roughness = roughness_of_normals(roughness, normal_texel.xyz, object.normal_scale);
    let profiles = material_profiles(row, surface_albedo);
    let transmission = frame.transmission * select(0.0, row.surface.transmission_strength, translucent);
    let is_thin = THIN_SHEETS && translucent && row.surface.thin_thickness_mm > 0.0;

    let coupling = select(COUPLING_FULL, row.surface.coupling, translucent);
    let second_weight = select(0.0, row.surface.second_weight, translucent);
    let specular = SpecularSurface(coupling, reflectance, roughness, row.surface.second_roughness, second_weight);
    // A sheet has no half-space below it.
    let has_brdf = DIFFUSE_LOBES && translucent && !is_thin && row.surface.diffuse >= DIFFUSE_SHIRLEY;
    let diffuse = select(DIFFUSE_LAMBERT, row.surface.diffuse, translucent && !is_thin && !has_brdf);
    let lobe =
        DiffuseLobe(row.surface.diffuse, row.surface.diffuse_shape, surface_albedo, reflectance, roughness);
    let view_cosine = max(dot(normal, towards_camera), LEAST_EXIT_COSINE);
    let coefficients = row.surface.albedo_coefficients;
    let medium = medium_angles(diffuse, coefficients, surface_albedo, reflectance, view_cosine);
    // A slab's law is for a medium without a boundary; the albedo of a material that does not give its medium counts as
    // that.
    let slab_albedo = select(surface_albedo, matched_albedo(medium), row.surface.is_medium != 0u);
    let view_albedo = surface_specular_albedo(specular, view_cosine);
    let ambient_share = entering_ambient_share(specular);
    // A lobe below the boundary has lost what that sends back inside: none of it comes out again.
    let is_below = DIFFUSE_LOBES && has_brdf && diffuse_lobe_is_below(lobe);
    let leaving = leaving_share(specular, view_albedo, select(ambient_share, 1.0, is_below));
    let slab_length = row.surface.slab_mean_free_path_mm * mean_free_path_scale;
    let is_measured = HAS_DETAILS && object.thickness_mm > 0.0;
    let sheet_mm = select(row.surface.thin_thickness_mm, thickness_mm, is_measured);
    // What comes through without a map: through a sheet, and through a solid that says how thick it is. That sends back
    // less of the same light than what has no far side.
    var sheet = vec3f(0.0);
    if THIN_SHEETS {
        sheet = slab_transmittance(slab_albedo, slab_length, sheet_mm);
    }
    var solid = vec3f(0.0);
    var solid_front = vec3f(1.0);
    if HAS_DETAILS {
        let by_law = material_transmittance(
            row.surface,
            profiles,
            surface_albedo,
            slab_albedo,
            mean_free_path_scale,
            thickness_mm,
        );
        let is_solid = is_measured && translucent && !is_thin;
        solid = select(vec3f(0.0), by_law, is_solid);
        let has_length = is_solid && slab_length.r != 0.0;
        let scaled = select(vec3f(1.0), abs(slab_length), has_length);
        solid_front = select(vec3f(1.0), slab_returned(slab_albedo, scaled, thickness_mm), has_length);
    }

    // A sheet sends back from where light entered.
    var albedo_mix = 0.0;
    if ALBEDO_MIXES {
        albedo_mix = select(0.0, row.surface.surface_albedo_mix, translucent && !is_thin);
    }

    var around = frame.ambient_irradiance;
    var around_behind = frame.ambient_irradiance;
    var reflected = frame.ambient_irradiance / PI;
    var mirrored_by_second = reflected;
    if HAS_ENVIRONMENT {
        let mirrored = reflect(-towards_camera, normal);
        around += environment_irradiance(frame.environment, normal);
        around_behind += environment_irradiance(frame.environment, -normal);
        let environment = frame.environment;
        reflected +=
            environment_reflection(environment_radiance, environment_sampler, environment, mirrored, roughness);
        if SECOND_LOBES {
            let second = row.surface.second_roughness;
            mirrored_by_second +=
                environment_reflection(environment_radiance, environment_sampler, environment, mirrored, second);
        }
    }
    var irradiance = around * ambient_share * medium_ambient_entry(medium);
    // A lobe of its own is for what does not spread, and a sheet has no inside.
    let has_far_side = HAS_DETAILS && object.thickness_mm > 0.0;
    let is_convex = translucent && !is_thin && !has_brdf && !has_far_side && object.mean_curvature > 0.0;
    let curvature = select(0.0, object.mean_curvature / frame.millimetres_per_world_unit, is_convex);
    let curvatures = curvature * abs(slab_length);
    irradiance *= solid_front * convex_gain(medium.root, medium.inverse_square, curvatures);
    if DIFFUSE_LOBES && has_brdf {
        irradiance *= diffuse_lobe_ambient(lobe, normal, towards_camera);
    }
    var unscattered = reflected * view_albedo;
    if SECOND_LOBES {
        // Each lobe sends back its own blur of the environment.
        let second = specular.second_weight * second_specular_albedo(specular, view_cosine);
        unscattered = reflected * (view_albedo - second) + mirrored_by_second * second;
    }
    // Irradiance from behind, times what comes through.
    var through = around_behind * ambient_share * select(solid * medium_ambient_through(medium), sheet, is_thin);
    let noise = interleaved_gradient_noise(vec2i(interpolated.clip_position.xy), 0u);
    for (var i = 0u; i < frame.light_count; i += 1u) {
        let light = lights[i];
        let position = interpolated.world_position;
        let arrival = light_arrival(light, position);
        let true_cosine = dot(smooth_normal, arrival.towards);
        let is_behind = true_cosine < 0.0;
        // A sheet is seen from the light on either side.
        let side = select(1.0, -1.0, is_thin && is_behind);
        // A triangle at the terminator may face away where its smooth normal does not.
        let is_flat = side * dot(flat_normal, arrival.towards) > 0.0;
        let shaded_normal = side * select(smooth_normal, flat_normal, is_flat);
        let visibility = shadow_visibility(shadow_maps, shadow_comparison, light, position, shaded_normal, noise);
        // A bent normal must not light a point whose true surface faces away: fade out over the last 7 degrees, where
        // bent and true normals may disagree. Without a normal map they never do.
        let facing = select(1.0, clamp(true_cosine * 8.0, 0.0, 1.0), object.normal_scale > 0.0);
        let cosine = max(dot(normal, arrival.towards), 0.0);
        let arriving = arrival.irradiance * visibility * facing;
        let facing_away = max(-true_cosine, 0.0);
        let is_mapped = !is_thin && transmission > 0.0 && is_behind && light.layer != NO_SHADOW_MAP;
        let mapped = transmitted(
            is_mapped,
            light,
            arrival.towards,
            position,
            smooth_normal,
            row.surface,
            profiles,
            surface_albedo,
            slab_albedo,
            mean_free_path_scale,
        );
        let far_cosine = select(facing_away, mapped.cosine, is_mapped);
        let entering_cosine = select(cosine, far_cosine, is_behind);
        let entering = entering_share(specular, entering_cosine);
        let angles = entering_angles(medium, entering_cosine);
        let towards = dot(arrival.towards, towards_camera);
        let cosines = convex_cosine(curvatures, medium.inverse_square, cosine, view_cosine, towards);
        var entered = arriving * (cosines * entering) * medium_entry(medium, angles);
        if DIFFUSE_LOBES && has_brdf {
            entered *= diffuse_lobe(lobe, normal, arrival.towards, towards_camera);
        }
        irradiance += entered * select(vec3f(1.0), solid_front, light.layer == NO_SHADOW_MAP);
        unscattered += arriving * surface_reflection(specular, normal, arrival.towards, towards_camera);
        let behind = arrival.irradiance * (far_cosine * entering);
        // Without a map the object's own thickness stands for the light's way.
        let of_solid = select(mapped.share, solid, light.layer == NO_SHADOW_MAP);
        through += behind * select(of_solid * medium_through(medium, angles), visibility * sheet, is_thin);
    }
    if ALBEDO_MIXES {
        irradiance *= albedo_before(surface_albedo, albedo_mix);
    }
    through *= transmission;
    if TRANSMISSION_DIFFUSES && row.surface.transmission_diffused != 0u && !is_thin {
        // As much irradiance as leaves with the same radiance where all is alike. What is nearly black diffuses little.
        var leaving_albedo = surface_albedo;
        if ALBEDO_MIXES {
            leaving_albedo = albedo_after(surface_albedo, albedo_mix);
        }
        let diffusing = max(leaving_albedo, vec3f(LEAST_DIFFUSING_ALBEDO));
        let diffused = select(vec3f(0.0), through / (diffusing * medium_exit(medium)), translucent);
        irradiance += diffused;
        through *= 1.0 - leaving_albedo / diffusing;
    }
    unscattered += leaving * through / PI;

    var targets: GBufferTargets;
    // The targets hold half floats: a mirror's highlight must end at their largest value, not at infinity.
    targets.irradiance = vec4f(min(irradiance, vec3f(LARGEST_HALF)), leaving * medium.exit_share);
    targets.unscattered = vec4f(min(unscattered, vec3f(LARGEST_HALF)), pack_exit(medium));
    targets.surface = vec4f(surface_albedo, select(-1.0, f32(object.material), translucent));
    targets.mean_free_path_scale = mean_free_path_scale;
    if THIN_SHEETS && is_thin {
        // A sheet sends back what a slab does, from where it entered.
        let sent_back = slab_reflectance(slab_albedo, slab_length, sheet_mm);
        targets.surface = vec4f(sent_back, -1.0);
    }
    return targets;
}
