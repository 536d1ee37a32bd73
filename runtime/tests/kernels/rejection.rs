//! What each policy of rejection lets through, and what becomes of the rest.

use crate::buffers::{Buffers, DISTANCE_MM};
use crate::energy::{deviation, tolerance};
use crate::setup::{Description, Diffuser, KERNELS};
use subsurface_codegen::{Estimator, Rejected, Rejection};
use subsurface_runtime::{Path, SubsurfaceView};

const SIZE: [u32; 2] = [44, 36];
const MIDDLE: u32 = SIZE[0] / 2;
const MILLIMETRES_PER_PIXEL: f32 = 0.3;

/// No reason to reject.
fn nothing() -> Rejection {
    Rejection { by_material: false, by_distance: false, by_normal: false, rejected: Rejected::Renormalized }
}

fn diffuser(kernel: Estimator, rejection: Rejection) -> Diffuser {
    Diffuser::new(&Description { rejection, ..Description::pair(kernel) }, Path::Compute)
}

fn view() -> SubsurfaceView {
    SubsurfaceView::orthographic_distances(MILLIMETRES_PER_PIXEL)
}

/// A plane that is lit to the right of the middle.
fn half_lit() -> Buffers {
    Buffers::plane(SIZE, 0).lit(|x, _| [if x >= MIDDLE { 1.0 } else { 0.0 }; 3])
}

/// Light per row that crossed from the lit half into the dark one.
fn crossed(picture: &[[f32; 4]]) -> f64 {
    let dark = (0..picture.len()).filter(|index| (*index as u32 % SIZE[0]) < MIDDLE);
    dark.map(|index| f64::from(picture[index][0])).sum::<f64>() / f64::from(SIZE[1])
}

#[test]
fn every_policy_keeps_constants() {
    let all = Rejection { by_material: true, by_distance: true, by_normal: true, ..nothing() };
    let policies = [
        nothing(),
        Rejection { by_material: true, ..nothing() },
        Rejection { by_distance: true, ..nothing() },
        Rejection { by_normal: true, ..nothing() },
        all,
        Rejection { rejected: Rejected::ReturnedToCentre, ..nothing() },
        Rejection { rejected: Rejected::ReturnedToCentre, ..all },
    ];
    let irradiance = [0.9, 1.7, 1.2];
    // Two materials, a hole, a step in depth and a crease: something to reject for every reason.
    let buffers = Buffers::plane(SIZE, 0)
        .lit(|_, _| irradiance)
        .covered(|x, y| if x.abs_diff(30) + y.abs_diff(20) < 4 { -1.0 } else { (y / 12 % 2) as f32 })
        .distant(|x, y| DISTANCE_MM + 0.5 * x.abs_diff(MIDDLE) as f32 + if y > 20 { 4.0 } else { 0.0 });
    for kernel in KERNELS {
        for policy in policies {
            let error = deviation(&diffuser(kernel, policy).diffuse(&view(), &buffers), irradiance);
            assert!(error < tolerance(kernel), "{kernel}, {policy}: {error}");
        }
    }
}

#[test]
fn light_crosses_materials_unless_they_reject() {
    let buffers = half_lit().covered(|x, _| if x >= MIDDLE { 1.0 } else { 0.0 });
    for kernel in KERNELS {
        let free = crossed(&diffuser(kernel, nothing()).diffuse(&view(), &buffers));
        let policy = Rejection { by_material: true, ..nothing() };
        let kept = crossed(&diffuser(kernel, policy).diffuse(&view(), &buffers));
        println!("{kernel}: {free:.3} pixels' light cross a border of materials, {kept:.3} where it rejects");
        assert!(free > 0.5 && kept == 0.0, "{kernel}: {free} without, {kept} with");
    }
}

#[test]
fn less_light_crosses_a_step_in_depth_that_rejects() {
    for kernel in KERNELS {
        let mut last = f64::INFINITY;
        for step_mm in [0.5, 3.0, 30.0] {
            let buffers = half_lit().distant(|x, _| DISTANCE_MM + if x >= MIDDLE { step_mm } else { 0.0 });
            let free = crossed(&diffuser(kernel, nothing()).diffuse(&view(), &buffers));
            let policy = Rejection { by_distance: true, ..nothing() };
            let kept = crossed(&diffuser(kernel, policy).diffuse(&view(), &buffers));
            println!(
                "{kernel}: {free:.3} pixels' light cross a step of {step_mm} mm, {kept:.3} where it rejects"
            );
            assert!(kept < free && kept < last, "{kernel}, {step_mm} mm: {free} without, {kept} with");
            last = kept;
        }
        // 30 mm are 23 mean free paths. Separable strips know the distance to a line, which reaches nearer than a point.
        let bound = if matches!(kernel, Estimator::Separable { .. }) { 0.06 } else { 0.01 };
        assert!(last < bound, "{kernel}: {last} pixels' light cross 30 mm");
    }
}

