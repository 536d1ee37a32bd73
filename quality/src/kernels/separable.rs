//! Twin of `shaders/kernels/separable.wgsl`.

pub(crate) mod edge_spread;
pub(crate) mod strips;

use std::collections::HashMap;
use std::f64::consts::FRAC_PI_2;

use subsurface_kernel::constants::SMALLEST_WEIGHT;

use crate::gather::gathered::{Gathered, Rgb, mixed};
use crate::gather::point::Point;
use crate::gather::tap::pixel_at;
use crate::noise::interleaved_gradient_noise;
use crate::pictures::patch::Patch;
use crate::pictures::scene::Scene;
use strips::Strip;

/// The taps on one side of the centre.
#[derive(Debug)]
pub(crate) struct Separable<'a> {
    point: Point<'a>,
    rotated: bool,
    /// Share of the centre.
    centre: Rgb,
    taps: Vec<Tap>,
    /// Whether the footprint is worth any tap.
    is_on: bool,
}

/// The tap of a strip, and its mirror image.
#[derive(Clone, Copy, Debug)]
struct Tap {
    strip: Strip,
    /// Distance of the strip's middle.
    middle: f64,
    /// Light in the strip by the light beyond its middle.
    per_beyond: Rgb,
    /// Weight on a flat surface.
    flat_weight: Rgb,
}

impl<'a> Separable<'a> {
    pub(crate) fn new(point: Point<'a>, taps: u32, rotated: bool) -> Self {
        let sides = point.footprint_taps(taps.saturating_sub(1)).div_ceil(2);
        let mut inner = point.beyond_line(0.5 * point.pixel);
        let centre = inner.map(|beyond| 1.0 - 2.0 * beyond);
        let taps = strips::beside_centre(&point, 2.0 * inner[point.optics.widest], sides);
        let taps = (1..=sides).zip(taps).map(|(number, strip)| {
            let beyond = point.beyond_line(strip.end * point.pixel);
            let outer = if number == sides { [0.0; 3] } else { beyond };
            let share: Rgb = std::array::from_fn(|channel| inner[channel] - outer[channel]);
            inner = outer;
            let middle = 0.5 * (strip.start + strip.end) * point.pixel;
            let beyond = point.beyond_line(middle);
            let per_beyond: Rgb =
                std::array::from_fn(|channel| share[channel] / beyond[channel].max(SMALLEST_WEIGHT));
            let flat_weight = std::array::from_fn(|channel| per_beyond[channel] * beyond[channel]);
            Tap { strip, middle, per_beyond, flat_weight }
        });
        let taps = taps.collect();
        let is_on = point.footprint_taps(u32::MAX) > 0;
        Self { point, rotated, centre, taps, is_on }
    }

    /// A pixel of a patch, whose other pixels are known to `on` by the surface that they show; `first` keeps what the first
    /// pass has made of pixels.
    pub(crate) fn pixel<'s>(
        &self,
        on: &impl Fn([i32; 2]) -> &'s Self,
        scene: Scene,
        patch: Patch,
        pixel: [i32; 2],
        first: &mut HashMap<[i32; 2], Rgb>,
    ) -> Rgb
    where
        'a: 's,
    {
        let [x, y] = patch.in_scene(pixel);
        let own = [scene.light(x, y); 3];
        if !self.is_on {
            return own;
        }
        let half_way = self.after_first(scene, patch, pixel, first);
        let [along_x, along_y] = self.axis(pixel);
        let second = [-along_y, along_x];
        let gathered = self
            .line(scene, patch, pixel, half_way, second, |at| on(at).after_first(scene, patch, at, first));
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
        let depth_at = |at: [i32; 2]| {
            let [x, y] = patch.in_scene(at);
            scene.covers(x, y).then(|| scene.depth(x, y))
        };
        let depth = depth_at(pixel).unwrap_or_default();
        for (tap, side) in self.taps.iter().flat_map(|tap| [(tap, -1.0), (tap, 1.0)]) {
            let lines = tap.strip.lines.map(|line| {
                let at = pixel_at(pixel.map(f64::from), axis.map(|component| side * line * component));
                (at, depth_at(at))
            });
            let found = || lines.into_iter().filter_map(|(at, deep)| deep.map(|deep| (at, deep - depth)));
            let count = found().count() as f64;
            let squares = found().map(|(_, apart)| self.point.depth_pixels(apart).powi(2)).sum::<f64>();
            for (at, _) in found() {
                let weight = self.weight(tap, squares / count);
                gathered.add(weight.map(|weight| 0.5 * weight), light(at));
            }
        }
        gathered
    }

    /// Weight of a tap whose lines lie deeper than the centre or higher, with this mean square of the depth in pixels.
    fn weight(&self, tap: &Tap, squared_depth: f64) -> Rgb {
        if squared_depth == 0.0 {
            return tap.flat_weight;
        }
        let squared_lines = 0.5 * tap.strip.lines.map(|line| line * line).iter().sum::<f64>();
        let beyond = self.point.beyond_line(tap.middle * (1.0 + squared_depth / squared_lines).sqrt());
        std::array::from_fn(|channel| tap.per_beyond[channel] * beyond[channel])
    }

    fn axis(&self, pixel: [i32; 2]) -> [f64; 2] {
        if !self.rotated {
            return [1.0, 0.0];
        }
        let (sin, cos) = (FRAC_PI_2 * interleaved_gradient_noise(pixel)).sin_cos();
        [cos, sin]
    }
}
