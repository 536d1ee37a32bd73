//! Twin of `shaders/kernels/importance_sampled.wgsl`.

use std::f64::consts::TAU;

use subsurface_kernel::constants::GOLDEN_TURN;

use crate::angle::turned;
use crate::gather::gathered::{Gathered, Rgb, mixed};
use crate::gather::point::Point;
use crate::gather::tap::{Tap, pixel_at};
use crate::noise::interleaved_gradient_noise;
use crate::pictures::patch::Patch;
use crate::pictures::scene::Scene;

/// The taps of a pixel before it turns them.
#[derive(Debug)]
pub(crate) struct ImportanceSampled<'a> {
    point: Point<'a>,
    taps: Vec<Tap>,
}

impl<'a> ImportanceSampled<'a> {
    pub(crate) fn new(point: Point<'a>, taps: u32) -> Self {
        let count = point.footprint_taps(taps);
        let mut direction = [1.0, 0.0];
        let taps = (0..count).map(|tap| {
            let u = (f64::from(tap) + 0.5) / f64::from(count);
            let here = direction;
            direction = turned(direction, GOLDEN_TURN);
            Tap::new(&point, point.quantile(u), here)
        });
        Self { point, taps: taps.collect() }
    }

    /// A pixel of a patch.
    pub(crate) fn pixel(&self, scene: Scene, patch: Patch, pixel: [i32; 2]) -> Rgb {
        let [x, y] = patch.in_scene(pixel);
        let own = [scene.light(x, y); 3];
        let (sin, cos) = (TAU * interleaved_gradient_noise(pixel)).sin_cos();
        let depth = scene.depth(x, y);
        let mut gathered = Gathered::default();
        for tap in &self.taps {
            let [along, across] = tap.offset;
            let offset = [along * cos - across * sin, along * sin + across * cos];
            let [tap_x, tap_y] = pixel_at([f64::from(x), f64::from(y)], offset);
            if !scene.covers(tap_x, tap_y) {
                continue;
            }
            let apart = self.point.depth_pixels(scene.depth(tap_x, tap_y) - depth);
            gathered.add(tap.weight(&self.point, apart), [scene.light(tap_x, tap_y); 3]);
        }
        let share = 1.0 / f64::from(u32::try_from(self.taps.len().max(1)).unwrap_or(u32::MAX));
        let mut mean = Gathered::default();
        mean.add_share(&gathered, share);
        mixed(own, mean.diffused(own, self.point.returned), self.point.blend())
    }
}
