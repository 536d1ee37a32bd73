//! Light with hard borders, lights of a pixel, and silhouettes: the default kernel where it has the least to go by.

use crate::buffers::Buffers;
use crate::setup::{Description, Diffuser, MEAN_FREE_PATH_MM};
use subsurface_codegen::Estimator;
use subsurface_runtime::{Path, SubsurfaceView};

const KERNEL: Estimator = Estimator::Interleaved { taps: 4 };

/// Period of the kernel's lattice along an axis, pixels.
const PERIOD: u32 = 4;

/// What a kernel draws, all of it finite.
fn drawn(diffuser: &mut Diffuser, view: &SubsurfaceView, buffers: &Buffers) -> Vec<[f32; 4]> {
    let picture = diffuser.diffuse(view, buffers);
    assert!(picture.iter().flatten().all(|value| value.is_finite()));
    picture
}

/// 1 where something is lit.
fn light(is_lit: bool) -> [f32; 3] {
    [f32::from(u8::from(is_lit)); 3]
}

/// What arrives around each of sixteen lights of one pixel, one for each place in the lattice: the least and the most in
/// any channel, in light of one of them.
fn energy_by_place(diffuser: &mut Diffuser, material: u32) -> (f64, f64) {
    // Farther apart than most profiles reach at a millimetre per pixel; what goes beyond, a neighbour sends back.
    const APART: u32 = 96;
    let place = |number: u32| number * APART + APART / 2 + number;
    let is_place = |at: u32| (0..PERIOD).any(|number| place(number) == at);
    let buffers = Buffers::plane([APART * PERIOD; 2], material).lit(|x, y| light(is_place(x) && is_place(y)));
    let picture = drawn(diffuser, &SubsurfaceView::orthographic_distances(1.0), &buffers);
    let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
    for number in 0..PERIOD * PERIOD {
        let first = [number % PERIOD * APART, number / PERIOD * APART];
        let around = (0..APART * APART).map(|at| [first[0] + at % APART, first[1] + at / APART]);
        let mut energy = [0.0; 3];
        for pixel in around.map(|[x, y]| picture[buffers.index(x, y)]) {
            for (sum, channel) in energy.iter_mut().zip(pixel) {
                *sum += f64::from(channel);
            }
        }
        (least, most) = energy.into_iter().fold((least, most), |(a, b), sum| (a.min(sum), b.max(sum)));
    }
    (least, most)
}

#[test]
fn a_light_of_one_pixel_gives_as_much_wherever_it_lies() {
    let description = Description::all_profiles(KERNEL);
    let mut diffuser = Diffuser::new(&description, Path::Compute);
    let mut found = Vec::new();
    for (material, stem) in (0..).zip(&description.stems) {
        let (least, most) = energy_by_place(&mut diffuser, material);
        println!("{stem}: energy {least:.3} to {most:.3}");
        found.push((stem, least, most));
    }
    for (stem, least, most) in found {
        // The taps of 2×2 pixels in which a slice and its neighbours differ by one: a tap has a fiftieth of the light.
        assert!(least > 0.9 && most < 1.1, "{stem}: {least:.3} to {most:.3}");
    }
}

/// A disc of light whose middle lies `shift` pixels to the right of and below that of the frame.
fn disc(material: u32, shift: u32) -> Buffers {
    const SIDE: u32 = 96;
    let apart = |place: u32| f64::from(place) - f64::from(SIDE / 2 + shift);
    Buffers::plane([SIDE; 2], material).lit(|x, y| light(apart(x).hypot(apart(y)) < 3.5))
}

#[test]
fn a_pan_changes_little() {
    let description = Description::all_profiles(KERNEL);
    let mut diffuser = Diffuser::new(&description, Path::Compute);
    let view = SubsurfaceView::orthographic_distances(1.0);
    let mut found = Vec::new();
    let mut diffused = 0;
    for (material, stem) in (0..).zip(&description.stems) {
        let still = disc(material, 0);
        let first = drawn(&mut diffuser, &view, &still);
        diffused += usize::from(first[still.index(48, 48)][0] < 0.99);
        let mut change = 0.0_f32;
        for shift in 1..PERIOD {
            let panned = drawn(&mut diffuser, &view, &disc(material, shift));
            for (x, y) in (8..80).flat_map(|y| (8..80).map(move |x| (x, y))) {
                let (before, after) = (first[still.index(x, y)], panned[still.index(x + shift, y + shift)]);
                change =
                    (0..3).map(|channel| (before[channel] - after[channel]).abs()).fold(change, f32::max);
            }
        }
        println!("{stem}: a pan changes {change:.4} of white");
        found.push((stem, change));
    }
    // All but those that reach less than a pixel here.
    assert!(2 * diffused > found.len());
    for (stem, change) in found {
        // A tap more or less finds the disc: a sixtieth of the light, and up to 1.5 times that where the profile has more
        // than the density that the radii are drawn from.
        assert!(change < 0.028, "{stem}: {change:.4}");
    }
}

