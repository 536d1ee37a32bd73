// uses: kernel/constants, lib/{albedo_mix, angle, covering_triangle, medium_angles, numeric_limits, tone}

/// How radiance becomes a picture.
struct CompositeSettings {
    /// Radiance of the background at the top, red, green, blue.
    background_top: vec3f,
    /// Factor on all radiance before tone mapping.
    exposure: f32,
    /// Radiance of the background at the bottom, red, green, blue.
    background_bottom: vec3f,
    /// 1: tone map to [0, 1]; 0: leave radiance as it is.
    tone_map: u32,
    /// 1: encode as sRGB code values; 0: the target encodes, or stays linear.
    encode_srgb: u32,
}

/// Whether light was multiplied by a part of the surface albedo before it diffused; the pipeline says it.
override HAS_ALBEDO_MIXES: bool = false;

@group(0) @binding(0) var<uniform> composite_settings: CompositeSettings;
/// Irradiance after the subsurface pass; alpha is the share of it that the specular lobe lets out.
@group(0) @binding(1) var diffused_texture: texture_2d<f32>;
/// Specular reflection + transmission, radiance; alpha: see `pack_exit`, 0 behind all geometry.
@group(0) @binding(2) var unscattered_texture: texture_2d<f32>;
/// Surface albedo (red, green, blue) and the material number.
@group(0) @binding(3) var surface_texture: texture_2d<f32>;
/// Power of the surface albedo that came before, four materials each.
@group(0) @binding(4) var<uniform> albedo_mixes: array<vec4f, MOST_MATERIALS / 4u>;

@vertex
fn composite_vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return covering_triangle(index);
}

/// L = E A / π · exit + specular + transmission, then exposure, tone mapping and sRGB.
@fragment
fn composite_fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(position.xy);
    let diffused = textureLoad(diffused_texture, pixel, 0);
    let unscattered = textureLoad(unscattered_texture, pixel, 0);
    let surface = textureLoad(surface_texture, pixel, 0);
    var leaving_albedo = surface.rgb;
    if HAS_ALBEDO_MIXES && surface.a >= 0.0 {
        let material = min(u32(surface.a), MOST_MATERIALS - 1u);
        leaving_albedo = albedo_after(surface.rgb, albedo_mixes[material / 4u][material % 4u]);
    }

    let height = f32(textureDimensions(diffused_texture).y);
    let background = mix(composite_settings.background_top, composite_settings.background_bottom, position.y / height);
    let exit = diffused.a * exit_of(unscattered.a, surface.rgb);
    let lit = diffused.rgb * leaving_albedo / PI * exit + unscattered.rgb;
    // A half float of the output must not end at infinity.
    let bounded = min(lit, vec3f(LARGEST_HALF));
    let radiance = composite_settings.exposure * select(background, bounded, unscattered.a > 0.5);

    let settings = composite_settings;
    let colour = display_colour(radiance, settings.tone_map, settings.encode_srgb);
    return vec4f(colour, min(unscattered.a, 1.0));
}
