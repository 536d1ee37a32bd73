//! How fast the random walk is.
//!
//! - Scattering events per second on one core, beside a straightforward scalar walk. Goal: 10⁸.
//! - All single-scattering albedos 0.01 … 0.99 at the standard error that 10⁶ photons of MCML have at each: the time of
//!   99 runs of MCML's algorithm over the time of one run of ours. Goal: 50.

#![allow(clippy::print_stderr, reason = "a ratio is not something that Criterion reports")]

mod mcml;
mod scalar;

use std::hint::black_box;
use std::ops::ControlFlow;
use std::time::Instant;

use criterion::{Criterion, Throughput};
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;
use subsurface_reference::{Entry, Goal, HalfSpace, Run};

/// Simulates on this thread alone.
fn simulate(run: &mut Run, photons: u64) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread can be started");
    let goal = Goal::photons(photons).expect("some photons");
    pool.install(|| run.simulate(&goal, &mut |_| ControlFlow::Continue(())));
}

fn events_per_second(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("walk");
    for (name, entry, anisotropy, refractive_index) in [
        ("searchlight", Entry::Searchlight, 0.0, 1.0),
        ("diffuse", Entry::Diffuse, 0.0, 1.0),
        ("searchlight, refractive index 1.4", Entry::Searchlight, 0.0, 1.4),
        ("searchlight, g = 0.8", Entry::Searchlight, 0.8, 1.0),
    ] {
        let half_space = HalfSpace::new(entry, anisotropy, refractive_index).expect("a medium that can be");
        let photons = if anisotropy > 0.0 { 1 << 17 } else { 1 << 19 };
        let mut sample = Run::new(half_space, 1);
        simulate(&mut sample, photons);
        group.throughput(Throughput::Elements(sample.events()));
        group.bench_function(format!("{name}, events"), |bencher| {
            bencher.iter(|| {
                let mut run = Run::new(half_space, 1);
                simulate(&mut run, photons);
                black_box(run.events())
            });
        });
    }
    let scalar = || {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(1);
        let mut events = 0;
        let mut histogram = vec![0_u64; 10_001 * 64];
        for _ in 0..20_000 {
            if let Some(exit) = scalar::walk(&mut random, Entry::Searchlight, 0.0, 1.0, 10_000, &mut events) {
                let ring = (exit.radius * 8.0).min(63.0) as usize;
                histogram[exit.scatterings as usize * 64 + ring] += 1;
            }
        }
        black_box(histogram);
        events
    };
    group.throughput(Throughput::Elements(scalar()));
    group.bench_function("scalar searchlight, events", |bencher| bencher.iter(scalar));
    group.finish();
}

/// Time of 99 MCML runs over the time of ours at the same standard errors of the surface albedo.
fn all_albedos() {
    const MCML_PHOTONS: f64 = 1e6;
    let photons = 1 << 22;
    let mut run = Run::new(HalfSpace::matched_isotropic(Entry::Searchlight), 1);
    let start = Instant::now();
    simulate(&mut run, photons);
    let seconds_per_photon = start.elapsed().as_secs_f64() / run.photons() as f64;
    let (mut mcml_seconds, mut needed, mut worst): (f64, f64, f64) = (0.0, 0.0, 0.0);
    for percent in 1..=99 {
        let single_scattering_albedo = f64::from(percent) / 100.0;
        // A fiftieth of the photons is timed: the time per photon does not depend on their number.
        let mcml = mcml::reflectance(single_scattering_albedo, 20_000, u64::from(percent as u32));
        let ours = run.surface_albedo(single_scattering_albedo).expect("the run has photons");
        let z = (mcml.mean - ours.mean)
            / (mcml.variance_per_photon / mcml.photons as f64 + ours.standard_error.powi(2)).sqrt();
        worst = worst.max(z.abs());
        mcml_seconds += mcml.seconds_per_photon * MCML_PHOTONS;
        let variance = mcml.variance_per_photon / MCML_PHOTONS;
        needed = needed.max(run.photons() as f64 * ours.standard_error.powi(2) / variance);
        if [50, 90, 99].contains(&percent) {
            eprintln!(
                "MCML at α = {single_scattering_albedo}: {:.0} photons/s",
                1.0 / mcml.seconds_per_photon
            );
        }
    }
    let seconds = needed * seconds_per_photon;
    eprintln!("99 albedos, 10⁶ MCML photons each: {mcml_seconds:.1} s (timed on 2·10⁴ photons each, scaled)");
    eprintln!("ours, at those standard errors or better: {needed:.3e} photons, {seconds:.3} s");
    eprintln!("ratio {:.0} (goal 50); largest difference {worst:.1} standard errors", mcml_seconds / seconds);
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args().sample_size(10);
    events_per_second(&mut criterion);
    criterion.final_summary();
    all_albedos();
}
