//! Skull, jaw and the features of the face, all about the plane x = 0.

use super::distance::{bell, difference, ellipsoid, limb, sphere, tube, union};
use glam::Vec3;

/// Distance to head without ears and neck. `p.x` is already folded to x ≥ 0.
pub(super) fn head(p: Vec3) -> f32 {
    let mut d = skull(p);
    d = union(d, jaw(p), 26.0);
    d = union(d, cheek(p), 22.0);
    // Features stand in front of the plane z = 40; behind it they could add nothing.
    if p.z > 30.0 {
        d = brow(p, d);
        d = nose(p, d);
        d = eye(p, d);
        d = mouth(p, d);
    }
    d
}

fn skull(p: Vec3) -> f32 {
    let cranium = ellipsoid(p, [0.0, 39.0, -18.0], [71.0, 77.0, 88.0]);
    let forehead = ellipsoid(p, [0.0, 42.0, 12.0], [62.0, 54.0, 67.0]);
    let temple = ellipsoid(p, [0.0, 14.0, 20.0], [66.0, 46.0, 52.0]);
    let face = ellipsoid(p, [0.0, -28.0, 28.0], [54.0, 72.0, 52.0]);
    union(union(union(cranium, forehead, 24.0), temple, 24.0), face, 30.0)
}

fn jaw(p: Vec3) -> f32 {
    let ramus = limb(p, [57.0, -14.0, -4.0], 10.0, [45.0, -60.0, 8.0], 9.0);
    let body = limb(p, [45.0, -60.0, 8.0], 9.0, [13.0, -94.0, 61.0], 11.0);
    let chin = ellipsoid(p, [0.0, -96.0, 68.0], [17.0, 14.0, 15.0]);
    union(union(ramus, body, 14.0), chin, 16.0)
}

fn cheek(p: Vec3) -> f32 {
    let bone = limb(p, [42.0, -13.0, 54.0], 12.0, [60.0, -8.0, 16.0], 7.0);
    let flesh = ellipsoid(p, [33.0, -42.0, 50.0], [22.0, 26.0, 20.0]);
    let under_eye = ellipsoid(p, [27.0, -24.0, 62.0], [20.0, 18.0, 15.0]);
    union(union(bone, flesh, 22.0), under_eye, 22.0)
}

fn brow(p: Vec3, d: f32) -> f32 {
    let ridge = tube(p, [6.0, 17.0, 75.0], [30.0, 29.0, 75.0], [52.0, 12.0, 53.0], [4.0, 4.5, 4.0]);
    let d = union(d, ridge, 18.0);
    let socket = ellipsoid(p, [31.0, 3.0, 84.0], [19.0, 12.0, 15.0]);
    let inner = ellipsoid(p, [17.0, 3.0, 84.0], [7.0, 10.0, 12.0]);
    difference(d, union(socket, inner, 8.0), 16.0)
}

fn eye(p: Vec3, d: f32) -> f32 {
    let ball = sphere(p, [31.0, 2.0, 58.5], 14.0);
    // Both lines are hollows of the ball itself: where the ball dips under the skin of the socket, they end.
    let across = (p.x - 31.0) / 14.0;
    let arc = 1.0 - across * across;
    // The closed lids meet in an arc that hangs down; the crease of the upper lid runs above it.
    let slit = 1.9 * bell(p.y + 0.5 + 4.4 * arc, 1.4);
    let crease = 1.3 * bell(p.y - 3.5 - 6.0 * arc, 1.7);
    union(d, ball + slit + crease, 3.5)
}

fn nose(p: Vec3, d: f32) -> f32 {
    let bridge = limb(p, [0.0, 14.0, 76.0], 5.5, [0.0, -28.0, 96.0], 6.5);
    let flank = limb(p, [0.0, 6.0, 66.0], 8.0, [0.0, -32.0, 80.0], 15.0);
    let tip = sphere(p, [0.0, -33.0, 99.0], 7.8);
    let wing = ellipsoid(p, [11.0, -37.0, 87.0], [6.0, 6.5, 9.5]);
    let columella = limb(p, [0.0, -37.0, 98.0], 4.5, [0.0, -42.0, 86.0], 4.0);
    let mut nose = union(bridge, flank, 14.0);
    nose = union(nose, tip, 9.0);
    nose = union(nose, columella, 5.0);
    nose = union(nose, wing, 9.0);
    let d = union(d, nose, 9.0);
    let nostril = limb(p, [6.0, -46.5, 92.0], 2.6, [6.0, -39.0, 90.0], 2.0);
    difference(d, nostril, 3.5)
}

fn mouth(p: Vec3, d: f32) -> f32 {
    let muzzle = ellipsoid(p, [0.0, -62.0, 62.0], [29.0, 25.0, 25.0]);
    let mut d = union(d, muzzle, 14.0);
    let philtrum = limb(p, [0.0, -47.0, 90.5], 1.4, [0.0, -57.0, 92.5], 2.4);
    d = difference(d, philtrum, 5.0);
    let upper = tube(p, [0.0, -61.5, 85.5], [11.0, -58.5, 86.5], [21.5, -65.0, 77.5], [4.2, 3.6, 1.2]);
    let lower = tube(p, [0.0, -71.0, 83.5], [11.0, -72.5, 84.0], [21.0, -65.6, 77.5], [5.4, 4.2, 1.2]);
    d = union(d, upper, 8.0);
    d = union(d, lower, 8.0);
    let slit = tube(p, [0.0, -66.2, 91.5], [11.0, -65.4, 92.5], [23.0, -65.0, 80.0], [0.6, 0.7, 0.4]);
    d = difference(d, slit, 3.5);
    let sulcus = tube(p, [0.0, -82.5, 90.0], [10.0, -82.5, 89.0], [20.0, -76.0, 80.0], [3.0, 2.0, 0.5]);
    difference(d, sulcus, 10.0)
}
