//! How a step, a line and a disc of light spread, against the profile in f64.

use crate::buffers::{Buffers, DISTANCE_MM};
use crate::exact::PixelShares;
use crate::setup::{DEFAULT_STEM, Description, Diffuser, KERNELS, profiles, taps_for_one, widest_radius_mm};
use subsurface_codegen::Estimator;
use subsurface_profile::{EdgeSpread, RadialProfile};
use subsurface_runtime::{Path, SubsurfaceView};

/// Errors of a picture whose rows are alike but for noise.
#[derive(Clone, Copy, Debug, Default)]
struct Errors {
    /// Worst error of a column's mean.
    bias: f64,
    /// Worst standard deviation of a column's pixels about their mean.
    noise: f64,
    /// Worst error of a pixel.
    worst: f64,
    /// Root mean square error of all pixels.
    rms: f64,
}

impl Errors {
    /// Errors over `columns` and `rows` of one channel, against `expected` by column.
    fn of(
        picture: &[[f32; 4]],
        width: u32,
        channel: usize,
        columns: std::ops::Range<u32>,
        rows: std::ops::Range<u32>,
        expected: impl Fn(u32) -> f64,
    ) -> Self {
        let mut errors = Self::default();
        let (mut squares, mut pixels) = (0.0, 0.0);
        for x in columns {
            let expected = expected(x);
            let column: Vec<f64> =
                rows.clone().map(|y| f64::from(picture[(y * width + x) as usize][channel])).collect();
            let mean = column.iter().sum::<f64>() / column.len() as f64;
            let variance = column.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / column.len() as f64;
            errors.bias = errors.bias.max((mean - expected).abs());
            errors.noise = errors.noise.max(variance.sqrt());
            for value in &column {
                errors.worst = errors.worst.max((value - expected).abs());
                squares += (value - expected).powi(2);
            }
            pixels += column.len() as f64;
        }
        errors.rms = (squares / pixels).sqrt();
        errors
    }

    /// The worst of both, each for itself.
    fn worse(self, other: Self) -> Self {
        Self {
            bias: self.bias.max(other.bias),
            noise: self.noise.max(other.noise),
            worst: self.worst.max(other.worst),
            rms: self.rms.max(other.rms),
        }
    }
}

impl std::fmt::Display for Errors {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { bias, noise, worst, rms } = self;
        write!(f, "bias {bias:.4}, noise {noise:.4}, worst pixel {worst:.4}, RMS {rms:.4}")
    }
}

/// Errors of a step edge on a plane of `height` pixels.
fn step_errors(diffuser: &mut Diffuser, material: u32, stem: &str, height: u32) -> Errors {
    let size = [height * 3 / 2, height];
    let edge = size[0] / 2;
    // 98 % of the widest channel's light arrives from inside the frame; what is rejected at its border is renormalized.
    let millimetres_per_pixel = widest_radius_mm(stem, 0.98) / (0.47 * f64::from(size[0]));
    let buffers = Buffers::plane(size, material).lit(|x, _| [if x >= edge { 1.0 } else { 0.0 }; 3]);
    let view = SubsurfaceView::orthographic_distances(millimetres_per_pixel as f32);
    let picture = diffuser.diffuse(&view, &buffers);
    let mut errors = Errors::default();
    for (channel, profile) in profiles(stem).iter().enumerate() {
        let spread = EdgeSpread::new(&**profile);
        let expected = |x: u32| spread.at((f64::from(x) + 0.5 - f64::from(edge)) * millimetres_per_pixel);
        let (columns, rows) = (edge - size[0] / 4..edge + size[0] / 4, height / 4..height * 3 / 4);
        errors = errors.worse(Errors::of(&picture, size[0], channel, columns, rows, expected));
    }
    errors
}

#[test]
fn a_step_edge_spreads_as_the_profile_says() {
    let mut found = Vec::new();
    for kernel in KERNELS {
        let description = Description::all_profiles(kernel);
        let mut all = Errors::default();
        for (material, stem) in (0..).zip(&description.stems) {
            // A sum over all pixels takes long on software drivers.
            let height = if kernel == Estimator::Dense { 20 } else { 64 };
            let errors = step_errors(&mut Diffuser::new(&description, Path::Compute), material, stem, height);
            println!("{kernel}, {stem}, {:.2} taps for one: {errors}", taps_for_one(stem));
            all = all.worse(errors);
            found.push((kernel, *stem, errors));
        }
        println!("{kernel}: {all}");
    }
    for (kernel, stem, errors) in found {
        let (bias, noise) = step_bounds(kernel, stem);
        assert!(errors.bias < bias, "{kernel}, {stem}: bias of {:.4}, at most {bias:.4}", errors.bias);
        assert!(errors.noise < noise, "{kernel}, {stem}: noise of {:.4}, at most {noise:.4}", errors.noise);
    }
}

