//! Twin of `shaders/kernels/interleaved/block_ring.wgsl`: the light of the eight blocks around a block.

use subsurface_kernel::constants::{
    ACROSS_RADIUS_PIXELS, BESIDE_RADIUS_PIXELS, BLOCK_DEPTH_PIXELS, BLOCK_SIDE, LARGEST_FILTER_RADIUS,
    PIXELS_ACROSS, PIXELS_BESIDE, SMALLEST_WEIGHT,
};

use crate::gather::gathered::{Gathered, Rgb};
use crate::gather::point::Point;
use crate::pictures::patch::Patch;
use crate::pictures::scene::Scene;

use super::agreement::depth_agreement;
use super::ring::{ACROSS, BESIDE};
use super::square::Square;

/// Shares of a profile's light on a flat surface, in the blocks around.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BlockRing {
    /// Of each block beside.
    beside: Rgb,
    /// Of each block across a corner.
    across: Rgb,
    /// How the density falls with the distance in space.
    falloff: Rgb,
    /// Depth differences up to which a far field serves count in these, pixels.
    pub(crate) depth_factor: f64,
}

impl BlockRing {
    pub(crate) fn new(point: &Point<'_>) -> Self {
        let area = 0.25 * point.pixel * point.pixel;
        let density = |radius: f64| {
            [0, 1, 2].map(|channel: usize| {
                point.optics.channels[channel].profile.area_pdf(radius * point.pixel).max(SMALLEST_WEIGHT)
            })
        };
        let [beside, across] = [BESIDE_RADIUS_PIXELS, ACROSS_RADIUS_PIXELS].map(density);
        let reach = point.filter_radius_pixels.min(LARGEST_FILTER_RADIUS) / (3.0 * BLOCK_DEPTH_PIXELS);
        let doublings = reach.max(1.0).log2().clamp(0.0, 7.0).floor();
        let depth_factor = (-doublings).exp2();
        let mut ring = Self { beside: [0.0; 3], across: [0.0; 3], falloff: [0.0; 3], depth_factor };
        for channel in 0..3 {
            let ratio = across[channel] / beside[channel];
            let x = 0.5 * (ratio * ACROSS_RADIUS_PIXELS / BESIDE_RADIUS_PIXELS).ln();
            let squared = (x * x).min(4.0);
            let sinh_over_x = 1.0 + squared / 6.0 * (1.0 + squared / 20.0);
            ring.beside[channel] = PIXELS_BESIDE * area * sinh_over_x * beside[channel];
            ring.across[channel] = PIXELS_ACROSS * area * sinh_over_x * across[channel];
            ring.falloff[channel] = ratio.sqrt().recip() - 1.0;
        }
        ring
    }

    /// Light around the block `block` of the screen, which is `depth` pixels away.
    pub(crate) fn gather(
        &self,
        point: &Point<'_>,
        scene: Scene,
        patch: Patch,
        block: [i32; 2],
        depth: f64,
    ) -> Gathered {
        let mut gathered = Gathered::default();
        for (share, squared_blocks, ring) in [(self.beside, 1.0, BESIDE), (self.across, 2.0, ACROSS)] {
            for [right, down] in ring {
                // Where the block is no square, one of its pixels: see the shader.
                let past_centre = 3 * (down + 1) + right + 1;
                let number = past_centre - i32::from(past_centre > 4);
                let which = [(number + block[0]) & 1, ((number >> 1) + block[1]) & 1];
                let pixel =
                    [BLOCK_SIDE * (block[0] + right) + which[0], BLOCK_SIDE * (block[1] + down) + which[1]];
                let square = Square::around(point, scene, patch, patch.in_scene(pixel), BLOCK_SIDE);
                let Some(square) = square else { continue };
                let steps = point.depth_pixels(square.depth - depth);
                let squared_radius = squared_blocks * f64::from(BLOCK_SIDE * BLOCK_SIDE);
                let kept = depth_agreement(0.5 * self.depth_factor * steps);
                let weight = std::array::from_fn(|channel| {
                    let farther = 1.0 + self.falloff[channel] * steps * steps / squared_radius;
                    share[channel] * kept / (farther * farther)
                });
                gathered.add(weight, [square.light; 3]);
            }
        }
        gathered
    }
}
