//! Noise: the twin of `shaders/lib/noise.wgsl`.

use subsurface_kernel::constants::GRADIENT_NOISE;

/// Interleaved gradient noise of a pixel in a still picture; Jimenez 2014, see the twin.
pub(crate) fn interleaved_gradient_noise([x, y]: [i32; 2]) -> f64 {
    let [of_column, of_row, factor] = GRADIENT_NOISE;
    let dot = of_column * f64::from(x) + of_row * f64::from(y);
    let fraction = |x: f64| x - x.floor();
    fraction(factor * fraction(dot))
}
