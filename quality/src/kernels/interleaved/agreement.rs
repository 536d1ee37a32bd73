//! Twin of `shaders/kernels/interleaved/agreement.wgsl`.

use subsurface_kernel::constants::BLOCK_DEPTH_PIXELS;

/// Share of what lies that many pixels of depth apart that counts: 1 on the surface itself.
pub(crate) fn depth_agreement(depth_pixels: f64) -> f64 {
    let apart = depth_pixels / BLOCK_DEPTH_PIXELS;
    (1.0 - apart * apart).max(0.0)
}
