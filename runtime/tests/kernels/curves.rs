//! The curves that kernels read radii from, on the device, against the profiles in f64.

use crate::gpu::model;
use crate::setup::{Description, shared_gpu};
use subsurface_codegen::{Compilation, Estimator, Pass};
use subsurface_profile::{Channel, EdgeSpread, Medium, RadialProfile};

const CURVES: Pass = Pass { name: "curves", text: include_str!("curves.wgsl"), entry_points: &["curves"] };

#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Query {
    material: u32,
    channel: u32,
    surface_albedo: f32,
    u: f32,
    offset_mm: f32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
struct Answer {
    radius_mm: f32,
    slope_mm: f32,
    beyond_line: f32,
    line_reach_mm: f32,
}

fn compilation(description: &Description) -> Compilation {
    description.compiler().with_pass(CURVES).compile().unwrap_or_else(|report| panic!("{report}"))
}

/// The profile of a channel of a material of [`Description`], at another surface albedo.
fn profile(stem: &str, channel: Channel, surface_albedo: f64) -> Box<dyn RadialProfile> {
    let mean_free_path_mm = crate::setup::MEAN_FREE_PATH_MM[channel.index()];
    let medium = Medium::new(surface_albedo, mean_free_path_mm).expect("in the domain");
    model(stem).profile(medium, channel).expect("a published model")
}

/// Nodes of the curves, and surface albedos between them; the last node stands for all that is brighter than 0.999.
const SURFACE_ALBEDOS: [f32; 9] = [0.0, 0.05, 0.2, 0.5, 0.64, 0.8, 0.95, 0.98, 0.995];
const QUANTILES: [f32; 12] = [0.0, 1e-3, 0.01, 0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 0.97, 0.99, 0.997];

#[test]
fn radii_hold_the_light_that_they_are_asked_for() {
    let gpu = shared_gpu();
    let description = Description::all_profiles(Estimator::default());
    let mut queries = Vec::new();
    for material in 0..description.stems.len() as u32 {
        for channel in 0..3 {
            for surface_albedo in SURFACE_ALBEDOS {
                for u in QUANTILES {
                    queries.push(Query { material, channel, surface_albedo, u, offset_mm: 0.0 });
                }
            }
        }
    }
    let answers: Vec<Answer> = gpu.evaluate(&compilation(&description), "curves", &queries);
    let mut worst = vec![(0.0_f64, String::new()); description.stems.len()];
    let mut dark = worst.clone();
    for (query, answer) in queries.iter().zip(&answers) {
        let stem = description.stems[query.material as usize];
        let channel = Channel::ALL[query.channel as usize];
        let profile = profile(stem, channel, f64::from(query.surface_albedo));
        let (u, got) = (f64::from(query.u), f64::from(answer.radius_mm));
        let error = (profile.radial_cdf(got) - u).abs();
        let context = format!("{stem}, {channel:?}, A = {}, u = {u}: {got} mm", query.surface_albedo);
        assert!(answer.slope_mm.is_finite() && answer.slope_mm > 0.0, "{context}: slope {}", answer.slope_mm);
        let worst = if query.surface_albedo < 0.2 { &mut dark } else { &mut worst };
        let worst = &mut worst[query.material as usize];
        if error > worst.0 {
            *worst = (error, context);
        }
    }
    for (error, context) in worst.iter().chain(&dark) {
        println!("worst error {error:.1e} of all light: {context}");
    }
    // Between 64 steps the curve is straight, and between 16 surface albedos radii are mixed.
    for (error, context) in worst {
        assert!(error < 1e-2, "{error}: {context}");
    }
    // The first step of the surface albedo, to 0.13, is the widest, and some models change most there: coefficients that
    // are powers or polynomials of it.
    for (error, context) in dark {
        assert!(error < 0.2, "{error}: {context}");
    }
}

