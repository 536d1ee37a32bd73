//! Twin of `shaders/kernels/separable.wgsl`.

pub(crate) mod edge_spread;

use std::collections::HashMap;
use std::f64::consts::FRAC_PI_2;

use subsurface_kernel::constants::SMALLEST_WEIGHT;

use crate::gather::gathered::{Gathered, Rgb, mixed};
use crate::gather::point::Point;
use crate::gather::tap::pixel_at;
use crate::noise::interleaved_gradient_noise;
use crate::pictures::patch::Patch;
use crate::pictures::scene::Scene;

/// The taps on one side of the centre.
#[derive(Debug)]
pub(crate) struct Separable<'a> {
    point: Point<'a>,
    rotated: bool,
    /// Share of the centre.
    centre: Rgb,
    taps: Vec<Strip>,
    /// Whether the footprint is worth any tap.
    is_on: bool,
}

/// A tap and its mirror image.
#[derive(Clone, Copy, Debug)]
struct Strip {
    offset: f64,
    /// Share of the light in the strip.
    share: Rgb,
    /// Share of the light beyond its tap.
    beyond: Rgb,
}

impl<'a> Separable<'a> {
    pub(crate) fn new(point: Point<'a>, taps: u32, rotated: bool) -> Self {
        let beyond = |offset: f64| point.beyond_line(offset);
        let sides = point.footprint_taps(taps.saturating_sub(1)).div_ceil(2);
        let offset = |tap: u32| {
            let step = f64::from(tap) / f64::from(sides.max(1));
            let pixels = (step * step * point.filter_radius_pixels).round_ties_even();
            pixels.max(f64::from(tap)) * point.pixel
        };
        let mut inner = beyond(0.5 * offset(1));
        let centre = inner.map(|beyond| 1.0 - 2.0 * beyond);
        let strips = (1..=sides).map(|tap| {
            let next = 0.5 * (offset(tap) + offset(tap + 1));
            let outer = if tap == sides { [0.0; 3] } else { beyond(next) };
            let share = std::array::from_fn(|channel| inner[channel] - outer[channel]);
            inner = outer;
            Strip { offset: offset(tap), share, beyond: beyond(offset(tap)) }
        });
        let taps = strips.collect();
        let is_on = point.footprint_taps(u32::MAX) > 0;
        Self { point, rotated, centre, taps, is_on }
    }

    /// The pixels of a patch.
    pub(crate) fn draw(&self, scene: Scene, patch: Patch) -> Vec<Rgb> {
        let mut first = HashMap::new();
        patch.pixels().map(|pixel| self.pixel(scene, patch, pixel, &mut first)).collect()
    }

    fn pixel(&self, scene: Scene, patch: Patch, pixel: [i32; 2], first: &mut HashMap<[i32; 2], Rgb>) -> Rgb {
        let [x, y] = patch.in_scene(pixel);
        let own = [scene.light(x, y); 3];
        if !self.is_on {
            return own;
        }
        let half_way = self.after_first(scene, patch, pixel, first);
        let [along_x, along_y] = self.axis(pixel);
        let second = [-along_y, along_x];
        let gathered =
            self.line(scene, patch, pixel, half_way, second, |at| self.after_first(scene, patch, at, first));
        mixed(own, gathered.diffused(half_way, self.point.returned), self.point.blend())
    }

    /// A pixel after the first pass.
    fn after_first(
        &self,
        scene: Scene,
        patch: Patch,
        pixel: [i32; 2],
        known: &mut HashMap<[i32; 2], Rgb>,
    ) -> Rgb {
        // Rows that are alike stay so where all pixels have the same axes.
        let key = if scene.has_equal_rows() && !self.rotated { [pixel[0], 0] } else { pixel };
        if let Some(light) = known.get(&key) {
            return *light;
        }
        let [x, y] = patch.in_scene(pixel);
        let own = [scene.light(x, y); 3];
        let light = |at: [i32; 2]| {
            let [x, y] = patch.in_scene(at);
            [scene.light(x, y); 3]
        };
        let gathered = self.line(scene, patch, pixel, own, self.axis(pixel), light);
        let light = gathered.diffused(own, self.point.returned);
        known.insert(key, light);
        light
    }

    /// Light along an axis through `pixel`; `light` tells what a pixel of the screen has.
    fn line(
        &self,
        scene: Scene,
        patch: Patch,
        pixel: [i32; 2],
        own: Rgb,
        axis: [f64; 2],
        mut light: impl FnMut([i32; 2]) -> Rgb,
    ) -> Gathered {
        let mut gathered = Gathered::default();
        gathered.add(self.centre, own);
        let depth = scene.depth(patch.in_scene(pixel)[0]);
        for strip in &self.taps {
            for side in [-1.0, 1.0] {
                let offset = axis.map(|component| side * strip.offset / self.point.pixel * component);
                let at = pixel_at(pixel.map(f64::from), offset);
                let apart = self.point.depth_pixels(scene.depth(patch.in_scene(at)[0]) - depth);
                gathered.add(self.weight(strip, apart), light(at));
            }
        }
        gathered
    }

    /// Weight of a tap that lies `depth` pixels deeper than the centre, or higher.
    fn weight(&self, strip: &Strip, depth: f64) -> Rgb {
        if depth == 0.0 {
            return strip.share;
        }
        let path = strip.offset.hypot(depth * self.point.pixel);
        let beyond = self.point.beyond_line(path);
        std::array::from_fn(|channel| {
            let left = beyond[channel] / strip.beyond[channel].max(SMALLEST_WEIGHT);
            strip.share[channel] * left.clamp(0.0, 1.0)
        })
    }

    fn axis(&self, pixel: [i32; 2]) -> [f64; 2] {
        if !self.rotated {
            return [1.0, 0.0];
        }
        let (sin, cos) = (FRAC_PI_2 * interleaved_gradient_noise(pixel)).sin_cos();
        [cos, sin]
    }
}
