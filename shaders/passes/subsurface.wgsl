// uses: gather/{input, view}, lib/{distance, numeric_limits}

@group(1) @binding(0) var<uniform> subsurface_view: SubsurfaceView;
/// Diffuse irradiance, red, green, blue; before the surface albedo.
@group(1) @binding(1) var irradiance_texture: texture_2d<f32>;
/// Surface albedo (red, green, blue) and the material number as a whole float; −1 where nothing is translucent.
@group(1) @binding(2) var surface_texture: texture_2d<f32>;
/// Depth in whatever form `subsurface_view.distance_from_depth` turns into millimetres.
@group(1) @binding(3) var depth_texture: texture_2d<f32>;
/// Factor on the mean free path, in its first component; one pixel of 1 where there is none.
@group(1) @binding(4) var mean_free_path_scale_texture: texture_2d<f32>;

/// Whether the target has a pixel at `position`.
fn is_inside(position: vec2i) -> bool {
    return all(position >= vec2i(0)) && all(position < vec2i(textureDimensions(irradiance_texture)));
}

/// What a tap sees at `position`.
fn input_pixel(position: vec2i) -> InputPixel {
    let surface = input_surface(position);
    if surface.material == NO_MATERIAL {
        return InputPixel(vec3f(0.0), 0.0, NO_MATERIAL);
    }
    let irradiance = textureLoad(irradiance_texture, position, 0).rgb;
    let material = select(NO_MATERIAL, surface.material, is_finite_rgb(irradiance));
    return InputPixel(finite_irradiance(irradiance), surface.distance_mm, material);
}

/// The surface at `position`; none outside of the target.
fn input_surface(position: vec2i) -> InputSurface {
    if !is_inside(position) {
        return InputSurface(0.0, NO_MATERIAL);
    }
    let depth = textureLoad(depth_texture, position, 0).r;
    let distance_mm = distance_from_depth_mm(depth, subsurface_view.distance_from_depth);
    return surface_of_texel(textureLoad(surface_texture, position, 0).w, distance_mm);
}
