//! Distance-field vocabulary: primitives and smooth set operations, lengths in millimetres.
//!
//! Sources: [IQ] Inigo Quilez, "Distance functions" and "Smooth minimum". Smooth operators are his cubic ones:
//! the second derivative is continuous, so highlights run over a joint without a visible seam. They equal `min`
//! or `max` exactly where the operands differ by `k` or more.

use glam::{Vec2, Vec3};

/// Union, rounded over a band of width `k` mm.
pub(super) fn union(a: f32, b: f32, k: f32) -> f32 {
    let h = (k - (a - b).abs()).max(0.0) / k;
    a.min(b) - h * h * h * k / 6.0
}

/// Intersection, rounded over a band of width `k` mm.
pub(super) fn intersection(a: f32, b: f32, k: f32) -> f32 {
    -union(-a, -b, k)
}

/// `a` without `b`, rounded over a band of width `k` mm.
pub(super) fn difference(a: f32, b: f32, k: f32) -> f32 {
    intersection(a, -b, k)
}

/// An axis-aligned ellipsoid. [IQ] first-order distance: exact at the surface, an estimate away from it.
pub(super) fn ellipsoid(p: Vec3, centre: [f32; 3], radii: [f32; 3]) -> f32 {
    let (q, radii) = (p - Vec3::from(centre), Vec3::from(radii));
    let k0 = (q / radii).length();
    let k1 = (q / (radii * radii)).length();
    // At the centre the estimate is 0/0; the distance there is the shortest half axis.
    if k1 < 1e-9 { -radii.min_element() } else { k0 * (k0 - 1.0) / k1 }
}

/// A ball.
pub(super) fn sphere(p: Vec3, centre: [f32; 3], radius: f32) -> f32 {
    (p - Vec3::from(centre)).length() - radius
}

/// A segment with a radius that runs from `ra` to `rb`: distance to the segment less the radius at the foot.
///
/// A little longer than the true distance when the radii differ (by 1/cos of the flank's slope).
pub(super) fn limb(p: Vec3, a: [f32; 3], ra: f32, b: [f32; 3], rb: f32) -> f32 {
    let (a, b) = (Vec3::from(a), Vec3::from(b));
    let (pa, ba) = (p - a, b - a);
    let h = (pa.dot(ba) / ba.length_squared()).clamp(0.0, 1.0);
    (pa - ba * h).length() - (ra + (rb - ra) * h)
}

/// Parameter and distance of the point of the quadratic Bézier curve `a b c` nearest to `p`.
///
/// [IQ] `sdBezier`: the roots of the cubic that says that the chord is normal to the tangent.
pub(super) fn nearest_on_curve(p: Vec3, a: [f32; 3], b: [f32; 3], c: [f32; 3]) -> (f32, f32) {
    let (a, b, c) = (Vec3::from(a), Vec3::from(b), Vec3::from(c));
    let u = b - a;
    let v = a - b * 2.0 + c;
    let w = u * 2.0;
    let d = a - p;
    let at = |t: f32| {
        let t = t.clamp(0.0, 1.0);
        (t, (d + (w + v * t) * t).length())
    };
    let kk = 1.0 / v.length_squared().max(1e-6);
    let kx = kk * u.dot(v);
    let ky = kk * (2.0 * u.length_squared() + d.dot(v)) / 3.0;
    let kz = kk * d.dot(u);
    let q1 = ky - kx * kx;
    let q3 = q1 * q1 * q1;
    let q2 = kx * (2.0 * kx * kx - 3.0 * ky) + kz;
    let h = q2 * q2 + 4.0 * q3;
    if h >= 0.0 {
        let root = h.sqrt();
        let x = Vec2::new((root - q2) / 2.0, (-root - q2) / 2.0);
        at(x.x.cbrt() + x.y.cbrt() - kx)
    } else {
        let z = (-q1).sqrt();
        let angle = (q2 / (q1 * z * 2.0)).clamp(-1.0, 1.0).acos() / 3.0;
        let (m, n) = (angle.cos(), angle.sin() * 3.0f32.sqrt());
        let (first, second) = (at((m + m) * z - kx), at((-n - m) * z - kx));
        if first.1 <= second.1 { first } else { second }
    }
}

/// A tube about the quadratic Bézier curve `a b c`; its radius runs through `radii` at the start, middle and end.
pub(super) fn tube(p: Vec3, a: [f32; 3], b: [f32; 3], c: [f32; 3], radii: [f32; 3]) -> f32 {
    let (t, distance) = nearest_on_curve(p, a, b, c);
    let s = 1.0 - t;
    // Quadratic through the three radii at t = 0, 1/2, 1.
    let radius = radii[0] * s * (s - t) + radii[1] * 4.0 * s * t + radii[2] * t * (t - s);
    distance - radius
}

/// 0 below `low`, 1 above `high`, a cubic between.
pub(super) fn step(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// A bell of height 1 and half-width `width` (the standard deviation times √2).
pub(super) fn bell(x: f32, width: f32) -> f32 {
    (-(x / width) * (x / width)).exp()
}
