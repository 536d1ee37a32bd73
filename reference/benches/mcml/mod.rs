//! MCML's algorithm for a matched half-space, from the publication.
//!
//! Wang, Jacques, Zheng 1995, "MCML - Monte Carlo modeling of light transport in multi-layered tissues", Computer
//! Methods and Programs in Biomedicine 47: hop, drop, spin, roulette, with its grids of absorption A(r, z) and of
//! diffuse reflectance R(r, α). Random numbers are xoshiro256++ instead of the original's slower `ran3`.

use std::time::Instant;

use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

use crate::scalar::{scatter, uniform};

/// Photons below this weight play roulette (MCML's `WEIGHT`).
const WEIGHT_THRESHOLD: f64 = 1e-4;
/// Chance of surviving it (MCML's `CHANCE`).
const CHANCE: f64 = 0.1;
/// Lines of the grids, and their spacing in mean free paths.
const LINES: usize = 100;
const SPACING: f64 = 0.1;
const ANGLES: usize = 30;

pub(crate) struct Reflectance {
    pub(crate) photons: u32,
    pub(crate) mean: f64,
    pub(crate) variance_per_photon: f64,
    pub(crate) seconds_per_photon: f64,
}

pub(crate) fn reflectance(single_scattering_albedo: f64, photons: u32, seed: u64) -> Reflectance {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut absorbed = vec![0.0; LINES * LINES];
    let mut reflected = vec![0.0; LINES * ANGLES];
    let (mut sum, mut squares) = (0.0, 0.0);
    let start = Instant::now();
    for _ in 0..photons {
        let left = launch(&mut random, single_scattering_albedo, &mut absorbed, &mut reflected);
        sum += left;
        squares += left * left;
    }
    let seconds = start.elapsed().as_secs_f64();
    std::hint::black_box((absorbed, reflected));
    let count = f64::from(photons);
    let mean = sum / count;
    Reflectance {
        photons,
        mean,
        variance_per_photon: squares / count - mean * mean,
        seconds_per_photon: seconds / count,
    }
}

/// One photon packet; the weight that left through the surface.
fn launch(
    random: &mut Xoshiro256PlusPlus,
    single_scattering_albedo: f64,
    absorbed: &mut [f64],
    reflected: &mut [f64],
) -> f64 {
    let line = |x: f64| ((x / SPACING) as usize).min(LINES - 1);
    let (mut position, mut direction, mut weight) = ([0.0, 0.0, 0.0_f64], [0.0, 0.0, 1.0_f64], 1.0);
    loop {
        let mut path = -uniform(random).ln();
        let leaves = direction[2] < 0.0 && -position[2] / direction[2] < path;
        if leaves {
            path = -position[2] / direction[2];
        }
        for axis in 0..3 {
            position[axis] += path * direction[axis];
        }
        let ring = line((position[0] * position[0] + position[1] * position[1]).sqrt());
        if leaves {
            let angle = (-direction[2]).acos() * (ANGLES as f64 / std::f64::consts::FRAC_PI_2);
            reflected[ring * ANGLES + (angle as usize).min(ANGLES - 1)] += weight;
            return weight;
        }
        let drop = weight * (1.0 - single_scattering_albedo);
        weight -= drop;
        absorbed[ring * LINES + line(position[2])] += drop;
        direction = scatter(random, direction, 0.0);
        if weight < WEIGHT_THRESHOLD {
            if weight == 0.0 || uniform(random) > CHANCE {
                return 0.0;
            }
            weight /= CHANCE;
        }
    }
}
