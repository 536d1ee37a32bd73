//! Twin of `shaders/kernels/interleaved/near.wgsl`: what stays within a pixel and its eight neighbours.

use super::gathered::{Gathered, Rgb};
use super::point::Point;
use super::scene::Scene;
use subsurface_kernel::constants::{
    BLOCK_DEPTH_PIXELS, FAR_RADIUS_PIXELS, HALF_LOG_3_OF_2, NEAR_RADIUS_PIXELS,
};

/// The neighbours beside a pixel, and across its corners.
const BESIDE: [[i32; 2]; 4] = [[-1, 0], [1, 0], [0, -1], [0, 1]];
const ACROSS: [[i32; 2]; 4] = [[-1, -1], [1, -1], [-1, 1], [1, 1]];

/// Shares of the light on a flat surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct NearField {
    /// Of the pixel itself.
    pub(super) centre: Rgb,
    /// Of each pixel beside it.
    beside: Rgb,
    /// Of each pixel across its corners.
    across: Rgb,
}

impl NearField {
    pub(super) fn new(point: &Point<'_>) -> Self {
        let centre = point.radial_cdf(NEAR_RADIUS_PIXELS * point.pixel);
        let inside = point.radial_cdf(FAR_RADIUS_PIXELS * point.pixel);
        let blend = point.blend();
        let mut shares = Self { centre: [0.0; 3], beside: [0.0; 3], across: [0.0; 3] };
        for channel in 0..3 {
            let growth = inside[channel] / centre[channel].max(1e-12);
            let across = 0.5 * growth.powf(HALF_LOG_3_OF_2);
            let beside = (inside[channel] - centre[channel]) / (4.0 + 4.0 * across);
            shares.centre[channel] = 1.0 + blend * (centre[channel] - 1.0);
            shares.beside[channel] = blend * beside;
            shares.across[channel] = blend * beside * across;
        }
        shares
    }

    /// Light of the ring around a pixel of the scene.
    pub(super) fn ring(&self, point: &Point<'_>, scene: Scene, [x, y]: [i32; 2]) -> Gathered {
        let mut gathered = Gathered::default();
        for (share, squared_radius, ring) in [(self.beside, 1.0, BESIDE), (self.across, 2.0, ACROSS)] {
            for [right, down] in ring {
                let steps = point.depth_pixels(scene.depth(x + right) - scene.depth(x));
                let off_surface = steps / BLOCK_DEPTH_PIXELS;
                let on_surface = (1.0 - off_surface * off_surface).max(0.0);
                let kept = on_surface * squared_radius / (squared_radius + steps * steps);
                gathered.add(share.map(|share| kept * share), [scene.light(x + right, y + down); 3]);
            }
        }
        gathered
    }
}
