// uses: gather/{input, view}, lib/{distance, numeric_limits}, the material set

@group(1) @binding(0) var<uniform> subsurface_view: SubsurfaceView;
/// Diffuse irradiance, red, green, blue; before the surface albedo.
@group(1) @binding(1) var irradiance_texture: texture_2d<f32>;
/// Surface albedo (red, green, blue) and, unless HAS_MATERIAL_IDS, the material number as a whole float; −1 where
/// nothing is translucent.
@group(1) @binding(2) var surface_texture: texture_2d<f32>;
/// Depth in whatever form `subsurface_view.distance_from_depth` turns into millimetres.
@group(1) @binding(3) var depth_texture: texture_2d<f32>;
/// Factor on the mean free path, in its first component; one pixel of 1 where there is none.
@group(1) @binding(4) var mean_free_path_scale_texture: texture_2d<f32>;

/// Material numbers, if HAS_MATERIAL_IDS; a number that the set does not hold where nothing is translucent.
@group(1) @binding(5) var material_id_texture: texture_2d<u32>;

/// Whether material numbers come from `material_id_texture`.
override HAS_MATERIAL_IDS: bool = false;

/// Place in the textures of a position in the viewport.
fn texture_position(position: vec2i) -> vec2i {
    return position + subsurface_view.viewport_origin;
}

/// Whether the viewport has a pixel at `position`: places before it are large as numbers without a sign.
fn is_inside(position: vec2i) -> bool {
    return all(vec2u(position) < vec2u(subsurface_view.viewport_extent));
}

/// Texel of the irradiance at `position`.
fn irradiance_at(position: vec2i) -> vec4f {
    return textureLoad(irradiance_texture, texture_position(position), 0);
}

/// Texel of the surface at `position`.
fn surface_texel_at(position: vec2i) -> vec4f {
    return textureLoad(surface_texture, texture_position(position), 0);
}

/// What a tap sees at `position`.
fn input_pixel(position: vec2i) -> InputPixel {
    let surface = input_surface(position);
    if surface.material == NO_MATERIAL {
        return InputPixel(vec3f(0.0), 0.0, NO_MATERIAL);
    }
    let irradiance = irradiance_at(position).rgb;
    let material = select(NO_MATERIAL, surface.material, is_finite_rgb(irradiance));
    return InputPixel(finite_irradiance(irradiance), surface.distance_mm, material);
}

/// The surface at `position`; none outside of the viewport.
fn input_surface(position: vec2i) -> InputSurface {
    if !is_inside(position) {
        return InputSurface(0.0, NO_MATERIAL);
    }
    let depth = textureLoad(depth_texture, texture_position(position), 0).r;
    let distance_mm = distance_from_depth_mm(depth, subsurface_view.distance_from_depth);
    if HAS_MATERIAL_IDS {
        let id = textureLoad(material_id_texture, texture_position(position), 0).r;
        return surface_of_material(material_of_id(id, MATERIALS_IN_SET), distance_mm);
    }
    let material = material_number(surface_texel_at(position).w, MATERIALS_IN_SET);
    return surface_of_material(material, distance_mm);
}