#[test]
fn less_light_crosses_a_crease_that_rejects() {
    // Slopes of one to either side: an edge of 90 degrees.
    let buffers = half_lit()
        .distant(|x, _| DISTANCE_MM + MILLIMETRES_PER_PIXEL * (x as f32 - (MIDDLE as f32 - 0.5)).abs());
    for kernel in KERNELS {
        let distance = Rejection { by_distance: true, ..nothing() };
        let free = crossed(&diffuser(kernel, distance).diffuse(&view(), &buffers));
        let both = Rejection { by_normal: true, ..distance };
        let kept = crossed(&diffuser(kernel, both).diffuse(&view(), &buffers));
        println!("{kernel}: {free:.3} pixels' light cross a crease, {kept:.3} where normals reject");
        // The normals of both flanks are perpendicular: what is left comes from the pixels of the edge itself.
        assert!(kept < 0.8 * free, "{kernel}: {free} without, {kept} with");
    }
}

#[test]
fn normals_of_a_plane_reject_nothing() {
    // Tilted, so that a normal in the wrong frame would show; steps of depth per pixel, in pixels.
    for slopes in [[0.67, -0.33], [1.0, 0.0], [1.0, 1.0], [-2.0, 2.0]] {
        let [right, down] = slopes.map(|slope| slope * MILLIMETRES_PER_PIXEL);
        // A diamond of squares of 2×2 pixels, a pixel off the blocks: its silhouettes leave blocks without their first
        // pixel, but every pixel has a neighbour along both axes.
        let buffers =
            half_lit().distant(|x, y| DISTANCE_MM + right * x as f32 + down * y as f32).covered(|x, y| {
                let apart = |place: u32| place.div_ceil(2).abs_diff(MIDDLE / 2);
                if apart(x) + apart(y) < 7 { 0.0 } else { -1.0 }
            });
        for kernel in KERNELS {
            let free = diffuser(kernel, Rejection::default()).diffuse(&view(), &buffers);
            let policy = Rejection { by_normal: true, ..Rejection::default() };
            let with = diffuser(kernel, policy).diffuse(&view(), &buffers);
            let worst = free.iter().zip(&with).map(|(a, b)| (a[0] - b[0]).abs()).fold(0.0, f32::max);
            // f32 distances of 500 mm have steps of 3e-5 mm, 1e-4 of a pixel; blocks keep nine bits.
            assert!(worst < 3e-3, "{kernel}, slopes {slopes:?}: {worst}");
        }
    }
}

#[test]
fn what_returns_to_the_centre_raises_no_sum() {
    // A strip of material 0 between others, with a lit patch in its middle: light that would leave the strip is
    // rejected.
    let is_strip = |x: u32| (18..26).contains(&x);
    let is_patch = |x: u32, y: u32| (21..23).contains(&x) && (12..24).contains(&y);
    let buffers = Buffers::plane(SIZE, 0)
        .lit(|x, y| [if is_patch(x, y) { 1.0 } else { 0.0 }; 3])
        .covered(|x, _| if is_strip(x) { 0.0 } else { 1.0 });
    let sum = |picture: &[[f32; 4]]| picture.iter().map(|pixel| f64::from(pixel[0])).sum::<f64>();
    let before = sum(&buffers.irradiance);
    for kernel in KERNELS {
        let policy = Rejection::default();
        let renormalized = sum(&diffuser(kernel, policy).diffuse(&view(), &buffers)) / before;
        let policy = Rejection { rejected: Rejected::ReturnedToCentre, ..policy };
        let returned = sum(&diffuser(kernel, policy).diffuse(&view(), &buffers)) / before;
        println!(
            "{kernel}: the sum is {renormalized:.4} of what it was renormalized, {returned:.4} returned"
        );
        // A lattice of few taps reaches a pixel a little more or less often than it is reached from there.
        let bound = if kernel == Estimator::Dense { 1e-3 } else { 0.07 };
        assert!((returned - 1.0).abs() < bound, "{kernel}: {returned}");
        assert!(renormalized > returned + 0.02, "{kernel}: {renormalized} is not above {returned}");
    }
}
