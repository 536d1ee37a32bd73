//! Light is neither made nor lost.

use crate::buffers::{Buffers, DISTANCE_MM, noise};
use crate::setup::{Description, Diffuser, KERNELS};
use subsurface_codegen::Estimator;
use subsurface_runtime::{Path, SubsurfaceView};

const SIZE: [u32; 2] = [40, 36];

/// Largest relative error of a constant irradiance.
pub(crate) fn tolerance(kernel: Estimator) -> f32 {
    match kernel {
        // Blocks and packed pixels keep light as numbers of nine bits: half a step is 1e-3 to 2e-3 of the brightest.
        Estimator::Interleaved { .. } => 2e-3,
        // Rounding of the two sums leaves 1e-6, mantissas of 16 bits between the two passes 1e-5; 1e-3 is the goal.
        Estimator::ImportanceSampled { .. } | Estimator::Separable { .. } | Estimator::Dense => 1e-3,
    }
}

/// Largest relative error of `picture` where all light was alike.
pub(crate) fn deviation(picture: &[[f32; 4]], irradiance: [f32; 3]) -> f32 {
    let channels =
        picture.iter().flat_map(|pixel| (0..3).map(|channel| pixel[channel] / irradiance[channel]));
    // A pixel that is no number must not vanish in the maximum.
    channels
        .map(|ratio| if ratio.is_finite() { (ratio - 1.0).abs() } else { f32::INFINITY })
        .fold(0.0, f32::max)
}

#[test]
fn constant_irradiance_stays_constant() {
    let irradiance = [0.9, 1.7, 1.2];
    let mut found = Vec::new();
    for kernel in KERNELS {
        let description = Description::all_profiles(kernel);
        let mut diffuser = Diffuser::new(&description, Path::Compute);
        let mut worst = 0.0_f32;
        // A sum over all pixels of all pixels.
        let size = if kernel == Estimator::Dense { [18, 15] } else { SIZE };
        for (material, stem) in (0..).zip(description.stems.iter().copied()) {
            for millimetres_per_pixel in [0.02, 0.3, 2.0, 20.0] {
                let view = SubsurfaceView::orthographic_distances(millimetres_per_pixel);
                // A tilted plane: the distances differ, the irradiance does not; nor does it where surface albedo and
                // mean free path change from pixel to pixel.
                let buffers = Buffers::plane(size, material)
                    .lit(|_, _| irradiance)
                    .distant(|x, y| DISTANCE_MM + millimetres_per_pixel * (0.4 * x as f32 + 0.2 * y as f32))
                    .coloured(|x, y| [0, 1, 2].map(|salt| noise(x, y, salt)))
                    .scaled(|x, y| 0.3 + 2.0 * noise(x, y, 3));
                let error = deviation(&diffuser.diffuse(&view, &buffers), irradiance);
                worst = worst.max(error);
                found.push((kernel, stem, millimetres_per_pixel, error));
            }
        }
        println!("{kernel}: a constant irradiance changes by {worst:.1e} at most");
    }
    for (kernel, stem, millimetres_per_pixel, error) in found {
        assert!(
            error < tolerance(kernel),
            "{kernel}, {stem} at {millimetres_per_pixel} mm per pixel: {error}"
        );
    }
}

#[test]
fn irradiance_has_any_unit() {
    for kernel in KERNELS {
        for path in [Path::Compute, Path::Fragment] {
            let mut diffuser = Diffuser::new(&Description::on_path(kernel, path), path);
            // White just below 1 has every mantissa at its largest.
            let white = [0.9985; 3];
            for irradiance in [1e-9, 1e-7, 1e5, 1e9]
                .map(|unit| [0.9, 1.7, 1.2].map(|value| value * unit))
                .into_iter()
                .chain([white])
            {
                let buffers = Buffers::plane(SIZE, 0).lit(|_, _| irradiance);
                let picture = diffuser.diffuse(&SubsurfaceView::orthographic_distances(0.3), &buffers);
                let error = deviation(&picture, irradiance);
                assert!(error < tolerance(kernel), "{kernel}, {path:?}, {irradiance:?}: {error}");
            }
        }
    }
}

#[test]
fn colours_do_not_bleed_into_each_other() {
    // One channel far below another: what is kept in few bits must keep it.
    let irradiance = [2.0, 0.5, 0.125];
    for kernel in KERNELS {
        let mut diffuser = Diffuser::new(&Description::pair(kernel), Path::Compute);
        let buffers = Buffers::plane(SIZE, 0).lit(|_, _| irradiance);
        let view = SubsurfaceView::orthographic_distances(0.3);
        let picture = diffuser.diffuse(&view, &buffers);
        let error = deviation(&picture, irradiance);
        println!("{kernel}: a colour of 16 : 4 : 1 changes by {error:.1e} at most");
        // Sixteen times the tolerance of a channel that has the whole mantissa.
        assert!(error < 16.0 * tolerance(kernel), "{kernel}: {error}");
    }
}

#[test]
fn a_lit_patch_keeps_its_sum() {
    const SIDE: u32 = 96;
    for kernel in KERNELS {
        let mut diffuser = Diffuser::new(&Description::pair(kernel), Path::Compute);
        // The patch lies so far from the border that 1 % of its light, or less, leaves the frame.
        let millimetres_per_pixel =
            crate::setup::widest_radius_mm(crate::setup::DEFAULT_STEM, 0.99) as f32 / 40.0;
        let is_lit = |x: u32, y: u32| x.abs_diff(SIDE / 2) < 6 && y.abs_diff(SIDE / 2) < 6;
        let buffers = Buffers::plane([SIDE; 2], 0).lit(|x, y| [if is_lit(x, y) { 1.0 } else { 0.0 }; 3]);
        let picture =
            diffuser.diffuse(&SubsurfaceView::orthographic_distances(millimetres_per_pixel), &buffers);
        for channel in 0..3 {
            let sum = |pixels: &[[f32; 4]]| pixels.iter().map(|p| f64::from(p[channel])).sum::<f64>();
            let ratio = sum(&picture) / sum(&buffers.irradiance);
            println!("{kernel}, channel {channel}: {ratio:.4} of the light is there");
            // Gathering conserves sums only as far as a tap reaches as often as it is reached: lattices of few points
            // weigh radii by strata, and the light near the border is renormalized.
            assert!((ratio - 1.0).abs() < 0.04, "{kernel}, channel {channel}: {ratio}");
        }
    }
}
