//! Twin of `shaders/kernels/interleaved/agreement.wgsl`.

use subsurface_kernel::constants::{BLOCK_DEPTH_PIXELS, REMOTE_AGREEMENT, REMOTE_DEPTH};

/// Share of what lies that many pixels of depth apart that counts: 1 on the surface itself.
pub(crate) fn depth_agreement(depth_pixels: f64) -> f64 {
    let apart = depth_pixels / BLOCK_DEPTH_PIXELS;
    (1.0 - apart * apart).max(0.0)
}

/// Share of a far field that counts for a pixel that many pixels of depth apart.
pub(crate) fn remote_agreement(depth_pixels: f64) -> f64 {
    let apart = depth_pixels / BLOCK_DEPTH_PIXELS;
    let remote = REMOTE_AGREEMENT * (1.0 - (apart / REMOTE_DEPTH).powi(2));
    (1.0 - apart * apart).max(remote).max(0.0)
}
