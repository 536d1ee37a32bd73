//! The reference kernel against the same sum in f64.

use crate::buffers::{Buffers, DISTANCE_MM, noise};
use crate::exact::own_share;
use crate::gpu::model;
use crate::setup::{Description, Diffuser, MEAN_FREE_PATH_MM, widest_radius_mm};
use subsurface_codegen::Estimator;
use subsurface_profile::{Channel, Medium, RadialProfile};
use subsurface_runtime::{Path, SubsurfaceView};

const SIZE: [u32; 2] = [20, 18];
const MILLIMETRES_PER_PIXEL: f64 = 0.4;

/// Light of one channel at a pixel, Liang et al. 2023, eq. (22), over all pixels of the receiver's material.
fn diffused(
    buffers: &Buffers,
    at: [u32; 2],
    channel: usize,
    profile: &dyn RadialProfile,
    filter_radius_mm: f64,
) -> f64 {
    let centre = buffers.index(at[0], at[1]);
    let (mut sum, mut weights) = (0.0, 0.0);
    for y in 0..SIZE[1] {
        for x in 0..SIZE[0] {
            let index = buffers.index(x, y);
            let (dx, dy) = (f64::from(x) - f64::from(at[0]), f64::from(y) - f64::from(at[1]));
            // The kernel ends at whole pixels.
            if buffers.surface[index][3] != buffers.surface[centre][3]
                || dx.hypot(dy) > (filter_radius_mm / MILLIMETRES_PER_PIXEL).ceil()
            {
                continue;
            }
            let depth_mm = f64::from(buffers.distance_mm[index]) - f64::from(buffers.distance_mm[centre]);
            let share = if index == centre {
                own_share(profile, MILLIMETRES_PER_PIXEL)
            } else {
                pixel_share(profile, [dx, dy], depth_mm)
            };
            sum += share * f64::from(buffers.irradiance[index][channel]);
            weights += share;
        }
    }
    sum / weights
}

/// Integral of a profile over a pixel that lies `depth_mm` deeper.
fn pixel_share(profile: &dyn RadialProfile, [dx, dy]: [f64; 2], depth_mm: f64) -> f64 {
    let points = if dx.abs().max(dy.abs()) < 3.0 { 8 } else { 1 };
    let place = |index: i32| (f64::from(index) + 0.5) / f64::from(points) - 0.5;
    let sum: f64 = (0..points * points)
        .map(|index| {
            let (x, y) = (dx + place(index % points), dy + place(index / points));
            profile.area_pdf((MILLIMETRES_PER_PIXEL * x.hypot(y)).hypot(depth_mm))
        })
        .sum();
    sum * (MILLIMETRES_PER_PIXEL / f64::from(points)).powi(2)
}

