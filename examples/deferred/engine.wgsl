// A deferred renderer as somebody else may have written it: spheres under one light, in view space.

/// A sphere.
struct Ball {
    centre: vec3f,
    radius: f32,
    albedo: vec3f,
    /// Number of the material, or 255.
    material: u32,
}

struct Scene {
    clip_from_view: mat4x4f,
    towards_light: vec3f,
    light_irradiance: f32,
    ambient_irradiance: f32,
    balls: array<Ball, 3>,
}

@group(0) @binding(0) var<uniform> scene: Scene;

struct Surface {
    @builtin(position) clip_position: vec4f,
    @location(0) normal: vec3f,
    @location(1) @interpolate(flat) ball: u32,
}

struct GBuffer {
    @location(0) albedo: vec4f,
    @location(1) normal: vec4f,
    @location(2) material: u32,
}

const RINGS: u32 = 96u;

/// Corner of a grid of quadrilaterals that is bent to a sphere.
@vertex
fn ball_vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) ball: u32) -> Surface {
    let corners = array(vec2u(0u, 0u), vec2u(1u, 0u), vec2u(0u, 1u), vec2u(0u, 1u), vec2u(1u, 0u), vec2u(1u, 1u));
    let cell = index / 6u;
    let place = vec2f(vec2u(cell / RINGS, cell % RINGS) + corners[index % 6u]) / f32(RINGS);
    let theta = place.x * 3.14159265;
    let phi = place.y * 6.28318531;
    let normal = vec3f(sin(theta) * sin(phi), cos(theta), sin(theta) * cos(phi));
    let at = scene.balls[ball].centre + scene.balls[ball].radius * normal;
    return Surface(scene.clip_from_view * vec4f(at, 1.0), normal, ball);
}

@fragment
fn ball_fragment(surface: Surface) -> GBuffer {
    let ball = scene.balls[surface.ball];
    return GBuffer(vec4f(ball.albedo, 1.0), vec4f(normalize(surface.normal), 0.0), ball.material);
}

@group(1) @binding(0) var albedo_texture: texture_2d<f32>;
@group(1) @binding(1) var normal_texture: texture_2d<f32>;

@vertex
fn screen_vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}

/// What arrives at a diffuse surface, before its albedo: what the subsurface pass takes. Alpha says where there is one.
@fragment
fn light_fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(position.xy);
    let is_surface = textureLoad(albedo_texture, pixel, 0).a;
    let cosine = max(dot(textureLoad(normal_texture, pixel, 0).xyz, scene.towards_light), 0.0);
    return is_surface * vec4f(vec3f(scene.light_irradiance * cosine + scene.ambient_irradiance), 1.0);
}

@group(1) @binding(2) var diffused_texture: texture_2d<f32>;

/// The picture: diffused irradiance times albedo over π, before a grey wall.
@fragment
fn resolve_fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(position.xy);
    let diffused = textureLoad(diffused_texture, pixel, 0);
    let radiance = diffused.rgb * textureLoad(albedo_texture, pixel, 0).rgb / 3.14159265;
    return vec4f(mix(vec3f(0.05), radiance, diffused.a), 1.0);
}
