//! Every profile function in WGSL, evaluated on the device, against its twin in f64: of every model there is.

#![allow(clippy::print_stdout, reason = "measured figures, shown on request")]

mod gpu;

use gpu::{Gpu, model, stems, table_files, test_profile_files};
use subsurface_codegen::{Compiler, Pass};
use subsurface_profile::{Channel, Medium, Slab};

const TWINS: Pass = Pass { name: "twins", text: include_str!("twins.wgsl"), entry_points: &["twins"] };

#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Query {
    material: u32,
    channel: u32,
    surface_albedo: f32,
    radius_mm: f32,
    u: f32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
struct Answer {
    area_pdf: f32,
    radial_pdf: f32,
    radial_cdf: f32,
    transmittance: f32,
    slab_transmittance: f32,
    slab_reflectance: f32,
    sample_radius: f32,
}

/// Answers about materials of `stems`, which are sorted: materials are numbered by name.
fn ask(gpu: &Gpu, stems: &[&str], lengths_mm: f64, queries: &[Query]) -> Vec<Answer> {
    let files = stems.iter().map(|stem| {
        let length = if model(stem).length() == subsurface_profile::Length::DiffuseMeanFreePath {
            "diffuse_mean_free_path_mm"
        } else {
            "mean_free_path_mm"
        };
        let text = format!(
            "Material(profile: \"{stem}\", {length}: ({lengths_mm:?}, {lengths_mm:?}, {lengths_mm:?}), \
             surface_albedo: (0.5, 0.5, 0.5))"
        );
        (format!("{stem}.ron"), text)
    });
    let compilation = Compiler::from_memory(files.chain(table_files()).chain(test_profile_files()))
        .with_pass(TWINS)
        .compile()
        .unwrap_or_else(|r| panic!("{r}"));
    gpu.evaluate(&compilation, "twins", queries)
}

const SURFACE_ALBEDOS: [f32; 9] = [0.0, 1e-3, 0.05, 0.2, 0.5, 0.8, 0.95, 0.999, 1.0];
const QUANTILES: [f32; 11] = [0.0, 1e-5, 1e-3, 0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 0.999];
const LENGTHS_MM: [f64; 3] = [1e-2, 1.0, 1e3];

/// A profile of every kind, sorted.
fn sorted_stems() -> Vec<&'static str> {
    let mut stems = stems();
    // Beside sums and tables of many terms and knots ones of few: all of a set share what adds up and searches.
    stems.extend(["exponentials_alone", "mixture_of_mixtures", "short_table", "two_gaussians"]);
    stems.sort_unstable();
    stems
}

#[test]
fn wgsl_agrees_with_the_f64_models() {
    hold_against_f64(&sorted_stems(), &LENGTHS_MM);
}

#[test]
fn sums_of_many_terms_agree_with_the_f64_models() {
    // More terms than the compiler writes out, and few. Variances are absolute, so one length does. (The table is there
    // since the entry point is bound to one.)
    hold_against_f64(&["gaussian_skin", "many_gaussians", "tabulated"], &[1.0]);
}

