//! Twin of `shaders/kernels/interleaved/window.wgsl`.

use subsurface_kernel::constants::{EVEN_WINDOW, EVEN_WINDOW_TAPS, LINEAR_WINDOW};

/// Shares of a pixel's window: in the block on its farther side, in its own, and on its nearer side.
pub(crate) fn window_of_taps(taps: u32) -> [f64; 3] {
    let evenness = (EVEN_WINDOW_TAPS / f64::from(taps.max(1))).min(1.0);
    std::array::from_fn(|place| LINEAR_WINDOW[place] + evenness * (EVEN_WINDOW[place] - LINEAR_WINDOW[place]))
}

/// Mean square of the distance along an axis from a pixel to the blocks that it mixes, pixels².
pub(crate) fn window_variance(window: [f64; 3]) -> f64 {
    let distances = [-2.5, -0.5, 1.5];
    window.iter().zip(distances).map(|(share, distance)| share * distance * distance).sum()
}
