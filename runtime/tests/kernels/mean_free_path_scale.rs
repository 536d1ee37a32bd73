//! Factors on the mean free path, and surface albedos, per pixel.

use crate::buffers::{Buffers, DISTANCE_MM, noise};
use crate::setup::{Description, Diffuser, KERNELS, PATHS, psnr};
use subsurface_runtime::{Path, SubsurfaceView};

const SIZE: [u32; 2] = [36, 30];

fn noisy(material: u32, depth_factor: f32) -> Buffers {
    Buffers::plane(SIZE, material)
        .lit(|x, y| [0, 1, 2].map(|salt| noise(x / 2, y / 2, salt)))
        .distant(|x, y| depth_factor * (DISTANCE_MM + 0.7 * noise(x / 5, y / 5, 3)))
}

#[test]
fn a_factor_on_the_texture_is_a_factor_on_the_material() {
    for kernel in KERNELS {
        for factor in [0.4, 2.5] {
            let description = Description { length_factor: factor, ..Description::pair(kernel) };
            for path in PATHS {
                let mut diffuser = Diffuser::new(&description, path);
                let view = SubsurfaceView::orthographic_distances(0.3);
                let by_texture = diffuser.diffuse(&view, &noisy(0, 1.0).scaled(|_, _| factor as f32));
                let by_material = diffuser.diffuse(&view, &noisy(1, 1.0));
                let decibels = psnr(&by_texture, &by_material);
                println!("{kernel}, {path:?}: a factor of {factor} agrees to {decibels:.1} dB");
                assert!(decibels >= 50.0, "{kernel}, {path:?}, {factor}: {decibels:.1} dB");
            }
        }
    }
}

#[test]
fn a_factor_is_a_change_of_all_lengths() {
    for kernel in KERNELS {
        let description = Description::all_profiles(kernel);
        let mut diffuser = Diffuser::new(&description, Path::Compute);
        for (material, stem) in (0..).zip(&description.stems) {
            // Twice the mean free path on a scene twice as large is the same picture.
            let small =
                diffuser.diffuse(&SubsurfaceView::orthographic_distances(0.25), &noisy(material, 1.0));
            let large = diffuser.diffuse(
                &SubsurfaceView::orthographic_distances(0.5),
                &noisy(material, 2.0).scaled(|_, _| 2.0),
            );
            let decibels = psnr(&large, &small);
            assert!(decibels >= 50.0, "{kernel}, {stem}: {decibels:.1} dB");
        }
    }
}

/// Light two pixels beyond the edge of a half-lit plane.
fn beyond_the_edge(diffuser: &mut Diffuser, change: impl Fn(Buffers) -> Buffers) -> f64 {
    let buffers = change(Buffers::plane(SIZE, 0).lit(|x, _| [if x >= 18 { 1.0 } else { 0.0 }; 3]));
    let picture = diffuser.diffuse(&SubsurfaceView::orthographic_distances(0.3), &buffers);
    (8..22).map(|y| f64::from(picture[buffers.index(15, y)][0])).sum::<f64>() / 14.0
}

#[test]
fn light_goes_farther_the_longer_the_path_and_the_brighter_the_surface() {
    for kernel in KERNELS {
        let mut diffuser = Diffuser::new(&Description::pair(kernel), Path::Compute);
        let scales =
            [0.3_f32, 1.0, 3.0].map(|scale| beyond_the_edge(&mut diffuser, |b| b.scaled(|_, _| scale)));
        assert!(scales[0] < scales[1] && scales[1] < scales[2], "{kernel}, by scale: {scales:?}");
        let shades = [0.1, 0.4, 0.8].map(|a| beyond_the_edge(&mut diffuser, |b| b.coloured(|_, _| [a; 3])));
        assert!(shades[0] < shades[1] && shades[1] < shades[2], "{kernel}, by surface albedo: {shades:?}");
    }
}

#[test]
fn the_factor_of_one_pixel_holds_for_that_pixel() {
    for kernel in KERNELS {
        let mut diffuser = Diffuser::new(&Description::pair(kernel), Path::Compute);
        let chequer = |x: u32, y: u32| ((x + y) % 2) as f32;
        let buffers = Buffers::plane(SIZE, 0)
            .lit(|x, y| [chequer(x, y); 3])
            // On the left half scattering reaches less than a pixel.
            .scaled(|x, _| if x < 16 { 1e-3 } else { 3.0 });
        let picture = diffuser.diffuse(&SubsurfaceView::orthographic_distances(0.3), &buffers);
        for y in 4..26 {
            for (x, reach) in [(4, false), (9, false), (24, true), (31, true)] {
                let change = (picture[buffers.index(x, y)][0] - chequer(x, y)).abs();
                assert_eq!(change > 0.05, reach, "{kernel}, ({x}, {y}): changed by {change}");
            }
        }
    }
}
