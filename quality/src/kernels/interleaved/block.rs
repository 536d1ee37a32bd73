//! Twin of `shaders/kernels/interleaved/block.wgsl`: 2×2 pixels share one far field.

use subsurface_kernel::constants::BLOCK_SIDE;

use crate::gather::gathered::Gathered;
use crate::gather::point::Point;
use crate::pictures::patch::Patch;
use crate::pictures::scene::Scene;

use super::block_ring::BlockRing;
use super::far::{Lattice, lattice_slice};

/// A block as its pixels read it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Block {
    pub(crate) far: Gathered,
    /// Mean distance, pixels.
    pub(crate) depth: f64,
}

impl Block {
    /// The block `block` of the screen.
    pub(crate) fn gather(
        lattice: &Lattice,
        ring: &BlockRing,
        point: &Point<'_>,
        scene: Scene,
        patch: Patch,
        block: [i32; 2],
    ) -> Self {
        let first = patch.in_scene(block.map(|place| BLOCK_SIDE * place));
        let position = first.map(|place| f64::from(place) + 0.5);
        let depth = 0.5 * (scene.depth(first[0]) + scene.depth(first[0] + 1));
        let mut far = Gathered::default();
        let sampled = lattice.gather(point, scene, patch, lattice_slice(block), position, depth);
        far.add_share(&sampled, point.blend());
        far.add_share(&ring.gather(point, scene, patch, first, depth), point.blend());
        Self { far, depth }
    }
}
