//! Twin of `shaders/kernels/interleaved/block.wgsl`: 2×2 pixels share one far field.

use subsurface_kernel::constants::BLOCK_SIDE;

use crate::gather::gathered::Gathered;
use crate::gather::point::Point;
use crate::pictures::patch::Patch;
use crate::pictures::scene::Scene;

use super::agreement::depth_agreement;
use super::block_ring::BlockRing;
use super::far::{Lattice, lattice_slice};
use super::square::Square;

/// A block as its pixels read it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Block {
    pub(crate) far: Gathered,
    /// Distance at which it counts, pixels.
    pub(crate) depth: f64,
    /// What the depth from it to a pixel is multiplied by.
    pub(crate) depth_factor: f64,
}

/// The pixels of a block that are of its nearest surface, as one.
struct Surface {
    /// Their mean position in the scene.
    position: [f64; 2],
    /// Their mean distance, pixels.
    depth: f64,
}

impl Surface {
    /// Those of the block that begins at `first` of the scene; `None` where it shows no surface.
    fn of(point: &Point<'_>, scene: Scene, first: [i32; 2]) -> Option<Self> {
        let pixels =
            [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[right, down]| [first[0] + right, first[1] + down]);
        let shown = || pixels.into_iter().filter(|[x, y]| scene.covers(*x, *y));
        let nearest = shown().map(|[x, y]| scene.depth(x, y)).reduce(f64::min)?;
        let (mut position, mut depth, mut count) = ([0.0; 2], 0.0, 0.0);
        for [x, y] in shown() {
            let own = scene.depth(x, y);
            if depth_agreement(point.depth_pixels(own - nearest)) > 0.0 {
                position = [position[0] + f64::from(x), position[1] + f64::from(y)];
                depth += own;
                count += 1.0;
            }
        }
        Some(Self { position: position.map(|sum| sum / count), depth: depth / count })
    }
}

impl Block {
    /// The block `block` of the screen; `None` where it shows no surface.
    pub(crate) fn gather(
        lattice: &Lattice,
        ring: &BlockRing,
        point: &Point<'_>,
        scene: Scene,
        patch: Patch,
        block: [i32; 2],
    ) -> Option<Self> {
        let first = patch.in_scene(block.map(|place| BLOCK_SIDE * place));
        let surface = Surface::of(point, scene, first)?;
        let mut far = Gathered::default();
        let slice = lattice_slice(block);
        let sampled = lattice.gather(point, scene, patch, slice, surface.position, surface.depth);
        far.add_share(&sampled, point.blend());
        far.add_share(&ring.gather(point, scene, patch, block, surface.depth), point.blend());
        let square = Square::whole(point, scene, first, BLOCK_SIDE);
        let depth = square.map_or(surface.depth, |square| square.depth);
        Some(Self { far, depth, depth_factor: ring.depth_factor })
    }
}
