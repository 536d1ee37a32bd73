//! Twin of `shaders/kernels/interleaved/ring.wgsl`: the light of a pixel's eight neighbours.

use crate::gather::gathered::Gathered;
use crate::gather::point::Point;
use crate::pictures::scene::Scene;

use super::agreement::depth_agreement;
use super::near::PixelShares;

/// The neighbours beside a pixel, and across its corners.
pub(crate) const BESIDE: [[i32; 2]; 4] = [[-1, 0], [1, 0], [0, -1], [0, 1]];
pub(crate) const ACROSS: [[i32; 2]; 4] = [[-1, -1], [1, -1], [-1, 1], [1, 1]];

/// Light of the ring around a pixel of the scene.
pub(crate) fn ring_light(near: &PixelShares, point: &Point<'_>, scene: Scene, [x, y]: [i32; 2]) -> Gathered {
    let mut gathered = Gathered::default();
    for (share, squared_radius, ring) in [(near.beside, 1.0, BESIDE), (near.across, 2.0, ACROSS)] {
        for [right, down] in ring {
            if !scene.covers(x + right, y + down) {
                continue;
            }
            let steps = point.depth_pixels(scene.depth(x + right, y + down) - scene.depth(x, y));
            let on_surface = depth_agreement(steps);
            let kept = on_surface * squared_radius / (squared_radius + steps * steps);
            gathered.add(share.map(|share| kept * share), [scene.light(x + right, y + down); 3]);
        }
    }
    gathered
}
