// Three non-negative numbers as mantissas of 9 bits with one exponent: value = mantissa · 2^exponent · the smallest
// step. With an exponent of 5 bits and a smallest step of 2^−24 it is the form that graphics interfaces call RGB9E5.

/// Mantissas and exponent of three numbers.
struct SharedExponent {
    /// Nine bits each, the first number's lowest.
    mantissas: u32,
    exponent: u32,
}

/// Largest number of RGB9E5: 511 · 2^7.
const LARGEST_SHARED_EXPONENT: f32 = 65408.0;

/// Exponent of the smallest step of RGB9E5, 2^−24, with the bias of f32.
const SMALLEST_STEP_EXPONENT: u32 = 103u;

/// The form nearest to `value` with a smallest step of 2^(`step_exponent` − 127). What is not finite or below 0 is the
/// caller's to remove; what is above `largest` becomes that.
fn share_exponent(value: vec3f, largest: f32, step_exponent: u32) -> SharedExponent {
    let limited = clamp(value, vec3f(0.0), vec3f(largest));
    let brightest = max(limited.r, max(limited.g, limited.b));
    // Rounding to 9 bits may carry: half a step more is what the exponent has to hold. 2^e ≤ brightest < 2^(e + 1).
    let carried = bitcast<u32>(brightest) + 0x4000u;
    let exponent = max(carried >> 23u, step_exponent + 8u) - (step_exponent + 8u);
    let steps = bitcast<f32>((254u - step_exponent - exponent) << 23u);
    let mantissas = vec3u(round(limited * steps));
    return SharedExponent(mantissas.r | (mantissas.g << 9u) | (mantissas.b << 18u), exponent);
}

/// The numbers of a form whose mantissas are the low bits of `mantissas`.
fn shared_values(mantissas: u32, exponent: u32, step_exponent: u32) -> vec3f {
    let step = bitcast<f32>((step_exponent + exponent) << 23u);
    return step * vec3f(vec3u(mantissas, mantissas >> 9u, mantissas >> 18u) & vec3u(511u));
}

/// Three numbers as RGB9E5.
fn pack_shared_exponent(value: vec3f) -> u32 {
    let form = share_exponent(value, LARGEST_SHARED_EXPONENT, SMALLEST_STEP_EXPONENT);
    return form.mantissas | (form.exponent << 27u);
}

/// The numbers that `pack_shared_exponent` packed.
fn unpack_shared_exponent(stored: u32) -> vec3f {
    return shared_values(stored, stored >> 27u, SMALLEST_STEP_EXPONENT);
}
