//! The debug views show something, of every kernel.

use crate::buffers::{Buffers, DISTANCE_MM, noise};
use crate::setup::{Description, Diffuser, KERNELS, PATHS, shared_gpu};
use subsurface_codegen::{Compiler, Estimator};
use subsurface_runtime::{DebugView, Path, SubsurfaceDescriptor, SubsurfacePass, SubsurfaceView};

const SIZE: [u32; 2] = [70, 52];
const TILE_SIDE: u32 = 16;

/// A surface that comes nearer to the right, with a hole and empty tiles.
fn scene() -> Buffers {
    Buffers::plane(SIZE, 0)
        .lit(|x, y| [0, 1, 2].map(|salt| noise(x / 3, y / 3, salt)))
        .covered(|x, y| {
            let is_hole = x < 33 && y < 20 || x.abs_diff(50) + y.abs_diff(40) < 8;
            if is_hole { -1.0 } else { 0.0 }
        })
        // From where the filter is below a pixel to where it is beyond a hundred.
        .distant(|x, _| 6.0 * DISTANCE_MM * (-0.08 * x as f32).exp())
}

#[test]
fn every_view_shows_something_of_every_kernel() {
    let buffers = scene();
    let view = SubsurfaceView::perspective_distances(0.5, SIZE[1]);
    for kernel in KERNELS {
        let description = Description::pair(kernel);
        for path in PATHS {
            let mut diffuser = Diffuser::new(&description, path);
            let plain = diffuser.diffuse(&view, &buffers);
            for debug_view in DebugView::ALL {
                let picture = diffuser.show(debug_view, &view, &buffers);
                let context = format!("{kernel}, {path:?}, {}", debug_view.name());
                let in_range = picture.iter().flatten().all(|value| (0.0..=1.0).contains(value));
                assert!(in_range, "{context}: a colour is none");
                let translucent: Vec<_> = (0..picture.len())
                    .filter(|index| buffers.surface[*index][3] >= 0.0)
                    .map(|index| picture[index])
                    .collect();
                let varies = translucent.iter().any(|pixel| *pixel != translucent[0]);
                assert!(varies, "{context}: one colour");
            }
            assert!(diffuser.diffuse(&view, &buffers) == plain, "{kernel}, {path:?}: the view stays on");
        }
    }
}

#[test]
fn tiles_are_marked_where_a_pixel_scatters() {
    let buffers = scene();
    let view = SubsurfaceView::perspective_distances(0.5, SIZE[1]);
    for kernel in KERNELS {
        let mut diffuser = Diffuser::new(&Description::pair(kernel), Path::Compute);
        let picture = diffuser.show(DebugView::Tiles, &view, &buffers);
        let mut seen = [false; 2];
        for y in 0..SIZE[1] {
            for x in 0..SIZE[0] {
                // The first row and column of a tile are its border.
                if x % TILE_SIDE == 0 || y % TILE_SIDE == 0 {
                    continue;
                }
                let (left, top) = (x - x % TILE_SIDE, y - y % TILE_SIDE);
                let is_listed = (top..(top + TILE_SIDE).min(SIZE[1])).any(|y| {
                    (left..(left + TILE_SIDE).min(SIZE[0]))
                        .any(|x| buffers.surface[buffers.index(x, y)][3] >= 0.0)
                });
                let [_, green, blue, _] = picture[buffers.index(x, y)];
                assert_eq!(green > blue, is_listed, "{kernel}, ({x}, {y}): green {green}, blue {blue}");
                seen[usize::from(is_listed)] = true;
            }
        }
        assert_eq!(seen, [true; 2], "the scene has tiles of both kinds");
    }
}

#[test]
fn the_filter_radius_grows_as_the_surface_comes_near() {
    let buffers = scene();
    let view = SubsurfaceView::perspective_distances(0.5, SIZE[1]);
    for kernel in KERNELS {
        let mut diffuser = Diffuser::new(&Description::pair(kernel), Path::Compute);
        let picture = diffuser.show(DebugView::FilterRadius, &view, &buffers);
        let heat: Vec<f32> = (0..SIZE[0]).map(|x| picture[buffers.index(x, 25)][..3].iter().sum()).collect();
        assert!(heat.windows(2).all(|pair| pair[0] <= pair[1]), "{kernel}: {heat:?}");
        assert!(heat[0] + 0.2 < heat[SIZE[0] as usize - 1], "{kernel}: {heat:?}");
    }
}

