//! The field in a slab as a sum over mirror images.

use super::super::dipole::SOURCE_DEPTH;
use super::{Side, Slab};
use std::f64::consts::PI;

/// Pairs above and below the slab that are summed one by one; the rest are integrated.
///
/// The sum over images i of a function that falls off as 1/i³, from N on, is its integral from N - ½ on but for
/// 1/(8N²) of itself, and all of it is 1/(2N²) of the whole: 1e-11.
const PAIRS: u32 = 256;

/// Flux through a surface at `radius` of a source of power 1: Donner and Jensen 2005.
pub(super) fn flux(slab: &Slab, side: Side, radius: f64) -> f64 {
    let period = 2.0 * slab.extrapolated_thickness();
    let s = slab.transport_extinction;
    // -∂/∂z of the potential e^{-s d}/d of an image at height `z` above the point of exit.
    let gradient = |z: f64| {
        let d = libm::hypot(radius, z);
        (z / d) * (s + 1.0 / d) * libm::exp(-s * d) / d
    };
    let potential = |z: f64| {
        let d = libm::hypot(radius, z);
        libm::exp(-s * d) / d
    };
    // Depths of source and image of pair 0, seen from the surface of exit towards the other one.
    let (source, image) = match side {
        Side::Entry => (SOURCE_DEPTH, -SOURCE_DEPTH - 2.0 * slab.extrapolation),
        Side::Far => {
            (slab.thickness - SOURCE_DEPTH, slab.thickness + SOURCE_DEPTH + 2.0 * slab.extrapolation)
        }
    };
    let mut sum = gradient(source) - gradient(image);
    for i in 1..=PAIRS {
        let shift = f64::from(i) * period;
        let pairs = gradient(source + shift) - gradient(image + shift) + gradient(source - shift)
            - gradient(image - shift);
        sum += pairs;
        if pairs == 0.0 {
            break;
        }
    }
    // ∫ gradient(z + i period) di from PAIRS + ½ on, and below likewise with the other sign.
    let edge = (f64::from(PAIRS) + 0.5) * period;
    let rest = (potential(source + edge) - potential(image + edge) - potential(source - edge)
        + potential(image - edge))
        / period;
    (sum + rest) / (4.0 * PI)
}
