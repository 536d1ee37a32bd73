//! Pictures, and their exact results.

use super::{expected, optics_of, skin};
use crate::gather::point::Point;
use crate::pictures::case::{Case, FOOTPRINTS};
use crate::pictures::patch::{PATCH_SIDE, Patch};
use crate::pictures::reference;
use crate::pictures::scene::Scene;
use subsurface_kernel::{Estimator, Rejection};

#[test]
fn two_ways_to_the_exact_result_agree() {
    // A disc so large that its border is a straight edge from nearby, summed pixel by pixel, against the integral over
    // the half plane; and a line as the difference of two edges.
    let optics = optics_of(&[skin()]);
    let point = Point::new(&optics[0], 2.0, true, false);
    let patch = Patch::all(Scene::StepEdge, 8.0)[1];
    let edge = expected(&point, Scene::StepEdge, &[patch]);
    let line = expected(&point, Scene::Line, &[patch]);
    for (place, pixel) in patch.pixels().enumerate() {
        let [x, _] = patch.in_scene(pixel);
        let beside = patch.pixels().position(|other| patch.in_scene(other)[0] == x - 1);
        if let Some(beside) = beside {
            for channel in 0..3 {
                let difference = edge[place][channel] - edge[beside][channel];
                assert!((line[place][channel] - difference).abs() < 1e-12);
            }
        }
    }
    // Light within a disc about its own middle is the CDF, whatever the profile.
    for radius in [2.5, 7.3] {
        let scene = Scene::Disc { radius };
        let lit = (-9..=9).flat_map(|y| (-9..=9).map(move |x| scene.light(x, y))).sum::<f64>();
        let middle = Patch::all(scene, 3.0).into_iter().find_map(|patch| {
            let place = patch.pixels().position(|pixel| patch.in_scene(pixel) == [0, 0])?;
            Some(expected(&point, scene, &[patch])[place])
        });
        let middle = middle.expect("a region of three pixels holds the middle");
        // The disc with the area of the pixels that are lit: their ragged border is 1 % of the light away from it.
        let cdf = point.radial_cdf((lit / std::f64::consts::PI).sqrt() * point.pixel);
        for channel in 0..3 {
            assert!((middle[channel] - cdf[channel]).abs() < 0.01, "{radius}: {middle:?}, {cdf:?}");
        }
    }
}

#[test]
fn a_crease_without_depth_is_a_step_edge() {
    let optics = optics_of(&[skin()]);
    let flat = Rejection { by_distance: false, ..Rejection::default() };
    let drawn = |scene, rejection| {
        let cases = Case::of_footprint(&optics[0], 3.0, rejection);
        let mut case = cases.into_iter().find(|case| case.scene == scene).expect("one of them");
        case.deviation(Estimator::Interleaved { taps: 4 }).expect("it has a twin")
    };
    assert_eq!(drawn(Scene::Crease, flat), drawn(Scene::StepEdge, flat));
    assert_ne!(drawn(Scene::Crease, Rejection::default()), drawn(Scene::StepEdge, flat));
}

#[test]
fn a_crease_is_the_sum_of_its_pixels() {
    let optics = optics_of(&[skin()]);
    let point = Point::new(&optics[0], 2.0, true, false);
    let patch = Patch::all(Scene::Crease, 8.0)[1];
    let drawn = expected(&point, Scene::Crease, &[patch]);
    // Pixel by pixel over 61 columns and rows, 16 points in each; the centre's share from the CDF.
    for (place, pixel) in patch.pixels().enumerate().take(PATCH_SIDE as usize) {
        let [x, _] = patch.in_scene(pixel);
        let (mut light, mut weight) = ([0.0; 3], [0.0; 3]);
        for (right, down) in (-30..=30).flat_map(|right| (-30..=30).map(move |down| (right, down))) {
            let depth = Scene::Crease.depth(x + right, down) - Scene::Crease.depth(x, 0);
            let share = if (right, down) == (0, 0) {
                // The disc with the area of a pixel.
                point.radial_cdf(point.pixel / std::f64::consts::PI.sqrt())
            } else {
                let mut share = [0.0; 3];
                for within in 0..16 {
                    let offset = |place: i32, within: i32| f64::from(place) + f64::from(within) / 4.0 - 0.375;
                    let across = offset(right, within % 4).hypot(offset(down, within / 4));
                    let density = point.area_pdf_at_squared((across.hypot(depth) * point.pixel).powi(2));
                    for channel in 0..3 {
                        share[channel] += density[channel] * point.pixel * point.pixel / 16.0;
                    }
                }
                share
            };
            for channel in 0..3 {
                light[channel] += share[channel] * Scene::Crease.light(x + right, 0);
                weight[channel] += share[channel];
            }
        }
        for channel in 0..3 {
            let sum = light[channel] / weight[channel];
            // The disc in place of a square and the 16 points are off by less than this together.
            assert!((drawn[place][channel] - sum).abs() < 5e-3, "{:?}, {sum} in {channel}", drawn[place]);
        }
    }
}