#[test]
fn what_is_rejected_is_drawn_at_the_silhouette() {
    let buffers = Buffers::plane(SIZE, 0).covered(|x, _| if x < 35 { 0.0 } else { -1.0 });
    for kernel in KERNELS {
        let mut diffuser = Diffuser::new(&Description::pair(kernel), Path::Compute);
        let picture =
            diffuser.show(DebugView::RejectedEnergy, &SubsurfaceView::orthographic_distances(0.3), &buffers);
        let heat =
            |x: u32| -> f32 { (18..34).flat_map(|y| picture[buffers.index(x, y)][..3].to_vec()).sum() };
        // Half of the light at the border would come from beyond it; inside, some would from beyond the frame.
        assert!(heat(34) > 2.0 * heat(17), "{kernel}: {} at the border, {} inside", heat(34), heat(17));
    }
}

#[test]
fn the_variance_is_of_light_in_any_unit() {
    let buffers = scene();
    let view = SubsurfaceView::perspective_distances(0.5, SIZE[1]);
    let mut diffuser = Diffuser::new(&Description::pair(Estimator::default()), Path::Compute);
    let plain = diffuser.show(DebugView::Variance, &view, &buffers);
    // Squares of either are no f32. Powers of two change no digit of what is not squared.
    for factor in [2f32.powi(90), 2f32.powi(-70)] {
        let mut scaled = buffers.clone();
        for pixel in &mut scaled.irradiance {
            *pixel = pixel.map(|value| value * factor);
        }
        assert!(diffuser.show(DebugView::Variance, &view, &scaled) == plain, "light times {factor:e}");
    }
}

#[test]
fn taps_have_one_scale_for_every_estimator() {
    let buffers = Buffers::plane([20, 20], 0);
    for kernel in KERNELS {
        let mut diffuser = Diffuser::new(&Description::pair(kernel), Path::Compute);
        // Taps per pixel of a budget: two passes have both, Dense reads more than white stands for.
        for (budget, taps) in [(1, 1.0), (4, 4.0), (17, 17.0), (64, 64.0)] {
            let taps = match kernel {
                // Taps on both sides of a centre: an even number is rounded up.
                Estimator::Separable { .. } => 2.0 * (2.0 * (budget as f32 / 2.0).floor() + 1.0),
                Estimator::Dense => 128.0,
                Estimator::Interleaved { .. } | Estimator::ImportanceSampled { .. } => taps,
            };
            let mut shown = |millimetres_per_pixel: f32| {
                let view = SubsurfaceView::orthographic_distances(millimetres_per_pixel).with_taps(budget);
                let [red, green, blue, alpha] = diffuser.show(DebugView::Taps, &view, &buffers)[0];
                assert_eq!(alpha, 1.0, "{kernel}");
                red + green + blue
            };
            // A footprint below a pixel takes none; a large one the whole budget.
            let [none, all] = [1e3, 1e-3].map(&mut shown);
            let expected = 3.0 * (1.0 + taps).log2() / 129f32.log2();
            // Two logarithms of the device, of a few units in the last place.
            let is_close = (all - expected.min(3.0)).abs() < 1e-3;
            assert!(none == 0.0 && is_close, "{kernel}, {budget} taps: {none}, {all}, not {expected}");
        }
    }
}

#[test]
fn alpha_is_zero_where_nothing_scatters() {
    let buffers = scene();
    let view = SubsurfaceView::perspective_distances(0.5, SIZE[1]);
    let mut diffuser = Diffuser::new(&Description::pair(Estimator::default()), Path::Compute);
    for debug_view in DebugView::ALL {
        let picture = diffuser.show(debug_view, &view, &buffers);
        for (pixel, surface) in picture.iter().zip(&buffers.surface) {
            let expected = if surface[3] >= 0.0 { 1.0 } else { 0.0 };
            assert_eq!(pixel[3], expected, "{}", debug_view.name());
        }
    }
}

#[test]
fn a_kernel_without_debug_views_refuses_them() {
    let gpu = shared_gpu();
    let skin = "Material(profile: Burley(parametrization: Searchlight), mean_free_path_mm: (1.3, 0.95, 0.67), \
                surface_albedo: (0.83, 0.64, 0.55))";
    let compilation = Compiler::from_memory([("skin.ron", skin)]).compile();
    let compilation = compilation.unwrap_or_else(|report| panic!("{report}"));
    assert!(!compilation.wgsl().contains("fn debug"), "what no one asked for is linked");
    let kernel = gpu.load(&compilation.parts);
    let pass = gpu.validated(|| SubsurfacePass::new(&gpu.device, &kernel, &SubsurfaceDescriptor::default()));
    let mut pass = pass.expect("every device can write the default format");
    let error = pass.set_debug_view(Some(DebugView::Taps)).expect_err("there is no view");
    assert_eq!(
        error.to_string(),
        "the kernel was compiled without debug views, so `taps` cannot be shown: compile it with \
         `Compiler::with_debug_views`"
    );
    assert_eq!(pass.set_debug_view(None), Ok(()));
}
