//! What becomes of the picture as surfaces come near and go far.

use crate::buffers::{Buffers, noise};
use crate::setup::{DEFAULT_STEM, Description, Diffuser, KERNELS, PATHS, widest_radius_mm};
use subsurface_codegen::Estimator;
use subsurface_runtime::{Path, SubsurfaceView};

#[test]
fn no_taps_and_a_footprint_below_a_pixel_return_the_input() {
    for kernel in KERNELS {
        for path in PATHS {
            let description = Description::on_path(kernel, path);
            let mut diffuser = Diffuser::new(&description, path);
            for (material, stem) in (0..).zip(&description.stems) {
                // Tilted, and lit by numbers that no short sum hits: the input comes back bit by bit.
                let buffers = Buffers::plane([19, 14], material)
                    .lit(|x, y| [0, 1, 2].map(|salt| 1.7 * noise(x, y, salt)))
                    .distant(|x, y| 500.0 + 0.1 * x as f32 - 0.07 * y as f32);
                // Half a pixel: curves are straight between their steps and mixed between surface albedos, and the last
                // bins of a table are wide.
                let below_a_pixel = 2.0 * widest_radius_mm(stem, 0.997) as f32;
                for (millimetres_per_pixel, taps) in [(0.25, Some(0)), (below_a_pixel, None), (1e5, Some(32))]
                {
                    let view = SubsurfaceView::orthographic_distances(millimetres_per_pixel);
                    let view = taps.map_or(view, |taps| view.with_taps(taps));
                    let picture = diffuser.diffuse(&view, &buffers);
                    assert!(
                        picture == buffers.irradiance,
                        "{kernel}, {path:?}, {stem}, {millimetres_per_pixel} mm per pixel: not the input"
                    );
                }
            }
        }
    }
}

/// Largest change of a pixel between frames whose radii differ by 3 %, of a texture of contrast 1: a filter that widens so
/// much moves less than 3 % of its light by about its radius. Taps that snap from pixel to pixel add their noise, and with
/// a tap more all strata move.
fn bound(kernel: Estimator) -> f64 {
    match kernel {
        // 17 taps without anything that holds them still.
        Estimator::ImportanceSampled { .. } => 0.09,
        Estimator::Separable { .. } => 0.06,
        Estimator::Interleaved { .. } | Estimator::Dense => 0.03,
    }
}

#[test]
fn nothing_pops_along_a_dolly() {
    const SIDE: u32 = 40;
    const STEPS_PER_DOUBLING: u32 = 24;
    // Waves of 25 pixels with a little noise on top.
    let wave =
        |x: u32, y: u32| 0.5 + 0.4 * (0.25 * x as f32).sin() * (0.2 * y as f32).cos() + 0.1 * noise(x, y, 0);
    // The filter radius goes from a third of a pixel to 20 pixels.
    let mut found = Vec::new();
    let nearest_mm_per_pixel = widest_radius_mm(DEFAULT_STEM, 0.997) as f32 / 20.0;
    for kernel in KERNELS {
        let mut diffuser = Diffuser::new(&Description::pair(kernel), Path::Compute);
        let mut before: Option<Vec<[f32; 4]>> = None;
        let (mut of_pixel, mut of_mean, mut of_rms) = (0.0_f64, 0.0_f64, 0.0_f64);
        let mut where_worst = 0.0;
        for step in 0..=6 * STEPS_PER_DOUBLING {
            let factor = (f64::from(step) / f64::from(STEPS_PER_DOUBLING)).exp2() as f32;
            let buffers =
                Buffers::plane([SIDE; 2], 0).lit(|x, y| [wave(x, y); 3]).distant(|_, _| 100.0 * factor);
            // A field of view that spans the frame at 100 mm.
            let fov = 2.0 * (0.5 * nearest_mm_per_pixel * SIDE as f32 / 100.0).atan();
            let picture = diffuser.diffuse(&SubsurfaceView::perspective_distances(fov, SIDE), &buffers);
            if let Some(before) = &before {
                let changes: Vec<f64> = picture
                    .iter()
                    .zip(before)
                    .flat_map(|(now, then)| (0..3).map(|c| f64::from(now[c]) - f64::from(then[c])))
                    .collect();
                let largest = changes.iter().fold(0.0, |largest: f64, change| largest.max(change.abs()));
                if largest > of_pixel {
                    (of_pixel, where_worst) = (largest, 20.0 / factor);
                }
                of_mean = of_mean.max((changes.iter().sum::<f64>() / changes.len() as f64).abs());
                of_rms =
                    of_rms.max((changes.iter().map(|c| c * c).sum::<f64>() / changes.len() as f64).sqrt());
            }
            before = Some(picture);
        }
        println!(
            "{kernel}: a step of 3 % changes a pixel by {of_pixel:.4} at most (radius {where_worst:.1} px), \
             all by {of_rms:.4} RMS, the mean by {of_mean:.5}"
        );
        found.push((kernel, of_mean, of_pixel));
    }
    for (kernel, of_mean, of_pixel) in found {
        assert!(of_mean < 2e-3, "{kernel}: the mean jumps by {of_mean}");
        assert!(of_pixel < bound(kernel), "{kernel}: a pixel jumps by {of_pixel}");
    }
}

#[test]
fn scattering_fades_in_from_one_pixel_to_two() {
    for kernel in KERNELS {
        let mut diffuser = Diffuser::new(&Description::pair(kernel), Path::Compute);
        let buffers = Buffers::plane([32, 32], 0).lit(|x, y| [noise(x, y, 0); 3]);
        let radius_mm = widest_radius_mm(DEFAULT_STEM, 0.997);
        let contrast = |diffuser: &mut Diffuser, radius_pixels: f64| {
            let view = SubsurfaceView::orthographic_distances((radius_mm / radius_pixels) as f32);
            let picture = diffuser.diffuse(&view, &buffers);
            let inner = (8..24).flat_map(|y| (8..24).map(move |x| (x, y)));
            inner.map(|(x, y)| (f64::from(picture[buffers.index(x, y)][0]) - 0.5).powi(2)).sum::<f64>().sqrt()
        };
        let contrasts = [0.9, 1.05, 1.25, 1.5, 2.0, 4.0, 8.0].map(|radius| contrast(&mut diffuser, radius));
        let contrasts = contrasts.map(|contrast| contrast / contrasts[0]);
        println!("{kernel}: contrast of noise as the filter grows: {contrasts:.3?}");
        // Where a twentieth of the filter has come in, no more than a twentieth may be gone; 0.01 for a curve that is
        // straight between its steps.
        assert!(contrasts[1] > 0.94, "{kernel}: {contrasts:?}");
        assert!(contrasts.windows(2).all(|pair| pair[1] <= pair[0] + 0.02), "{kernel}: {contrasts:?}");
    }
}
