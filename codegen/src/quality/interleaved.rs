//! Twin of `shaders/kernels/interleaved.wgsl`.

use super::far_field::{Block, Lattice};
use super::gathered::{Gathered, Rgb};
use super::near_field::NearField;
use super::patch::{PATCH_SIDE, Patch};
use super::point::Point;
use super::scene::Scene;
use subsurface_kernel::constants::{
    BLOCK_DEPTH_PIXELS, BLOCK_SIDE, EVEN_WINDOW, EVEN_WINDOW_TAPS, LINEAR_WINDOW, PIXELS_OF_BLOCK,
};

/// The near field and the lattice of one footprint.
#[derive(Debug)]
pub(super) struct Interleaved<'a> {
    point: Point<'a>,
    near: NearField,
    /// Shares of the window, on the farther side first.
    window: [f64; 3],
    /// `None` where the footprint is too small for any tap.
    lattice: Option<Lattice>,
}

impl<'a> Interleaved<'a> {
    pub(super) fn new(point: Point<'a>, taps: u32) -> Self {
        let evenness = (EVEN_WINDOW_TAPS / f64::from(taps.max(1))).min(1.0);
        let window = std::array::from_fn(|place| {
            LINEAR_WINDOW[place] + evenness * (EVEN_WINDOW[place] - LINEAR_WINDOW[place])
        });
        let taps = point.footprint_taps(taps * PIXELS_OF_BLOCK);
        let lattice = (taps > 0).then(|| Lattice::new(&point, taps));
        Self { near: NearField::new(&point), point, window, lattice }
    }

    /// The pixels of a patch.
    pub(super) fn draw(&self, scene: Scene, patch: Patch) -> Vec<Rgb> {
        let own = |pixel| {
            let [x, y] = patch.in_scene(pixel);
            [scene.light(x, y); 3]
        };
        let Some(lattice) = &self.lattice else { return patch.pixels().map(own).collect() };
        // Those of the patch's pixels and the ones around.
        let first = patch.start.map(|start| start.div_euclid(BLOCK_SIDE) - 1);
        let last = patch.start.map(|start| (start + PATCH_SIDE - 1).div_euclid(BLOCK_SIDE) + 1);
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
        let depth = scene.depth(x);
        let home = pixel.map(|place| place.div_euclid(BLOCK_SIDE));
        let [columns, rows] = pixel.map(|place| self.window_shares(place));
        let mut mixed = Gathered::default();
        let mut agreement = 0.0;
        for (y, row) in (-1..).zip(rows) {
            for (x, column) in (-1..).zip(columns) {
                let block = block_at([home[0] + x, home[1] + y]);
                let share = row * column * self.agreement(block.depth - depth);
                mixed.add_share(&block.far, share);
                agreement += share;
            }
        }
        if agreement == 0.0 {
            return own;
        }
        let mut gathered = Gathered::default();
        gathered.add_share(&mixed, 1.0 / agreement);
        gathered.add(self.near.centre, own);
        if self.agreement(block_at(home).depth - depth) > 0.0 {
            gathered.add_share(&self.near.ring(&self.point, scene, [x, y]), 1.0);
        }
        gathered.diffused(own, self.point.returned)
    }

    /// Shares of a pixel's window in the blocks before its own along an axis, in it and behind it.
    fn window_shares(&self, place: i32) -> [f64; 3] {
        let [farther, own, nearer] = self.window;
        if place.rem_euclid(BLOCK_SIDE) == 0 { [nearer, own, farther] } else { [farther, own, nearer] }
    }

    /// Share of a far field that counts `apart` pixels of depth away.
    fn agreement(&self, apart: f64) -> f64 {
        let steps = self.point.depth_pixels(apart) / BLOCK_DEPTH_PIXELS;
        (1.0 - steps * steps).max(0.0)
    }
}