#[test]
fn the_slope_is_that_of_the_radius() {
    let gpu = shared_gpu();
    let description = Description::all_profiles(Estimator::default());
    // Even steps in u within one piece of the curve: 1 - (1 - t)² with t = (j + s)/64.
    let pieces = [0.5, 20.5, 45.5, 60.5];
    let u_at = |t: f32| 1.0 - (1.0 - t / 64.0).powi(2);
    let mut queries = Vec::new();
    for material in 0..description.stems.len() as u32 {
        for t in pieces {
            for part in [-0.2, 0.0, 0.2] {
                queries.push(Query {
                    material,
                    channel: 0,
                    surface_albedo: 0.8,
                    u: u_at(t + part),
                    offset_mm: 0.0,
                });
            }
        }
    }
    let answers: Vec<Answer> = gpu.evaluate(&compilation(&description), "curves", &queries);
    for (queries, answers) in queries.chunks_exact(3).zip(answers.chunks_exact(3)) {
        let difference = (answers[2].radius_mm - answers[0].radius_mm) / (queries[2].u - queries[0].u);
        let ratio = f64::from(answers[1].slope_mm) / f64::from(difference);
        // Radius is linear in t, and t's slope by u is taken in the middle; f32 leaves 1e-4 in the differences, more
        // near u = 1 where u has few bits left.
        let stem = description.stems[queries[0].material as usize];
        assert!((ratio - 1.0).abs() < 0.01, "{stem}, u = {}: ratio {ratio}", queries[1].u);
    }
}

#[test]
fn edges_spread_as_the_profiles_say() {
    let gpu = shared_gpu();
    let description = Description::all_profiles(Estimator::Separable { taps: 17, rotated: false });
    let mut queries = Vec::new();
    let mut expected = Vec::new();
    for (material, stem) in (0..).zip(&description.stems) {
        for surface_albedo in [0.2_f32, 0.5, 0.8, 0.95] {
            let profile = profile(stem, Channel::Green, f64::from(surface_albedo));
            let spread = EdgeSpread::new(&*profile);
            for quantile in [0.02, 0.1, 0.3, 0.5, 0.8, 0.95, 0.99] {
                let offset_mm = profile.sample_radius(quantile);
                let offset = offset_mm as f32;
                let u = quantile as f32;
                queries.push(Query { material, channel: 1, surface_albedo, u, offset_mm: offset });
                expected.push(1.0 - spread.at(f64::from(offset)));
            }
        }
    }
    let answers: Vec<Answer> = gpu.evaluate(&compilation(&description), "curves", &queries);
    let mut worst = (0.0_f64, String::new());
    let mut worst_reach = (0.0_f64, String::new());
    for ((query, answer), expected) in queries.iter().zip(&answers).zip(expected) {
        let stem = description.stems[query.material as usize];
        let profile = profile(stem, Channel::Green, f64::from(query.surface_albedo));
        let inside = 2.0 * EdgeSpread::new(&*profile).at(f64::from(answer.line_reach_mm)) - 1.0;
        let error = (inside - f64::from(query.u)).abs();
        if error > worst_reach.0 {
            worst_reach = (error, format!("{stem}, A = {}: {inside}, not {}", query.surface_albedo, query.u));
        }
        let error = (f64::from(answer.beyond_line) - expected).abs();
        let context = format!(
            "{stem}, A = {}: {} beyond {} mm is not {expected}",
            query.surface_albedo, answer.beyond_line, query.offset_mm
        );
        if error > worst.0 {
            worst = (error, context);
        }
    }
    let (error, context) = worst;
    println!("edge curves: worst error {error:.1e} of the step: {context}");
    // Straight between 64 offsets, and mixed between 16 surface albedos.
    assert!(error < 1e-2, "{error}: {context}");
    let (error, context) = worst_reach;
    println!("lines: worst error {error:.1e} of the light: {context}");
    // The light on both sides, read the other way round.
    assert!(error < 2e-2, "{error}: {context}");
}
