// What all baselines share: bindings and entry points. Each adds
//
//     fn gather(pixel: vec2i, own: vec4f, distance_mm: f32) -> vec3f
//
// the diffused irradiance of a translucent pixel of irradiance `own`.

struct Settings {
    /// Burley's d of red, green and blue, mm; 0 where the method does not ask for it.
    scattering_distance_mm: vec3f,
    /// Radius beyond which nothing is read, mm.
    reach_mm: f32,
    /// Millimetres that a pixel spans = x + y·distance.
    millimetres_per_pixel: vec2f,
    /// Taps, or the most of them.
    taps: u32,
    /// Of methods with two passes: 0 along x, 1 along y.
    axis: u32,
}

@group(0) @binding(0) var<uniform> settings: Settings;
@group(0) @binding(1) var irradiance_texture: texture_2d<f32>;
/// Distance along the view axis, mm; 0 for background.
@group(0) @binding(2) var distance_texture: texture_2d<f32>;
/// Surface albedo; the material number.
@group(0) @binding(3) var surface_texture: texture_2d<f32>;
/// What the method has computed before.
@group(0) @binding(4) var<storage, read> table: array<vec4f>;
@group(0) @binding(5) var output_texture: texture_storage_2d<rgba16float, write>;

const PI: f32 = 3.14159265;
const TAU: f32 = 6.28318531;
/// π(3 − √5)
const GOLDEN_ANGLE: f32 = 2.39996323;

fn pixel_mm(distance_mm: f32) -> f32 {
    return settings.millimetres_per_pixel.x + settings.millimetres_per_pixel.y * distance_mm;
}

/// Whether the pixel is inside the picture.
fn is_inside(pixel: vec2i) -> bool {
    return all(pixel >= vec2i(0)) && all(pixel < vec2i(textureDimensions(distance_texture)));
}

fn load_distance_mm(pixel: vec2i) -> f32 {
    return textureLoad(distance_texture, pixel, 0).r;
}

/// What `load_distance_mm` gives, or 0 outside of the picture.
fn tap_distance_mm(pixel: vec2i) -> f32 {
    if !is_inside(pixel) {
        return 0.0;
    }
    return load_distance_mm(pixel);
}

/// A static angle per pixel: PCG hash of its coordinates (Jarzynski and Olano 2020, "Hash Functions for GPU Rendering",
/// JCGT 9(3), `pcg2d`).
fn pixel_angle(pixel: vec2i) -> f32 {
    var v = vec2u(pixel) * 1664525u + 1013904223u;
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    v ^= v >> vec2u(16u);
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    v ^= v >> vec2u(16u);
    return TAU * f32(v.x >> 8u) / 16777216.0;
}

/// 8π r R(r) / A of Burley's profile, [CB15] eq. (3): (e^(−r/d) + e^(−r/3d)) / d per channel.
fn burley(radius_mm: f32, d: vec3f) -> vec3f {
    let third = exp(-radius_mm / (3.0 * d));
    return (third * third * third + third) / d;
}

/// Inverse of Burley's radial CDF for d = 1, exact: Golubev 2018, "Efficient Screen-Space Subsurface Scattering Using
/// Burley's Normalized Diffusion in Real-Time", SIGGRAPH Advances in Real-Time Rendering.
fn burley_quantile(u: f32) -> f32 {
    let rest = 1.0 - u;
    let g = pow(2.0 * rest + sqrt(1.0 + 4.0 * rest * rest), 1.0 / 3.0);
    return -3.0 * log(g - 1.0 / g);
}

fn diffused(pixel: vec2i) -> vec4f {
    let own = textureLoad(irradiance_texture, pixel, 0);
    let distance_mm = load_distance_mm(pixel);
    if distance_mm == 0.0 {
        return own;
    }
    return vec4f(gather(pixel, own, distance_mm), own.a);
}

@vertex
fn baseline_vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(f32(index % 2u) * 4.0 - 1.0, f32(index / 2u) * 4.0 - 1.0, 0.0, 1.0);
}

@fragment
fn baseline_fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    return diffused(vec2i(position.xy));
}

@compute @workgroup_size(8, 8)
fn baseline_compute(@builtin(global_invocation_id) invocation: vec3u) {
    let pixel = vec2i(invocation.xy);
    if is_inside(pixel) {
        textureStore(output_texture, pixel, diffused(pixel));
    }
}
