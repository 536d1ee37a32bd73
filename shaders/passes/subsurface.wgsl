/// How the subsurface pass reads its inputs.
struct SubsurfaceView {
    /// (x, y, z, w): distance along the view axis in mm = (x·depth + y) / (z·depth + w).
    distance_from_depth: vec4f,
    /// (x, y): millimetres that one pixel spans = x + y·distance.
    millimetres_per_pixel: vec2f,
    /// Taps per pixel: the budget of the largest footprint.
    taps: u32,
    /// Moves the pattern of taps on. The same number gives the same picture.
    frame_index: u32,
    /// Debug view: one of the `DEBUG_…` constants.
    debug_view: u32,
}

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

/// Texel `step` of a row of the curves.
fn curve_texel(row: i32, step: i32) -> vec4f {
    return textureLoad(profile_curves, curve_place(row, step), 0);
}

/// Factor on the mean free path at `position`: 1 where the texture has no finite number.
fn mean_free_path_scale_at(position: vec2i) -> f32 {
    let last = vec2i(textureDimensions(mean_free_path_scale_texture)) - 1;
    let scale = textureLoad(mean_free_path_scale_texture, min(position, last), 0).r;
    let limited = clamp(scale, SMALLEST_MEAN_FREE_PATH_SCALE, LARGEST_MEAN_FREE_PATH_SCALE);
    return select(1.0, limited, is_finite(scale));
}

/// The point of `surface`, which the pixel at `position` shows.
fn surface_point_at(position: vec2i, surface: InputSurface) -> SurfacePoint {
    let row = material_table[surface.material];
    return surface_point(
        subsurface_view,
        position,
        vec2f(position),
        surface.material,
        row,
        surface.distance_mm,
        texel_surface_albedo(textureLoad(surface_texture, position, 0), row.surface),
        mean_free_path_scale_at(position),
    );
}

/// The pixel at `position`, which shows `surface` and whose texel of the irradiance is `texel`.
fn receiver_at(position: vec2i, surface: InputSurface, texel: vec4f) -> Receiver {
    let span = span_mm(subsurface_view, surface.distance_mm);
    // The limit of the pixels around: a constant irradiance stays one.
    let own = min(finite_irradiance(texel.rgb), vec3f(LARGEST_PACKED_IRRADIANCE));
    let own_counts = select(0.0, 1.0, is_finite_rgb(texel.rgb));
    let normal = surface_normal(position, span);
    return Receiver(position, surface, span, depth_scale(span), normal, own, own_counts);
}