/// Holds every function of the profiles `stems` against its twin in f64.
fn hold_against_f64(stems: &[&str], lengths_mm: &[f64]) {
    let gpu = Gpu::open();
    for &mean_free_path_mm in lengths_mm {
        let mut queries = Vec::new();
        let mut profiles = Vec::new();
        for (material, stem) in (0..).zip(stems) {
            let model = model(stem);
            for surface_albedo in SURFACE_ALBEDOS {
                for channel in Channel::ALL {
                    let medium =
                        Medium::new(f64::from(surface_albedo), mean_free_path_mm).expect("in the domain");
                    let profile = model.profile(medium, channel).expect("a published model");
                    for u in QUANTILES {
                        // Radii cover the profile evenly in energy, and reach a little beyond its last quantile.
                        let radius_mm = (1.01 * profile.sample_radius(f64::from(u))) as f32;
                        queries.push(Query {
                            material,
                            channel: channel.index() as u32,
                            surface_albedo,
                            radius_mm,
                            u,
                        });
                    }
                    profiles.push((stem, profile, Slab::new(medium)));
                }
            }
        }
        let answers = ask(&gpu, stems, mean_free_path_mm, &queries);
        let mut worst = [0.0_f64; 6];
        for ((query, answer), (stem, profile, slab)) in queries
            .iter()
            .zip(&answers)
            .zip(profiles.iter().flat_map(|p| std::iter::repeat_n(p, QUANTILES.len())))
        {
            let radius = f64::from(query.radius_mm);
            let context = format!(
                "{stem} A={} l={mean_free_path_mm} channel {} r={radius} u={}",
                query.surface_albedo, query.channel, query.u
            );
            // Close to a polynomial's r_max its density is a difference of nearly equal terms, and so is the exponent
            // of an exponential far out: errors are measured against the largest the function gets in the vicinity.
            let scale = profile.radial_pdf(0.98 * radius).max(profile.radial_pdf(radius));
            let mut check = |index: usize, got: f32, expected: f64, scale: f64, bound: f64, what: &str| {
                let error = (f64::from(got) - expected).abs() / scale;
                worst[index] = worst[index].max(error);
                assert!(
                    error <= bound,
                    "{what}: {got} is not {expected} (relative {error:.1e} > {bound:.0e}): {context}"
                );
            };
            // WGSL allows exp(x) an error of 3 + 2|x| ulp: 2e-6 relative at the |x| ≤ 14 of these radii, and pow() of
            // the polynomial's coefficients inherits as much. 1e-4 leaves room for drivers at that limit, amplified by
            // the 10^(30(α−1)) of eq. (11).
            const DENSITY: f64 = 1e-4;
            if radius > 0.0 {
                check(
                    0,
                    answer.area_pdf,
                    profile.area_pdf(radius),
                    scale / (std::f64::consts::TAU * radius),
                    DENSITY,
                    "area_pdf",
                );
                check(1, answer.radial_pdf, profile.radial_pdf(radius), scale, DENSITY, "radial_pdf");
            }
            // CDFs are compared in energy: 1e-5 of all reflected light, below what 8 bits of a picture show.
            check(2, answer.radial_cdf, profile.radial_cdf(radius), 1.0, 1e-5, "radial_cdf");
            check(3, answer.transmittance, profile.transmittance(radius), 1.0, 1e-5, "transmittance");
            check(5, answer.slab_transmittance, slab.transmittance(radius), 1.0, 1e-5, "slab_transmittance");
            check(5, answer.slab_reflectance, slab.reflectance(radius), 1.0, 1e-5, "slab_reflectance");
            // So is the sampler: the energy within the radius that it returns must be u.
            let inside = profile.radial_cdf(f64::from(answer.sample_radius));
            check(4, inside as f32, f64::from(query.u), 1.0, 1e-5, "cdf(sample_radius)");
        }
        let worst = worst.map(|error| format!("{error:.1e}")).join(", ");
        println!(
            "l = {mean_free_path_mm} mm: worst errors of area_pdf, radial_pdf, radial_cdf, transmittance, sample, slab: {worst}"
        );
    }
}

#[test]
fn the_sampler_on_the_device_passes_a_chi_squared_test() {
    const SAMPLES: u32 = 20_000;
    const BINS: usize = 20;
    let gpu = Gpu::open();
    let stems = sorted_stems();
    // A fixed sequence of independent uniform numbers: multiply-with-carry hashing of the index.
    let uniform = |index: u32| {
        let mut x = index.wrapping_mul(0x9E37_79B9) ^ 0x85EB_CA6B;
        for _ in 0..3 {
            x = (x ^ (x >> 16)).wrapping_mul(0x7FEB_352D);
            x = (x ^ (x >> 15)).wrapping_mul(0x846C_A68B);
        }
        (x >> 8) as f32 / 16_777_216.0
    };
    let query = |material, index| Query {
        material,
        channel: 0,
        surface_albedo: 0.8,
        radius_mm: 1.0,
        u: uniform(index),
    };
    let queries: Vec<_> = (0..stems.len() as u32)
        .flat_map(|material| (0..SAMPLES).map(move |index| query(material, index)))
        .collect();
    let answers = ask(&gpu, &stems, 1.0, &queries);
    for (stem, answers) in stems.iter().zip(answers.chunks(SAMPLES as usize)) {
        let model = model(stem);
        let medium = Medium::new(f64::from(0.8_f32), 1.0).expect("in the domain");
        let profile = model.profile(medium, Channel::Red).expect("a published model");
        let mut counts = [0_u32; BINS];
        for answer in answers {
            let bin = (profile.radial_cdf(f64::from(answer.sample_radius)) * BINS as f64) as usize;
            counts[bin.min(BINS - 1)] += 1;
        }
        let expected = f64::from(SAMPLES) / BINS as f64;
        let chi_squared: f64 = counts.iter().map(|&n| (f64::from(n) - expected).powi(2) / expected).sum();
        // 19 degrees of freedom: 43.8 is exceeded once in 1,000 sequences; this one is fixed.
        assert!(chi_squared < 43.8, "{stem}: chi² = {chi_squared:.1}, counts {counts:?}");
    }
}
