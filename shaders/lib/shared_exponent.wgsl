// Three non-negative numbers in 32 bits: 9 bits each and one exponent of 5 bits. The form that graphics interfaces call
// RGB9E5: value = mantissa · 2^(exponent − 24).

/// Largest number that has the form: 511 · 2^7.
const LARGEST_SHARED_EXPONENT: f32 = 65408.0;

/// Exponent of the smallest step, 2^−24, with the bias of f32.
const SMALLEST_STEP_EXPONENT: u32 = 103u;

/// The nearest `value` that three mantissas of 9 bits and one exponent hold. What is not finite or below 0 is the
/// caller's to remove; what is too large becomes the largest.
fn pack_shared_exponent(value: vec3f) -> u32 {
    let limited = clamp(value, vec3f(0.0), vec3f(LARGEST_SHARED_EXPONENT));
    let largest = max(limited.r, max(limited.g, limited.b));
    // Rounding to 9 bits may carry: half a step more is what the exponent has to hold. 2^e ≤ largest < 2^(e + 1).
    let carried = bitcast<u32>(largest) + 0x4000u;
    let exponent = max(carried >> 23u, 111u) - 111u;
    let steps = bitcast<f32>((127u + 24u - exponent) << 23u);
    let mantissas = vec3u(round(limited * steps));
    return mantissas.r | (mantissas.g << 9u) | (mantissas.b << 18u) | (exponent << 27u);
}

/// The numbers that `pack_shared_exponent` packed.
fn unpack_shared_exponent(stored: u32) -> vec3f {
    let step = bitcast<f32>((SMALLEST_STEP_EXPONENT + (stored >> 27u)) << 23u);
    return step * vec3f(vec3u(stored, stored >> 9u, stored >> 18u) & vec3u(511u));
}