#[test]
fn a_patch_holds_every_phase_once() {
    for scene in FOOTPRINTS.into_iter().flat_map(Scene::all) {
        for patch in Patch::all(scene, scene.reach(3.0)) {
            let mut phases: Vec<_> =
                patch.pixels().map(|pixel| pixel.map(|place| place.rem_euclid(PATCH_SIDE))).collect();
            phases.sort_unstable();
            phases.dedup();
            assert_eq!(phases.len(), (PATCH_SIDE * PATCH_SIDE) as usize);
        }
    }
}

#[test]
fn regions_hold_the_feature_and_what_is_beyond_it() {
    for footprint in FOOTPRINTS {
        for scene in Scene::all(footprint) {
            let places: Vec<[i32; 2]> = Patch::all(scene, scene.reach(footprint))
                .into_iter()
                .flat_map(|patch| patch.pixels().map(move |pixel| patch.in_scene(pixel)))
                .filter(|[x, y]| scene.covers(*x, *y))
                .collect();
            let lit = places.iter().filter(|[x, y]| scene.light(*x, *y) > 0.0).count();
            // The line is one pixel wide; a disc takes a tenth of its region.
            assert!(lit > 0 && lit < places.len(), "{scene:?} at {footprint}: {lit} lit");
            // The columns on both sides of an edge, where steps are.
            for column in [-2, -1, 0, 1] {
                let is_there = places.iter().any(|[x, _]| *x == column);
                assert!(is_there || !scene.has_equal_rows(), "{scene:?} at {footprint}: column {column}");
            }
            assert!(
                places.iter().flatten().all(|place| f64::from(place.abs()) <= scene.reach(footprint) + 6.0)
            );
        }
    }
}

#[test]
fn what_is_panned_shows_the_same_pixels_at_every_step() {
    let patches = Patch::all(Scene::Pan, Scene::Pan.reach(3.0));
    let pixels: Vec<_> =
        patches.iter().flat_map(|patch| patch.pixels().map(move |pixel| (patch, pixel))).collect();
    let mut moved = 0;
    for (place, (patch, pixel)) in pixels.iter().enumerate() {
        let Some(before) = Patch::before_pan(place) else { continue };
        let (still, was) = pixels[before];
        assert_eq!(still.in_scene(was), patch.in_scene(*pixel));
        assert_ne!(was.map(|x| x.rem_euclid(PATCH_SIDE)), pixel.map(|x| x.rem_euclid(PATCH_SIDE)));
        moved += 1;
    }
    assert_eq!(4 * moved, 3 * pixels.len());
}

#[test]
fn a_frame_without_end_is_a_step_edge() {
    let optics = optics_of(&[skin()]);
    let point = Point::new(&optics[0], 3.0, true, false);
    let patches = Patch::all(Scene::StepEdge, 9.0);
    let edge = expected(&point, Scene::StepEdge, &patches);
    let frame = expected(&point, Scene::Frame { half: 100_000 }, &patches);
    for (edge, frame) in edge.iter().zip(&frame) {
        for channel in 0..3 {
            // What of the profile's tail lies beyond.
            assert!((edge[channel] - frame[channel]).abs() < 1e-4, "{edge:?}, {frame:?}");
        }
    }
}

#[test]
fn a_frame_is_the_sum_of_its_columns() {
    let optics = optics_of(&[skin()]);
    let scene = Scene::Frame { half: 2 };
    for returned in [false, true] {
        let point = Point::new(&optics[0], 10.0, true, returned);
        let patches = Patch::all(Scene::Line, 8.0);
        // A lit column by its distance.
        let mut lines = std::collections::BTreeMap::new();
        for (patch, drawn) in patches.iter().zip(expected(&point, Scene::Line, &patches).chunks(16)) {
            for (pixel, light) in patch.pixels().zip(drawn) {
                lines.insert(patch.in_scene(pixel)[0].abs(), light[0]);
            }
        }
        let frame = reference::expected(&point, scene, &Patch::all(scene, 2.0));
        let places = Patch::all(scene, 2.0).into_iter();
        let columns = places.flat_map(|patch| patch.pixels().map(move |pixel| patch.in_scene(pixel)[0]));
        let mut shown = 0;
        for (x, found) in columns.zip(frame) {
            let Some(found) = found else {
                assert!(!(-2..2).contains(&x));
                continue;
            };
            let from = |column: i32| lines[&(x - column).abs()];
            let (lit, dark) = (from(0) + from(1), from(-1) + from(-2));
            let own = f64::from(u8::from(x >= 0));
            let right = if returned { lit + (1.0 - lit - dark) * own } else { lit / (lit + dark) };
            assert!((found[0] - right).abs() < 1e-9, "column {x}: {found:?}, {right}");
            shown += 1;
        }
        assert!(shown >= 16);
    }
}
