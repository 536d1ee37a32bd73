//! Noise: the twin of `shaders/lib/noise.wgsl`.

/// Interleaved gradient noise of a pixel in a still picture; Jimenez 2014, see the twin.
pub(crate) fn interleaved_gradient_noise([x, y]: [i32; 2]) -> f64 {
    let dot = 0.067_110_56 * f64::from(x) + 0.005_837_15 * f64::from(y);
    (52.982_918_9 * dot.fract()).fract()
}
