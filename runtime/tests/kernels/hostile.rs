//! Buffers that no renderer should write.

use crate::buffers::Buffers;
use crate::setup::{Description, Diffuser, KERNELS, PATHS};
use subsurface_runtime::SubsurfaceView;

const STRANGE: [f32; 7] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -5.0, 0.0, 1.0, 3.0e38];
/// 1e30: what some renderers write for "very far".
const DISTANCES_MM: [f32; 7] = [500.0, 500.0, 0.0, f32::NAN, f32::INFINITY, -3.0, 1e30];
const SCALES: [f32; 6] = [1.0, f32::NAN, f32::INFINITY, 0.0, -2.0, 1e30];

fn strange(x: u32, y: u32, salt: u32) -> f32 {
    STRANGE[((x * 7 + y * 13 + salt) % 11).min(6) as usize]
}

/// A frame of all materials and of much that is none.
fn hostile_buffers(size: [u32; 2], materials: u32) -> Buffers {
    // Half of the pixels are of a material, in patches that other values interrupt.
    let number = |x: u32, y: u32| {
        let good = ((x / 5 + 6 * (y / 5)) % materials) as f32;
        [good, good, good, f32::NAN, good, materials as f32 + 7.0, -1.0, f32::INFINITY, good]
            [((x + y) % 9) as usize]
    };
    Buffers::plane(size, 0)
        .lit(|x, y| [strange(x, y, 0), strange(x, y, 1), 1.0])
        .coloured(|x, y| [strange(x, y, 2), 0.5, 0.5])
        .covered(number)
        .distant(|x, y| DISTANCES_MM[((x * 3 + y) % 7) as usize])
        .scaled(|x, y| SCALES[((x + 2 * y) % 6) as usize])
}

#[test]
fn hostile_buffers_give_finite_pixels() {
    for kernel in KERNELS {
        for path in PATHS {
            let description = Description::on_path(kernel, path);
            let mut diffuser = Diffuser::new(&description, path);
            for (size, millimetres_per_pixel) in [
                ([26, 21], 0.25),
                ([17, 31], 1e-3),
                ([1, 1], 1e-4),
                ([1, 1], 1e4),
                ([7, 3], 1e-4),
                ([7, 3], 0.3),
                ([7, 3], 1e4),
                ([7, 3], 0.0),
                ([7, 3], f32::NAN),
            ] {
                let buffers = hostile_buffers(size, description.stems.len() as u32);
                let view = SubsurfaceView::orthographic_distances(millimetres_per_pixel);
                let picture = diffuser.diffuse(&view, &buffers);
                check(&buffers, &picture, description.stems.len(), &format!("{kernel}, {path:?}, {size:?}"));
            }
        }
    }
}

/// Translucent pixels are finite and not negative, all others the bits that they were.
fn check(buffers: &Buffers, picture: &[[f32; 4]], materials: usize, context: &str) {
    for (index, pixel) in picture.iter().enumerate() {
        let number = buffers.surface[index][3];
        let distance = buffers.distance_mm[index];
        let is_material = number.is_finite() && number >= 0.0 && number < materials as f32;
        let own = buffers.irradiance[index];
        if is_material && distance.is_finite() && distance > 0.0 {
            let defined = pixel[..3].iter().all(|value| value.is_finite() && *value >= 0.0);
            assert!(defined, "{context}, pixel {index}: {pixel:?} of {own:?}");
        } else {
            let same =
                |c: usize| pixel[c].to_bits() == own[c].to_bits() || (pixel[c].is_nan() && own[c].is_nan());
            assert!((0..4).all(same), "{context}, pixel {index}: {pixel:?} is not {own:?}");
        }
    }
}

#[test]
fn a_filter_of_thousands_of_pixels_stays_bounded() {
    for kernel in KERNELS {
        let description = Description::all_profiles(kernel);
        let mut diffuser = Diffuser::new(&description, PATHS[0]);
        for (material, stem) in (0..).zip(&description.stems) {
            // A radius of 3,000 pixels over a frame of 33: what the frame does not hold is renormalized.
            let radius_mm = crate::setup::widest_radius_mm(stem, 0.997);
            let view = SubsurfaceView::orthographic_distances((radius_mm / 3000.0) as f32);
            let buffers = Buffers::plane([33, 19], material).lit(|x, _| [(x % 2) as f32; 3]);
            let picture = diffuser.diffuse(&view, &buffers);
            let in_range =
                picture.iter().all(|pixel| pixel[..3].iter().all(|v| (0.0..=1.0 + 1e-3).contains(v)));
            assert!(in_range, "{kernel}, {stem}: brighter than the light, or none");
        }
    }
}

#[test]
fn one_bad_pixel_does_not_darken_its_neighbours() {
    for kernel in KERNELS {
        let mut diffuser = Diffuser::new(&Description::pair(kernel), PATHS[0]);
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let buffers =
                Buffers::plane([24, 24], 0).lit(|x, y| [if (x, y) == (12, 12) { bad } else { 1.0 }; 3]);
            let picture = diffuser.diffuse(&SubsurfaceView::orthographic_distances(0.3), &buffers);
            for (index, pixel) in picture.iter().enumerate() {
                // What is not finite gives no light and takes no part; where it stands, a kernel may count its own light
                // as none.
                let is_bad = index == buffers.index(12, 12);
                let least = if is_bad { 0.0 } else { 0.998 };
                let legal = pixel[..3].iter().all(|value| (least..=1.002).contains(value));
                assert!(legal, "{kernel}, {bad}, pixel {index}: {pixel:?}");
            }
        }
    }
}

#[test]
fn a_far_tap_of_finite_distance_is_no_hole() {
    for kernel in KERNELS {
        let description = Description::all_profiles(kernel);
        let mut diffuser = Diffuser::new(&description, PATHS[0]);
        for (material, stem) in (0..).zip(&description.stems) {
            // Every second column lies 1e30 mm away, on the same material: its light must neither arrive nor spoil the
            // rest.
            let is_far = |x: u32| x % 2 == 1;
            let buffers = Buffers::plane([24, 24], material)
                .distant(|x, _| if is_far(x) { 1e30 } else { 500.0 })
                .lit(|x, _| if is_far(x) { [1000.0; 3] } else { [1.0; 3] });
            let picture = diffuser.diffuse(&SubsurfaceView::orthographic_distances(0.05), &buffers);
            for y in 0..24 {
                for x in (0..24).step_by(2) {
                    let pixel = picture[buffers.index(x, y)];
                    // 2e-3: light in nine bits, as where all is constant.
                    let kept = pixel[..3].iter().all(|value| (value - 1.0).abs() < 2e-3);
                    assert!(kept, "{kernel}, {stem}, ({x}, {y}): {pixel:?}");
                }
            }
        }
    }
}
