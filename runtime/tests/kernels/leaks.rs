//! A bright background never bleeds in.

use crate::buffers::{Buffers, DISTANCE_MM};
use crate::setup::{Description, Diffuser, KERNELS, PATHS, widest_radius_mm};
use subsurface_codegen::Estimator;
use subsurface_runtime::{Path, SubsurfaceView};

const SIZE: [u32; 2] = [34, 31];

/// A disc with a strand one pixel wide beside it and holes in it: silhouettes of every direction.
fn is_foreground(x: u32, y: u32) -> bool {
    let (dx, dy) = (f64::from(x) - 13.0, f64::from(y) - 14.0);
    let disc = dx.hypot(dy) < 10.0 && !(x % 11 == 3 && y % 7 == 2);
    disc || x == 28 || y == 27 + x / 20
}

/// Brightest foreground pixel where the foreground is lit with 1 and all else with 1000.
fn brightest(picture: &[[f32; 4]]) -> f32 {
    (0..SIZE[1])
        .flat_map(|y| (0..SIZE[0]).map(move |x| (x, y)))
        .filter(|(x, y)| is_foreground(*x, *y))
        .flat_map(|(x, y)| picture[(y * SIZE[0] + x) as usize][..3].to_vec())
        .fold(0.0, f32::max)
}

fn lit_buffers(material: u32) -> Buffers {
    Buffers::plane(SIZE, material).lit(|x, y| [if is_foreground(x, y) { 1.0 } else { 1000.0 }; 3])
}

#[test]
fn a_background_of_no_material_never_bleeds() {
    for kernel in KERNELS {
        let description = Description::affordable(kernel);
        let mut diffuser = Diffuser::new(&description, Path::Compute);
        for (material, stem) in (0..).zip(&description.stems) {
            let buffers = lit_buffers(material)
                .covered(|x, y| if is_foreground(x, y) { material as f32 } else { -1.0 });
            // At infinity, and where the surface is.
            for background_mm in [f32::INFINITY, DISTANCE_MM] {
                let distance = |x, y| if is_foreground(x, y) { DISTANCE_MM } else { background_mm };
                let buffers = buffers.clone().distant(distance);
                let picture = diffuser.diffuse(&SubsurfaceView::orthographic_distances(0.25), &buffers);
                let brightest = brightest(&picture);
                // 2e-3: as where all light is constant.
                assert!(brightest < 1.002, "{kernel}, {stem}, background at {background_mm} mm: {brightest}");
            }
        }
    }
}

#[test]
fn another_material_does_not_mix() {
    for kernel in KERNELS {
        for path in PATHS {
            let description = match path {
                Path::Compute => Description::affordable(kernel),
                Path::Fragment => Description::on_path(kernel, path),
            };
            let mut diffuser = Diffuser::new(&description, path);
            let materials = description.stems.len() as u32;
            for material in 0..materials {
                let other = (material + 1) % materials;
                let number = |x, y| if is_foreground(x, y) { material } else { other } as f32;
                let picture = diffuser.diffuse(
                    &SubsurfaceView::orthographic_distances(0.25),
                    &lit_buffers(material).covered(number),
                );
                for y in 0..SIZE[1] {
                    for x in 0..SIZE[0] {
                        let expected = if is_foreground(x, y) { 1.0 } else { 1000.0 };
                        let pixel = picture[(y * SIZE[0] + x) as usize];
                        // 2e-3: light in nine bits, as where all is constant.
                        let kept = pixel[..3].iter().all(|value| (value / expected - 1.0).abs() < 2e-3);
                        assert!(
                            kept,
                            "{kernel}, {path:?}, materials {material} and {other}, ({x}, {y}): {pixel:?}"
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn the_same_material_deep_behind_does_not_bleed() {
    let mut found = Vec::new();
    for kernel in KERNELS {
        let description = Description::affordable(kernel);
        let mut diffuser = Diffuser::new(&description, Path::Compute);
        for millimetres_per_pixel in [0.1, 1.0] {
            let mut worst = (0.0, "");
            for (material, stem) in (0..).zip(&description.stems) {
                // Beyond all of the profile's light: some reach farther than 100 mm.
                let depth_mm = (3.0 * widest_radius_mm(stem, 0.9999) as f32).max(100.0);
                let buffers = lit_buffers(material)
                    .distant(|x, y| DISTANCE_MM + if is_foreground(x, y) { 0.0 } else { depth_mm });
                let view = SubsurfaceView::orthographic_distances(millimetres_per_pixel);
                let brightest = brightest(&diffuser.diffuse(&view, &buffers));
                if brightest > worst.0 {
                    worst = (brightest, *stem);
                }
            }
            let (brightest, stem) = worst;
            println!(
                "{kernel}, {millimetres_per_pixel} mm per pixel: {brightest:.4} in front of 1000 ({stem})"
            );
            found.push((kernel, millimetres_per_pixel, brightest, stem));
        }
    }
    for (kernel, millimetres_per_pixel, brightest, stem) in found {
        // As fractions of the foreground's light; the background's is 1000 of them.
        let bound = match kernel {
            // Strips know the distance to a line, along which something is always near.
            Estimator::Separable { .. } => 0.5,
            // Depth takes from a neighbour's share only as r^-2: a step of 100 pixels leaves 1e-4.
            Estimator::Interleaved { .. } => 0.2,
            Estimator::ImportanceSampled { .. } | Estimator::Dense => 2e-3,
        };
        assert!(
            brightest < 1.0 + bound,
            "{kernel}, {stem}, {millimetres_per_pixel} mm per pixel: {brightest}"
        );
    }
}