#[test]
fn a_hard_edge_close_up_leaves_no_discs() {
    const SIZE: [u32; 2] = [256, 24];
    const EDGE: u32 = SIZE[0] / 2;
    let view = SubsurfaceView::orthographic_distances(0.1);
    let buffers = Buffers::plane(SIZE, 0).lit(|x, _| light(x >= EDGE));
    let [picture, exact] = [KERNEL, Estimator::Dense]
        .map(|kernel| drawn(&mut Diffuser::new(&Description::pair(kernel), Path::Compute), &view, &buffers));
    // The dark side, but for what the frame's border renormalizes: how far a pixel is above twice what is right.
    let (mut excess, mut right) = (f32::NEG_INFINITY, 0.0);
    for (x, y) in (8..16).flat_map(|y| (16..EDGE - 16).map(move |x| (x, y))) {
        let at = buffers.index(x, y);
        for (drawn, exact) in picture[at].iter().zip(exact[at]).take(3) {
            if drawn - 2.0 * exact > excess {
                (excess, right) = (drawn - 2.0 * exact, exact);
            }
        }
    }
    println!("at most {excess:.4} above twice what is right, {right:.4}");
    // The farthest tap has a sixtieth of the light, up to 1.5 times that where the profile has more than the density that
    // the radii are drawn from: it finds the edge from where little is right.
    assert!(excess < 0.027, "{excess:.4} above twice what is right, {right:.4}");
}

/// A ball of `radius_mm`, 400 mm away, across which lie stripes of light of a mean free path.
fn ball(radius_mm: f64) -> (Buffers, SubsurfaceView) {
    const SIDE: u32 = 200;
    const DISTANCE_MM: f64 = 400.0;
    const FOV_Y_DEGREES: f32 = 12.0;
    let tangent = f64::from(0.5 * FOV_Y_DEGREES).to_radians().tan();
    // Where |t·(x, y, 1) − (0, 0, D)| is the radius.
    let seen = |x: u32, y: u32| {
        let along = |place: u32| (2.0 * (f64::from(place) + 0.5) / f64::from(SIDE) - 1.0) * tangent;
        let (x, y) = (along(x), along(y));
        let squared = x * x + y * y + 1.0;
        let inside =
            DISTANCE_MM * DISTANCE_MM - squared * (DISTANCE_MM * DISTANCE_MM - radius_mm * radius_mm);
        (inside >= 0.0).then(|| {
            let distance_mm = (DISTANCE_MM - inside.sqrt()) / squared;
            (distance_mm * (x + y), distance_mm)
        })
    };
    let is_lit = |across_mm: f64| (across_mm / MEAN_FREE_PATH_MM[0]).rem_euclid(2.0) < 1.0;
    let buffers = Buffers::plane([SIDE; 2], 0)
        .lit(|x, y| light(seen(x, y).is_some_and(|(across_mm, _)| is_lit(across_mm))))
        .covered(|x, y| if seen(x, y).is_some() { 0.0 } else { -1.0 })
        .distant(|x, y| seen(x, y).map_or(0.0, |(_, distance_mm)| distance_mm as f32));
    (buffers, SubsurfaceView::perspective_distances(FOV_Y_DEGREES.to_radians(), SIDE))
}

#[test]
fn no_pixel_of_a_balls_rim_is_left_as_it_was() {
    let [mut diffuser, mut dense] =
        [KERNEL, Estimator::Dense].map(|kernel| Diffuser::new(&Description::pair(kernel), Path::Compute));
    let mut found = Vec::new();
    for radius_mm in [10.0, 25.0, 40.0] {
        let (buffers, view) = ball(radius_mm);
        let [picture, exact] = [&mut diffuser, &mut dense].map(|kernel| drawn(kernel, &view, &buffers));
        let (mut left, mut worst) = (0, 0.0_f32);
        let pixels = picture.iter().zip(&exact).zip(&buffers.irradiance);
        for ((drawn, exact), before) in
            pixels.zip(&buffers.surface).filter_map(|(pixel, surface)| (surface[3] >= 0.0).then_some(pixel))
        {
            left += u32::from(drawn == before && exact != before);
            worst = (0..3).map(|channel| (drawn[channel] - exact[channel]).abs()).fold(worst, f32::max);
        }
        println!("ball of {radius_mm} mm: {left} pixels left as they were, worst pixel {worst:.3}");
        found.push((radius_mm, left, worst));
    }
    for (radius_mm, left, worst) in found {
        assert_eq!(left, 0, "ball of {radius_mm} mm");
        // A rim pixel lies deeper than all that its window mixes; where little is near, each of it counts for much.
        assert!(worst < 0.16, "ball of {radius_mm} mm: {worst:.3}");
    }
}
