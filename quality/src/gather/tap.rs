//! Taps: the twin of `shaders/gather/tap.wgsl`.

use std::f64::consts::TAU;

use subsurface_kernel::constants::{LARGEST_TAP_DISTANCE, LARGEST_WEIGHT};

use crate::gather::gathered::Rgb;
use crate::gather::point::Point;

/// A tap at a radius that was drawn from a profile.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tap {
    radius: f64,
    /// Where it is, pixels.
    pub(crate) offset: [f64; 2],
    /// 1 / p(r) = 2πr dr/du.
    per_density: f64,
    /// Its weight on a flat surface.
    flat_weight: Rgb,
}

impl Tap {
    /// The tap of a quantile (radius, its derivative by u) in a direction.
    pub(crate) fn new(point: &Point<'_>, (radius, slope): (f64, f64), direction: [f64; 2]) -> Self {
        let radius_pixels = radius / point.pixel;
        let per_density = TAU * radius * slope;
        Self {
            radius,
            offset: direction.map(|component| radius_pixels * component),
            per_density,
            // Close to the centre, where profiles diverge, no table holds them.
            flat_weight: [0, 1, 2].map(|channel: usize| {
                weight(point.optics.channels[channel].profile.area_pdf(radius), per_density)
            }),
        }
    }

    /// The same, read where its square radius is less by `blur` pixels².
    pub(crate) fn narrowed(self, blur: f64) -> Self {
        let [x, y] = self.offset;
        let squared = x * x + y * y;
        let narrower = (1.0 - blur / squared).max(0.0).sqrt();
        Self { offset: self.offset.map(|component| narrower * component), ..self }
    }

    /// Its weight where it lies `depth` pixels deeper than the point, or higher.
    pub(crate) fn weight(&self, point: &Point<'_>, depth: f64) -> Rgb {
        if depth == 0.0 {
            return self.flat_weight;
        }
        let depth = depth * point.pixel;
        let squared = self.radius * self.radius + depth * depth;
        point.area_pdf_at_squared(squared).map(|density| weight(density, self.per_density))
    }
}

fn weight(density: f64, per_density: f64) -> f64 {
    (density * per_density).min(LARGEST_WEIGHT)
}

/// 1.5 · 2^52: what is added to this is rounded to whole numbers, ties to even as in WGSL, and without a call.
const TO_WHOLE: f64 = 6_755_399_441_055_744.0;

/// The pixel that `offset` from `position` falls on.
pub(crate) fn pixel_at(position: [f64; 2], offset: [f64; 2]) -> [i32; 2] {
    let place = |axis: usize| {
        let place = (position[axis] + offset[axis]).clamp(-LARGEST_TAP_DISTANCE, LARGEST_TAP_DISTANCE);
        ((place + TO_WHOLE) - TO_WHOLE) as i32
    };
    [place(0), place(1)]
}
