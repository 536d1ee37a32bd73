/// Smallest exponent of a packed line, with the bias of f32: its steps are the smallest that are normal numbers.
const SMALLEST_LINE_EXPONENT: u32 = 16u;

/// What the first pass keeps of a pixel: three mantissas of 16 bits with the exponent of the brightest, so that any
/// irradiance fits.
fn pack_line(irradiance: vec3f) -> vec2u {
    let brightest = max(irradiance.r, max(irradiance.g, irradiance.b));
    let exponent = max(bitcast<u32>(brightest) >> 23u, SMALLEST_LINE_EXPONENT);
    let steps = bitcast<f32>((127u + 142u - exponent) << 23u);
    let mantissas = min(vec3u(round(irradiance * steps)), vec3u(0xffffu));
    return vec2u(mantissas.r | (mantissas.g << 16u), mantissas.b | (exponent << 16u));
}

/// The irradiance that `pack_line` packed.
fn unpack_line(words: vec2u) -> vec3f {
    let step = bitcast<f32>(((words.y >> 16u) - 15u) << 23u);
    return step * vec3f(vec3u(words.x, words.x >> 16u, words.y) & vec3u(0xffffu));
}
