//! Twin of `shaders/kernels/interleaved/square.wgsl`: squares of pixels as one pixel. Those of the pictures are all whole:
//! their slopes are less steep than what is told apart.

use crate::pictures::patch::Patch;
use crate::pictures::scene::Scene;

/// The pixels of a square as one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Square {
    /// Mean irradiance.
    pub(crate) light: f64,
    /// Mean distance, pixels.
    pub(crate) depth: f64,
}

impl Square {
    /// The square of the screen that is `side` pixels wide and holds the pixel at `place` of the scene.
    pub(crate) fn around(scene: Scene, patch: Patch, place: [i32; 2], side: i32) -> Self {
        let first = patch.square_around(place, side);
        Self { light: scene.light_of_square(first, side), depth: scene.depth_of_square(first[0], side) }
    }
}