/// Bounds of bias and noise, as fractions of the step.
fn step_bounds(kernel: Estimator, stem: &str) -> (f64, f64) {
    match kernel {
        // Radii stand for whole strata of the CDF (1/n of the light each), and taps snap to pixels: half a pixel of the
        // slope at the edge.
        Estimator::ImportanceSampled { taps } => {
            let counting = f64::from(taps) / taps_for_one(stem);
            // Even strata leave little noise to channels that share their radii. A channel much narrower than the widest
            // has the noise of independent taps, each of which finds the light or does not: ½/√n at the edge.
            (0.06, if counting < 6.0 { 0.5 / counting.sqrt() } else { 0.1 })
        }
        // Without noise; a strip is a sixteenth of the light and stands in two lines, each of which an edge crosses at once.
        Estimator::Separable { .. } => (0.03, 1e-3),
        // Four taps for the far field of the widest channel; narrow channels find most of their light in the ring.
        Estimator::Interleaved { .. } => (0.07, 0.04),
        // What the frame's border renormalizes.
        Estimator::Dense => (0.02, 5e-3),
    }
}

/// Mean radius of the widest channel, mm.
fn mean_radius_mm(stem: &str) -> f64 {
    // The mean of the quantile function, at the middles of even strata.
    const STRATA: u32 = 2000;
    let mean = |profile: &dyn RadialProfile| {
        (0..STRATA).map(|i| profile.sample_radius((f64::from(i) + 0.5) / f64::from(STRATA))).sum::<f64>()
            / f64::from(STRATA)
    };
    profiles(stem).iter().map(|profile| mean(&**profile)).fold(0.0, f64::max)
}

/// Errors of a step edge against the sum in f64 over the same frame, at a mean radius of `pixels`.
fn footprint_errors(diffuser: &mut Diffuser, taps: u32, pixels: f64) -> Errors {
    const SIZE: [u32; 2] = [160, 64];
    const EDGE: u32 = SIZE[0] / 2;
    let millimetres_per_pixel = mean_radius_mm(DEFAULT_STEM) / pixels;
    let step = |x: u32| if x >= EDGE { 1.0 } else { 0.0 };
    let buffers = Buffers::plane(SIZE, 0).lit(|x, _| [step(x) as f32; 3]);
    let view = SubsurfaceView::orthographic_distances(millimetres_per_pixel as f32).with_taps(taps);
    let picture = diffuser.diffuse(&view, &buffers);
    let mut errors = Errors::default();
    for (channel, profile) in profiles(DEFAULT_STEM).iter().enumerate() {
        let shares = PixelShares::new(&**profile, millimetres_per_pixel, SIZE[0]);
        // Rows near the middle see the frame's border alike.
        let expected = |x: u32| shares.diffused(SIZE, [x, SIZE[1] / 2], |x, _| step(x));
        errors = errors.worse(Errors::of(&picture, SIZE[0], channel, EDGE - 32..EDGE + 32, 26..38, expected));
    }
    errors
}

#[test]
fn a_step_edge_at_every_footprint() {
    let mut found = Vec::new();
    let cases: [(Estimator, &[u32]); 3] = [
        (Estimator::ImportanceSampled { taps: 17 }, &[17, 33]),
        (Estimator::Separable { taps: 17, rotated: false }, &[17]),
        (Estimator::Interleaved { taps: 4 }, &[4, 8, 9]),
    ];
    for (kernel, counts) in cases {
        let mut diffuser = Diffuser::new(&Description::pair(kernel), Path::Compute);
        for &taps in counts {
            for pixels in [1.0, 2.0, 4.0, 8.0, 16.0] {
                let errors = footprint_errors(&mut diffuser, taps, pixels);
                let name = kernel.name();
                println!("{name}, {taps} taps, mean radius {pixels} px: {errors}");
                found.push((kernel, taps, pixels, errors));
            }
        }
    }
    for (kernel, taps, pixels, errors) in found {
        let (bias, rms) = footprint_bounds(kernel, taps);
        assert!(errors.bias < bias, "{kernel}: {taps} taps, {pixels} px: bias {:.4}", errors.bias);
        assert!(errors.rms < rms, "{kernel}: {taps} taps, {pixels} px: RMS {:.4}", errors.rms);
    }
}

