//! The vector walk against a plain one, which shares no line with it.

#![allow(clippy::unwrap_used, reason = "tests")]

#[path = "../benches/scalar/mod.rs"]
mod scalar;

use std::ops::ControlFlow;

use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;
use subsurface_reference::{Entry, Goal, HalfSpace, Run};

#[test]
fn rings_agree_in_every_kind_of_medium() {
    let edges = [0.0, 0.05, 0.2, 0.545, 1.03, 2.12, 4.02, 8.32, 18.8, 5250.0];
    let media = [
        (Entry::Searchlight, 0.0, 1.0),
        (Entry::Diffuse, 0.0, 1.4),
        (Entry::Searchlight, 0.7, 1.4),
        (Entry::Diffuse, -0.5, 1.0),
        (Entry::Diffuse, 0.01, 1.1),
    ];
    for (index, (entry, anisotropy, refractive_index)) in media.into_iter().enumerate() {
        let mut run = Run::new(HalfSpace::new(entry, anisotropy, refractive_index).unwrap(), 77);
        run.simulate(&Goal::photons(1 << 18).unwrap(), &mut |_| ControlFlow::Continue(()));
        const PHOTONS: u32 = 60_000;
        let mut random = Xoshiro256PlusPlus::seed_from_u64(index as u64);
        // 0.98¹⁰⁰⁰ = 2·10⁻⁹: no photon beyond that is missed.
        let alpha: f64 = 0.98;
        let mut sums = vec![[0.0; 2]; edges.len() - 1];
        for _ in 0..PHOTONS {
            let exit = scalar::walk(&mut random, entry, anisotropy, refractive_index, 1000, &mut 0);
            if let Some(exit) = exit
                && let Some(ring) = edges.iter().rposition(|&edge| edge <= exit.radius)
                && ring < sums.len()
            {
                let weight = alpha.powi(exit.scatterings as i32);
                sums[ring][0] += weight;
                sums[ring][1] += weight * weight;
            }
        }
        let table = run.radial_profile_on(alpha, &edges).unwrap();
        let mut chi_squared = 0.0;
        for ([sum, squares], bin) in sums.into_iter().zip(&table.bins) {
            let area = std::f64::consts::TAU * (bin.r_hi - bin.r_lo);
            let count = f64::from(PHOTONS);
            let mean = sum / count / area;
            let variance = (squares / count - (sum / count).powi(2)) / count / (area * area);
            chi_squared += (mean - bin.r_reflectance).powi(2) / (variance + bin.standard_error.powi(2));
        }
        // 9 degrees of freedom: more than 33 has the probability 10⁻⁴.
        assert!(chi_squared < 33.0, "{entry:?} {anisotropy} {refractive_index}: {chi_squared}");
    }
}
