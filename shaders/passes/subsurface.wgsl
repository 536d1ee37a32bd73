/// How the subsurface pass reads its inputs.
struct SubsurfaceView {
    /// (x, y, z, w): distance along the view axis in mm = (x·depth + y) / (z·depth + w).
    distance_from_depth: vec4f,
    /// (x, y): millimetres that one pixel spans = x + y·distance.
    millimetres_per_pixel: vec2f,
    /// Taps per pixel.
    taps: u32,
    /// Shifts the pattern of directions. The same seed gives the same picture.
    seed: u32,
}

/// One row per material of the set, in the order of the material numbers.
@group(0) @binding(0) var<storage, read> material_table: array<SubsurfaceMaterial>;

@group(1) @binding(0) var<uniform> subsurface_view: SubsurfaceView;
/// Diffuse irradiance, red, green, blue; before the surface albedo.
@group(1) @binding(1) var irradiance_texture: texture_2d<f32>;
/// Surface albedo (red, green, blue) and the material number as a whole float; −1 where nothing is translucent.
@group(1) @binding(2) var surface_texture: texture_2d<f32>;
/// Depth in whatever form `subsurface_view.distance_from_depth` turns into millimetres.
@group(1) @binding(3) var depth_texture: texture_2d<f32>;

/// One triangle that covers the target.
@vertex
fn subsurface_vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return covering_triangle(index);
}

/// Diffused irradiance of translucent pixels; every other pixel keeps its irradiance.
@fragment
fn subsurface_fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(position.xy);
    let own = textureLoad(irradiance_texture, pixel, 0);
    let surface = textureLoad(surface_texture, pixel, 0);
    let material = material_number(surface.w, MATERIALS_IN_SET);
    let depth = textureLoad(depth_texture, pixel, 0).r;
    let distance_mm = distance_from_depth_mm(depth, subsurface_view.distance_from_depth);
    if material == NO_MATERIAL || distance_mm == 0.0 {
        return own;
    }
    let row = material_table[material];
    // A texel that is no albedo falls back on the material's own.
    let surface_albedo = select(
        row.surface.surface_albedo,
        clamp(surface.rgb, vec3f(0.0), vec3f(1.0)),
        is_finite_rgb(surface.rgb),
    );
    let diffused = gather_importance_sampled(
        irradiance_texture,
        surface_texture,
        depth_texture,
        subsurface_view,
        pixel,
        material,
        material_profiles(row, surface_albedo),
        distance_mm,
    );
    return vec4f(diffused, own.a);
}

/// Irradiance as it stands: for the pixels that the stencil leaves out.
@fragment
fn passthrough_fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    return textureLoad(irradiance_texture, vec2i(position.xy), 0);
}
