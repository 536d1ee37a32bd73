//! Random walks written down as simply as they can be: one photon at a time, in `f64`, with the standard library's
//! functions. What the crate's own walk is compared with, for its results (tests) and its speed (benches).

use std::f64::consts::TAU;

use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::Rng;
use subsurface_reference::Entry;

/// Uniform in (0, 1].
pub(crate) fn uniform(random: &mut Xoshiro256PlusPlus) -> f64 {
    ((random.next_u64() >> 11) + 1) as f64 * (1.0 / (1_u64 << 53) as f64)
}

/// Fresnel reflectance inside at `cosine`, by the angles: MCML's `RFresnel`.
fn reflectance(cosine: f64, refractive_index: f64) -> f64 {
    if refractive_index == 1.0 {
        return 0.0;
    }
    let inside = cosine.acos();
    let sine = refractive_index * inside.sin();
    if sine >= 1.0 {
        return 1.0;
    }
    let outside = sine.asin();
    if inside < 1e-9 {
        return ((refractive_index - 1.0) / (refractive_index + 1.0)).powi(2);
    }
    let (sum, difference) = (inside + outside, outside - inside);
    0.5 * ((difference.sin() / sum.sin()).powi(2) + (difference.tan() / sum.tan()).powi(2))
}

/// Where a photon left.
pub(crate) struct Exit {
    pub(crate) scatterings: u32,
    pub(crate) radius: f64,
}

/// One photon's way until it leaves, or [`None`] after `limit` scatterings. `events` counts scatterings.
pub(crate) fn walk(
    random: &mut Xoshiro256PlusPlus,
    entry: Entry,
    anisotropy: f64,
    refractive_index: f64,
    limit: u32,
    events: &mut u64,
) -> Option<Exit> {
    let (mut position, mut direction) = ([0.0, 0.0, 0.0_f64], [0.0, 0.0, 1.0_f64]);
    if entry == Entry::Diffuse {
        loop {
            let outside = uniform(random).sqrt();
            let inside = (1.0 - (1.0 - outside * outside) / refractive_index.powi(2)).sqrt();
            if uniform(random) > reflectance(inside, refractive_index) {
                direction = [(1.0 - inside * inside).sqrt(), 0.0, inside];
                break;
            }
        }
    }
    for scatterings in 0..=limit {
        let path = -uniform(random).ln();
        for axis in 0..3 {
            position[axis] += path * direction[axis];
        }
        if position[2] < 0.0 {
            if uniform(random) > reflectance(-direction[2], refractive_index) {
                let beyond = position[2] / direction[2];
                let x = position[0] - beyond * direction[0];
                let y = position[1] - beyond * direction[1];
                *events += u64::from(scatterings);
                return Some(Exit { scatterings, radius: x.hypot(y) });
            }
            position[2] = -position[2];
            direction[2] = -direction[2];
        }
        direction = scatter(random, direction, anisotropy);
    }
    *events += u64::from(limit);
    None
}

/// A new direction, as in MCML (Wang, Jacques, Zheng 1995, "MCML - Monte Carlo modeling of light transport in
/// multi-layered tissues").
pub(crate) fn scatter(random: &mut Xoshiro256PlusPlus, [x, y, z]: [f64; 3], g: f64) -> [f64; 3] {
    let xi = uniform(random);
    let cosine = if g == 0.0 {
        2.0 * xi - 1.0
    } else {
        let fraction = (1.0 - g * g) / (1.0 - g + 2.0 * g * xi);
        ((1.0 + g * g - fraction * fraction) / (2.0 * g)).clamp(-1.0, 1.0)
    };
    let sine = (1.0 - cosine * cosine).sqrt();
    let azimuth = TAU * uniform(random);
    let (u, v) = (sine * azimuth.cos(), sine * azimuth.sin());
    if z.abs() > 1.0 - 1e-12 {
        return [u, v, cosine * z.signum()];
    }
    let horizontal = (1.0 - z * z).sqrt();
    [
        (x * z * u - y * v) / horizontal + x * cosine,
        (y * z * u + x * v) / horizontal + y * cosine,
        -u * horizontal + z * cosine,
    ]
}
