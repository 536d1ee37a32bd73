//! The ear: a pressed sheet about 2.4 mm thick, as the cartilage is, so that a light behind it shines through.

use super::distance::{bell, intersection, limb, nearest_on_curve, step};
use glam::{Mat3, Vec2, Vec3};

/// Where the sheet's origin lies on the head, and how far it may reach from there (mm).
pub(super) const CENTRE: Vec3 = Vec3::new(72.0, -6.0, -14.0);
/// Radius of a ball about [`CENTRE`] that holds the whole ear (mm).
pub(super) const REACH: f32 = 46.0;
/// Half the thickness of the sheet (mm).
const HALF_THICKNESS: f32 = 1.2;

/// Distance to the ear. `p.x` is already folded to x ≥ 0.
pub(super) fn ear(p: Vec3) -> f32 {
    let q = frame().transpose() * (p - CENTRE);
    // u runs from the face to the back of the head, v up, w out of the sheet.
    let uv = Vec2::new(q.x, q.y);
    let edge = outline(uv);
    // Divided by the slope, so that the sheet keeps its thickness where the relief is steep.
    let h = height(uv);
    const E: f32 = 0.25;
    let slope = Vec2::new(height(uv + Vec2::X * E) - h, height(uv + Vec2::Y * E) - h) / E;
    let sheet = (q.z - h).abs() / (1.0 + slope.length_squared()).sqrt() - thickness(uv, edge);
    let plate = intersection(sheet, edge, 2.0);
    let tragus = limb(q, [-13.0, -5.0, -2.0], 3.0, [-11.0, -7.5, 2.5], 2.2);
    super::distance::union(plate, tragus, 6.0)
}

/// Columns: the sheet's u, v and w axes on the head. The ear leans back by 12° and stands off by 24°.
fn frame() -> Mat3 {
    let (stand_off, lean) = (24f32.to_radians(), 12f32.to_radians());
    let u = Vec3::new(stand_off.sin(), 0.0, -stand_off.cos());
    let w = Vec3::new(stand_off.cos(), 0.0, stand_off.sin());
    let v = Vec3::Y;
    let (sine, cosine) = lean.sin_cos();
    Mat3::from_cols(u * cosine - v * sine, v * cosine + u * sine, w)
}

/// Signed distance to the ear's outline in its plane: a disc above, a small one for the lobe.
fn outline(uv: Vec2) -> f32 {
    let top = Vec2::new(0.0, 12.0);
    let lobe = Vec2::new(-5.0, -21.0);
    let (axis, from) = (lobe - top, uv - top);
    let t = (from.dot(axis) / axis.length_squared()).clamp(0.0, 1.0);
    (from - axis * t).length() - (18.5 + (9.0 - 18.5) * t)
}

/// Height of the sheet's middle over its plane: bowl, helix, scapha, antihelix.
fn height(uv: Vec2) -> f32 {
    let outline = outline(uv);
    // The helix curls along the outline but fades towards the lobe.
    let above_lobe = step(-22.0, -8.0, uv.y);
    let helix = 3.4 * bell(outline + 2.2, 2.8) * above_lobe;
    let p = Vec3::new(uv.x, uv.y, 0.0);
    let (_, ridge) = nearest_on_curve(p, [-6.0, 17.0, 0.0], [14.0, 8.0, 0.0], [-4.0, -15.0, 0.0]);
    let antihelix = 3.2 * bell(ridge, 4.2);
    let concha = -5.0 * bell((uv - Vec2::new(-6.0, -3.0)).length(), 9.0);
    let bowl = 0.006 * uv.length_squared();
    helix + antihelix + concha + bowl
}

/// Half the sheet's thickness: a round rim and a fleshy lobe.
fn thickness(uv: Vec2, outline: f32) -> f32 {
    HALF_THICKNESS + 0.5 * bell(outline + 1.8, 2.0) + 1.0 * step(-12.0, -24.0, uv.y)
}

/// A point between helix and antihelix, and the sheet's normal there; both on the folded head.
#[cfg(test)]
pub(super) fn probe() -> (Vec3, Vec3) {
    let uv = Vec2::new(12.0, 10.0);
    (CENTRE + frame() * uv.extend(height(uv)), frame().z_axis)
}
