//! Neck and shoulders, down to the cut.

use super::distance::{difference, ellipsoid, intersection, limb, tube, union};
use glam::Vec3;

/// Height of the base's plane (mm).
pub(super) const BASE: f32 = -214.0;

/// Distance to neck, shoulders and chest, cut off below and at the sides. `p.x` is already folded to x ≥ 0.
pub(super) fn body(p: Vec3) -> f32 {
    let neck = limb(p, [0.0, -60.0, -22.0], 43.0, [0.0, -190.0, -40.0], 46.0);
    let trapezius = limb(p, [14.0, -80.0, -46.0], 20.0, [94.0, -206.0, -50.0], 18.0);
    let chest = ellipsoid(p, [0.0, -240.0, -36.0], [118.0, 66.0, 62.0]);
    let shoulder = ellipsoid(p, [96.0, -218.0, -46.0], [40.0, 38.0, 44.0]);
    let clavicle =
        tube(p, [9.0, -193.0, 13.0], [55.0, -190.0, 16.0], [104.0, -186.0, -34.0], [4.0, 3.0, 4.0]);
    let mastoid = tube(p, [36.0, -36.0, -22.0], [42.0, -112.0, -6.0], [9.0, -193.0, 9.0], [5.0, 6.5, 4.0]);
    let larynx = ellipsoid(p, [0.0, -130.0, 10.0], [9.0, 14.0, 8.0]);
    let mut d = union(neck, trapezius, 40.0);
    d = union(d, union(chest, shoulder, 36.0), 40.0);
    d = union(d, clavicle, 16.0);
    d = union(d, mastoid, 22.0);
    d = union(d, larynx, 14.0);
    d = difference(d, ellipsoid(p, [0.0, -188.0, 22.0], [9.0, 11.0, 9.0]), 12.0);
    cut(p, d)
}

/// The clean cut: a flat base, and sides that lean in towards it.
fn cut(p: Vec3, d: f32) -> f32 {
    let side = ellipsoid(p, [0.0, -140.0, -32.0], [118.0, 140.0, 92.0]);
    let d = intersection(d, side, 6.0);
    intersection(d, BASE - p.y, 4.0)
}