#[test]
fn dense_is_the_sum_over_all_pixels() {
    let description = Description::all_profiles(Estimator::Dense);
    let mut diffuser = Diffuser::new(&description, Path::Compute);
    for (material, stem) in (0..).zip(&description.stems) {
        let other = (material + 1) % description.stems.len() as u32;
        // Two materials, two shades of each, rough depth.
        let shade = |x: u32, channel: usize| if x < SIZE[0] / 2 { 0.3 } else { 0.2 * channel as f32 + 0.4 };
        let buffers = Buffers::plane(SIZE, material)
            .lit(|x, y| [0, 1, 2].map(|salt| noise(x, y, salt)))
            .coloured(|x, _| [0, 1, 2].map(|channel| shade(x, channel)))
            .covered(|x, y| if noise(x, y, 3) < 0.2 { other } else { material } as f32)
            .distant(|x, y| DISTANCE_MM + 0.8 * noise(x / 3, y / 3, 4) + 0.1 * x as f32);
        let view = SubsurfaceView::orthographic_distances(MILLIMETRES_PER_PIXEL as f32);
        let picture = diffuser.diffuse(&view, &buffers);
        let model = model(stem);
        let mut worst = 0.0_f64;
        for y in (0..SIZE[1]).step_by(3) {
            for x in 0..SIZE[0] {
                let index = buffers.index(x, y);
                if buffers.surface[index][3] != material as f32 {
                    continue;
                }
                let profiles = Channel::ALL.map(|channel| {
                    let surface_albedo = f64::from(shade(x, channel.index()));
                    let medium = Medium::new(surface_albedo, MEAN_FREE_PATH_MM[channel.index()]);
                    model.profile(medium.expect("in the domain"), channel).expect("a published model")
                });
                let reach = profiles.iter().map(|profile| profile.filter_radius(0.999)).fold(0.0, f64::max);
                for (channel, profile) in profiles.iter().enumerate() {
                    let expected = diffused(&buffers, [x, y], channel, &**profile, reach);
                    worst = worst.max((f64::from(picture[index][channel]) - expected).abs());
                }
            }
        }
        println!("Dense, {stem}: worst error against the sum in f64 {worst:.1e}");
        // Irradiance is within 0 and 1. The shader integrates pixels near the centre with 4×4 points, this test with
        // 8×8, and its reach comes from straight pieces of the quantile.
        assert!(worst < 4e-3, "{stem}: {worst}");
    }
}

#[test]
fn dense_sums_every_pixel_within_its_largest_radius() {
    const LARGEST: u32 = 120;
    const SIZE: [u32; 2] = [2 * LARGEST + 1; 2];
    let description = Description::affordable(Estimator::Dense);
    let mut diffuser = Diffuser::new(&description, Path::Compute);
    for (material, stem) in (0..).zip(&description.stems) {
        // All pixels but the one in the middle have filters of less than a pixel: they send light, and sum none.
        let plane =
            Buffers::plane(SIZE, material).scaled(|x, y| if [x, y] == [LARGEST; 2] { 1.0 } else { 1e-3 });
        let millimetres_per_pixel = widest_radius_mm(stem, 0.99) / f64::from(LARGEST);
        let view = SubsurfaceView::orthographic_distances(millimetres_per_pixel as f32);
        let mut middle = |light: &dyn Fn(u32, u32) -> f32| -> [f32; 3] {
            let buffers = plane.clone().lit(|x, y| [light(x, y); 3]);
            let [red, green, blue, _] = diffuser.diffuse(&view, &buffers)[buffers.index(LARGEST, LARGEST)];
            [red, green, blue]
        };
        // By symmetry half of the light arrives: less, where a driver ends the sum's loops before the last rows.
        let half = middle(&|_, y| if y == LARGEST { 0.5 } else { f32::from(y > LARGEST) });
        println!("Dense, {stem}: half the plane gives {half:.5?}");
        // 45,000 roundings of a sum of at most 1, a random walk of 6e-8 each, are 1.3e-5; rounding to a side, as of
        // many terms that are alike, makes more of them. Measured: 1e-5.
        assert!(half.iter().all(|light| (light - 0.5).abs() < 2e-4), "{stem}: {half:?}");
        // The disc touches the frame's border in the middle of each side, and leaves out its corners.
        let borders: [&dyn Fn(u32, u32) -> bool; 4] =
            [&|x, _| x == 0, &|x, _| x == 2 * LARGEST, &|_, y| y == 0, &|_, y| y == 2 * LARGEST];
        for (side, border) in borders.into_iter().enumerate() {
            let light = middle(&|x, y| f32::from(border(x, y)));
            assert!(light.iter().any(|&light| light > 0.0), "{stem}: side {side} is not summed");
        }
        let is_beyond =
            |x: u32, y: u32| x.abs_diff(LARGEST).pow(2) + y.abs_diff(LARGEST).pow(2) > LARGEST.pow(2);
        let beyond = middle(&|x, y| f32::from(is_beyond(x, y)));
        assert_eq!(beyond, [0.0; 3], "{stem}: corners are summed");
    }
}
