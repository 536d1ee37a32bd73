//! Twin of `shaders/kernels/interleaved.wgsl`.

use super::far_field::{BLOCK_SIDE, Block, Lattice, PIXELS_OF_BLOCK};
use super::gathered::{Gathered, Rgb};
use super::near_field::NearField;
use super::patch::{PATCH_SIDE, Patch};
use super::point::Point;
use super::scene::Scene;

/// Depth difference, in pixels, up to which a far field counts.
pub(super) const BLOCK_DEPTH_PIXELS: f64 = 6.0;

/// The near field and the lattice of one footprint.
#[derive(Debug)]
pub(super) struct Interleaved<'a> {
    point: Point<'a>,
    near: NearField,
    /// `None` where the footprint is too small for any tap.
    lattice: Option<Lattice>,
}

impl<'a> Interleaved<'a> {
    pub(super) fn new(point: Point<'a>, taps: u32) -> Self {
        let taps = point.footprint_taps(taps * PIXELS_OF_BLOCK);
        let lattice = (taps > 0).then(|| Lattice::new(&point, taps));
        Self { near: NearField::new(&point), point, lattice }
    }

    /// The pixels of a patch.
    pub(super) fn draw(&self, scene: Scene, patch: Patch) -> Vec<Rgb> {
        let own = |pixel| {
            let [x, y] = patch.in_scene(pixel);
            [scene.light(x, y); 3]
        };
        let Some(lattice) = &self.lattice else { return patch.pixels().map(own).collect() };
        // Those whose middles are nearest to the outermost pixels: four along an axis where the patch cuts blocks, else five.
        let first = patch.start.map(|start| (start - 1) / BLOCK_SIDE);
        let last = patch.start.map(|start| (start + PATCH_SIDE) / BLOCK_SIDE);
        let width = last[0] - first[0] + 1;
        let blocks: Vec<Block> = (first[1]..=last[1])
            .flat_map(|y| (first[0]..=last[0]).map(move |x| [x, y]))
            .map(|block| Block::gather(lattice, &self.point, scene, patch, block))
            .collect();
        let block_at = |[x, y]: [i32; 2]| &blocks[((y - first[1]) * width + x - first[0]) as usize];
        patch.pixels().map(|pixel| self.pixel(scene, patch, pixel, &block_at)).collect()
    }

    fn pixel<'b>(
        &self,
        scene: Scene,
        patch: Patch,
        pixel: [i32; 2],
        block_at: &impl Fn([i32; 2]) -> &'b Block,
    ) -> Rgb {
        let [x, y] = patch.in_scene(pixel);
        let own = [scene.light(x, y); 3];
        let [home_x, home_y] = pixel.map(|place| place / BLOCK_SIDE);
        let [side_x, side_y] = pixel.map(|place| place % BLOCK_SIDE * 2 - 1);
        // Three quarters of the nearer middle along each axis.
        let shares = [
            (0.5625, [home_x, home_y]),
            (0.1875, [home_x + side_x, home_y]),
            (0.1875, [home_x, home_y + side_y]),
            (0.0625, [home_x + side_x, home_y + side_y]),
        ]
        .map(|(share, block)| {
            let block = block_at(block);
            (share * self.agreement(block.depth - scene.depth(x)), block)
        });
        let agreement: f64 = shares.iter().map(|(share, _)| share).sum();
        if agreement == 0.0 {
            return own;
        }
        let mut gathered = Gathered::default();
        for (share, block) in shares {
            gathered.add_share(&block.far, share / agreement);
        }
        gathered.add(self.near.centre, own);
        if shares[0].0 > 0.0 {
            gathered.add_share(&self.near.ring(&self.point, scene, [x, y]), 1.0);
        }
        gathered.diffused(own, self.point.returned)
    }

    /// Share of a far field that counts `apart` pixels of depth away.
    fn agreement(&self, apart: f64) -> f64 {
        let steps = self.point.depth_pixels(apart) / BLOCK_DEPTH_PIXELS;
        (1.0 - steps * steps).max(0.0)
    }
}
