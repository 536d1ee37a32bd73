//! Twin of `shaders/kernels/interleaved.wgsl`.

mod agreement;
mod block;
mod block_ring;
pub(crate) mod far;
mod near;
mod ring;
mod square;
mod window;

use subsurface_kernel::constants::BLOCK_SIDE;

use crate::gather::gathered::{Gathered, Rgb};
use crate::gather::point::Point;
use crate::pictures::patch::{PATCH_SIDE, Patch};
use crate::pictures::scene::Scene;

use agreement::depth_agreement;
use block::Block;
use block_ring::BlockRing;
use far::{Lattice, far_taps};
use near::PixelShares;
use ring::ring_light;
use window::{window_of_taps, window_variance};

/// The near field and the lattice of one footprint.
#[derive(Debug)]
pub(crate) struct Interleaved<'a> {
    point: Point<'a>,
    near: PixelShares,
    block_ring: BlockRing,
    /// Shares of the window, on the farther side first.
    window: [f64; 3],
    /// `None` where the footprint is too small for any tap.
    lattice: Option<Lattice>,
}

impl<'a> Interleaved<'a> {
    pub(crate) fn new(point: Point<'a>, taps: u32) -> Self {
        let window = window_of_taps(taps);
        let taps = point.footprint_taps(far_taps(taps));
        let lattice = (taps > 0).then(|| Lattice::new(&point, taps, window_variance(window)));
        let block_ring = BlockRing::new(&point);
        Self { near: PixelShares::new(&point), block_ring, point, window, lattice }
    }

    /// The pixels of a patch, with the twin that `on` gives for the first and last column of a block.
    pub(crate) fn draw<'s>(on: &impl Fn([i32; 2]) -> &'s Self, scene: Scene, patch: Patch) -> Vec<Rgb>
    where
        'a: 's,
    {
        let on_block = |block: [i32; 2]| {
            let [first, _] = patch.in_scene(block.map(|place| BLOCK_SIDE * place));
            on([first, first + BLOCK_SIDE - 1])
        };
        // Those of the patch's pixels and the ones around.
        let first = patch.start.map(|start| start.div_euclid(BLOCK_SIDE) - 1);
        let last = patch.start.map(|start| (start + PATCH_SIDE - 1).div_euclid(BLOCK_SIDE) + 1);
        let width = last[0] - first[0] + 1;
        let blocks: Vec<Option<Block>> = (first[1]..=last[1])
            .flat_map(|y| (first[0]..=last[0]).map(move |x| [x, y]))
            .map(|block| on_block(block).block(scene, patch, block))
            .collect();
        let block_at = |[x, y]: [i32; 2]| blocks[((y - first[1]) * width + x - first[0]) as usize];
        let home = |pixel: [i32; 2]| on_block(pixel.map(|place| place.div_euclid(BLOCK_SIDE)));
        patch.pixels().map(|pixel| home(pixel).pixel(scene, patch, pixel, &block_at)).collect()
    }

    fn block(&self, scene: Scene, patch: Patch, block: [i32; 2]) -> Option<Block> {
        let lattice = self.lattice.as_ref()?;
        Block::gather(lattice, &self.block_ring, &self.point, scene, patch, block)
    }

    fn pixel(
        &self,
        scene: Scene,
        patch: Patch,
        pixel: [i32; 2],
        block_at: &impl Fn([i32; 2]) -> Option<Block>,
    ) -> Rgb {
        let [x, y] = patch.in_scene(pixel);
        let own = [scene.light(x, y); 3];
        if self.lattice.is_none() {
            return own;
        }
        let depth = scene.depth(x, y);
        let home = pixel.map(|place| place.div_euclid(BLOCK_SIDE));
        let [columns, rows] = pixel.map(|place| self.shares_of(place));
        let mut gathered = Gathered::default();
        for (y, row) in (-1..).zip(rows) {
            for (x, column) in (-1..).zip(columns) {
                let Some(block) = block_at([home[0] + x, home[1] + y]) else { continue };
                let share = row * column * self.agreement(&block, depth);
                gathered.add_share(&block.far, share);
            }
        }
        gathered.add(self.near.centre, own);
        gathered.add_share(&ring_light(&self.near, &self.point, scene, [x, y]), 1.0);
        gathered.diffused(own, self.point.returned)
    }

    /// Shares of a pixel's window in the blocks before its own along an axis, in it and behind it.
    fn shares_of(&self, place: i32) -> [f64; 3] {
        let [farther, own, nearer] = self.window;
        if place.rem_euclid(BLOCK_SIDE) == 0 { [nearer, own, farther] } else { [farther, own, nearer] }
    }

    /// Share of a block's far field that counts at a depth in pixels.
    fn agreement(&self, block: &Block, depth: f64) -> f64 {
        depth_agreement(self.point.depth_pixels(block.depth - depth) * block.depth_factor)
    }
}
