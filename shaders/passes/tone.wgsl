// uses: lib/{covering_triangle, tone}

/// How radiance becomes a picture.
struct ToneSettings {
    /// Factor on all radiance before tone mapping.
    exposure: f32,
    /// 1: tone map to [0, 1]; 0: leave radiance as it is.
    tone_map: u32,
    /// 1: encode as sRGB code values; 0: the target encodes, or stays linear.
    encode_srgb: u32,
}

@group(0) @binding(0) var<uniform> tone_settings: ToneSettings;
/// Radiance; alpha is handed through.
@group(0) @binding(1) var radiance_texture: texture_2d<f32>;

@vertex
fn tone_vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return covering_triangle(index);
}

@fragment
fn tone_fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let radiance = textureLoad(radiance_texture, vec2i(position.xy), 0);
    let settings = tone_settings;
    return vec4f(display_colour(settings.exposure * radiance.rgb, settings.tone_map, settings.encode_srgb), radiance.a);
}
