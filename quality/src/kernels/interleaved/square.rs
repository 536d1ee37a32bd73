//! Twin of `shaders/kernels/interleaved/square.wgsl`: squares of pixels as one pixel.

use subsurface_kernel::constants::{BLOCK_SIDE, STEEPEST_SQUARE};

use crate::gather::point::Point;
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
    /// What a tap at `place` of the scene reads: the square of the screen that is `side` pixels wide and holds it, or
    /// the pixel itself where that is not one surface; `None` where the pixel shows none.
    pub(crate) fn around(
        point: &Point<'_>,
        scene: Scene,
        patch: Patch,
        place: [i32; 2],
        side: i32,
    ) -> Option<Self> {
        let first = patch.square_around(place, side);
        if let Some(square) = Self::whole(point, scene, first, side) {
            return Some(square);
        }
        let [x, y] = place;
        scene.covers(x, y).then(|| Self { light: scene.light(x, y), depth: scene.depth(x, y) })
    }

    /// The square that begins at `first` of the scene, if it is one surface.
    pub(crate) fn whole(point: &Point<'_>, scene: Scene, first: [i32; 2], side: i32) -> Option<Self> {
        if scene.has_whole_squares() {
            let depth = scene.depth_of_square(first, side);
            return Some(Self { light: scene.light_of_square(first, side), depth });
        }
        let half = side / 2;
        let mut parts = [Self { light: 0.0, depth: 0.0 }; 4];
        for (place, part) in parts.iter_mut().enumerate() {
            let [x, y] = [first[0] + half * (place as i32 % 2), first[1] + half * (place as i32 / 2)];
            *part = if side > BLOCK_SIDE {
                Self::whole(point, scene, [x, y], half)?
            } else if scene.covers(x, y) {
                Self { light: scene.light(x, y), depth: scene.depth(x, y) }
            } else {
                return None;
            };
        }
        let reach = 2.0 * f64::from(half) * STEEPEST_SQUARE;
        let is_even = parts.iter().all(|part| point.depth_pixels(part.depth - parts[0].depth).abs() <= reach);
        is_even.then(|| Self {
            light: 0.25 * parts.iter().map(|part| part.light).sum::<f64>(),
            depth: 0.25 * parts.iter().map(|part| part.depth).sum::<f64>(),
        })
    }
}