/// Bounds of bias and of the root mean square error, as fractions of the step: those of a column's mean and of pixels.
fn footprint_bounds(kernel: Estimator, taps: u32) -> (f64, f64) {
    match (kernel, taps) {
        (Estimator::ImportanceSampled { .. }, _) => (0.06, 0.04),
        (Estimator::Separable { .. }, _) => (0.04, 0.025),
        (_, 4) => (0.045, 0.02),
        // Noise-free: what is left is the lattice itself, 144 taps that an edge crosses one by one.
        _ => (0.035, 0.01),
    }
}

#[test]
fn a_disc_and_a_line_spread_as_the_sum_over_all_pixels() {
    const SIDE: u32 = 72;
    const MIDDLE: u32 = SIDE / 2;
    let disc = |x: u32, y: u32| {
        let (dx, dy) = (f64::from(x) - f64::from(MIDDLE), f64::from(y) - f64::from(MIDDLE));
        if dx.hypot(dy) < 5.5 { 1.0 } else { 0.0 }
    };
    let line = |x: u32, _: u32| if x.abs_diff(MIDDLE) <= 1 { 1.0 } else { 0.0 };
    type Shape<'a> = &'a dyn Fn(u32, u32) -> f64;
    let shapes: [(&str, Shape<'_>); 2] = [("disc", &disc), ("line", &line)];
    let millimetres_per_pixel = mean_radius_mm(DEFAULT_STEM) / 6.0;
    let shares =
        profiles(DEFAULT_STEM).map(|profile| PixelShares::new(&*profile, millimetres_per_pixel, SIDE));
    for kernel in KERNELS {
        let mut diffuser = Diffuser::new(&Description::pair(kernel), Path::Compute);
        for (name, shape) in shapes {
            let buffers =
                Buffers::plane([SIDE; 2], 0).lit(|x, y| [shape(x, y) as f32; 3]).distant(|_, _| DISTANCE_MM);
            let view = SubsurfaceView::orthographic_distances(millimetres_per_pixel as f32);
            let picture = diffuser.diffuse(&view, &buffers);
            let (mut worst, mut squares, mut count) = (0.0_f64, 0.0, 0.0);
            // Every second pixel of every fifth row through the middle of the frame.
            for y in (MIDDLE - 20..=MIDDLE + 20).step_by(5) {
                for x in (MIDDLE - 20..=MIDDLE + 20).step_by(2) {
                    for (channel, shares) in shares.iter().enumerate() {
                        let expected = shares.diffused([SIDE; 2], [x, y], shape);
                        let got = f64::from(picture[buffers.index(x, y)][channel]);
                        worst = worst.max((got - expected).abs());
                        squares += (got - expected).powi(2);
                        count += 1.0;
                    }
                }
            }
            let rms = f64::sqrt(squares / count);
            println!("{kernel}, {name}: worst pixel {worst:.4}, RMS {rms:.4}");
            // As fractions of what is lit. Dense is the same sum, but for its end at a quantile.
            let (bound, rms_bound) = match kernel {
                Estimator::Dense => (3e-3, 2e-3),
                Estimator::ImportanceSampled { .. }
                | Estimator::Separable { .. }
                | Estimator::Interleaved { .. } => (0.25, 0.06),
            };
            assert!(worst < bound && rms < rms_bound, "{kernel}, {name}: worst {worst:.4}, RMS {rms:.4}");
        }
    }
}

#[test]
fn more_taps_converge() {
    for (kernel, counts) in [
        (Estimator::ImportanceSampled { taps: 17 }, [8, 32, 256]),
        (Estimator::Interleaved { taps: 4 }, [2, 8, 64]),
    ] {
        let mut diffuser = Diffuser::new(&Description::pair(kernel), Path::Compute);
        let rms = counts.map(|taps| footprint_errors(&mut diffuser, taps, 8.0).rms);
        println!("{}: {counts:?} taps have RMS errors of {rms:.4?}", kernel.name());
        assert!(rms[1] < rms[0] && rms[2] < rms[1], "{}: {rms:?}", kernel.name());
    }
}
