//! Hair, swept back into a knot, as a sculptor cuts it: a cap with grooves, no strands.

use super::distance::{bell, ellipsoid, intersection, step, union};
use glam::Vec3;

/// How far grooves and locks may stand out of the smooth cap (mm).
const RELIEF: f32 = 2.6;

/// Adds the hair to the head's distance `d`. `p.x` is already folded to x ≥ 0.
pub(super) fn hair(p: Vec3, d: f32) -> f32 {
    let cap = intersection(ellipsoid(p, [0.0, 39.0, -19.0], [77.5, 85.0, 94.0]), hairline(p), 9.0);
    let knot = ellipsoid(p, [0.0, 20.0, -108.0], [33.0, 31.0, 27.0]);
    let mut hair = union(cap, knot, 6.0);
    if hair < d + 4.0 + RELIEF {
        let to_knot = step(-4.0, 4.0, cap - knot); // 0 on the cap, 1 on the knot
        hair -= locks(p) * (1.0 - to_knot) + coil(p) * to_knot;
    }
    union(d, hair, 4.0)
}

/// Negative where hair grows: behind a line from the forehead over the temple and behind the ear to the nape.
fn hairline(p: Vec3) -> f32 {
    let front = -54.0 + 92.0 * step(-48.0, 52.0, p.y) + 32.0 * step(40.0, 108.0, p.y);
    // 0.75: the line is at its steepest about 45°.
    (p.z - front) * 0.75
}

/// Relief of the combed locks (mm): waves across the meridians that run from the forehead to the knot.
fn locks(p: Vec3) -> f32 {
    let (x, y) = (p.x, p.y - 26.0);
    let radius = x.hypot(y);
    let sway = 0.05 * (p.z / 17.0).sin() + 0.03 * (p.z / 9.0 + 2.0).sin();
    let angle = x.atan2(y) + sway;
    // Locks of about 9 mm at the widest part, each with finer ones; meridians meet at the knot and fade there.
    let fade = step(8.0, 45.0, radius);
    (1.1 * (26.0 * angle).cos() + 0.55 * (61.0 * angle + 1.0).cos() + 0.3 * (17.0 * angle + 0.4).sin()) * fade
}

/// Relief of the knot (mm): a spiral.
fn coil(p: Vec3) -> f32 {
    let (x, y) = (p.x, p.y - 20.0);
    let radius = x.hypot(y);
    1.3 * (radius / 1.3 - x.atan2(y)).cos() * (1.0 - bell(radius, 5.0))
}
