// uses: kernel/constants

/// Interleaved gradient noise in [0, 1): any 3×3 block of pixels holds well-spread values, with no texture to bind.
///
/// Jimenez 2014, "Next Generation Post Processing in Call of Duty: Advanced Warfare", slide 123. `seed` shifts the
/// pattern; the same pixel and seed always give the same value.
fn interleaved_gradient_noise(pixel: vec2i, seed: u32) -> f32 {
    // 5.588238 is that talk's step between patterns; 64 of them repeat before the products lose digits.
    let p = vec2f(pixel) + 5.588238 * f32(seed % 64u);
    return fract(GRADIENT_NOISE.z * fract(dot(p, GRADIENT_NOISE.xy)));
}
