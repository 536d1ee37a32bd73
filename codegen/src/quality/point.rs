//! A material at a footprint: the twin of `SurfacePoint` in `shaders/gather/point.wgsl`.

use std::f64::consts::TAU;
use subsurface_kernel::constants::{FILTER_QUANTILE, LARGEST_WEIGHT};

use super::gathered::Rgb;
use super::optics::{Optics, quantile};

/// A material at a footprint. Lengths without a unit in their name are in that of the optics.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point<'a> {
    pub(super) optics: &'a Optics,
    /// Length that a pixel spans.
    pub(super) pixel: f64,
    /// Radius that holds nearly all of the widest channel's light, pixels.
    pub(super) filter_radius_pixels: f64,
    /// Whether depth counts in distances.
    pub(super) in_depth: bool,
    /// Whether missing energy is returned to the pixel.
    pub(super) returned: bool,
}

impl<'a> Point<'a> {
    pub(super) fn new(optics: &'a Optics, mean_radius_pixels: f64, in_depth: bool, returned: bool) -> Self {
        let pixel = optics.mean_radius / mean_radius_pixels;
        let radius = quantile(&optics.channels[optics.widest].curve, FILTER_QUANTILE).0;
        Self { optics, pixel, filter_radius_pixels: radius / pixel, in_depth, returned }
    }

    /// Taps of a budget that the footprint is worth.
    pub(super) fn footprint_taps(&self, budget: u32) -> u32 {
        if self.filter_radius_pixels < 1.0 {
            return 0;
        }
        // 4096: the shaders' bound of loops.
        let radius = self.filter_radius_pixels.min(4096.0);
        ((0.125 * TAU * radius * radius).ceil() as u32).min(budget.min(4096))
    }

    /// Share of the diffused light in the result.
    pub(super) fn blend(&self) -> f64 {
        (self.filter_radius_pixels - 1.0).clamp(0.0, 1.0)
    }

    /// (radius, its derivative by u) of the widest channel at the quantile `u`.
    pub(super) fn quantile(&self, u: f64) -> (f64, f64) {
        quantile(&self.optics.channels[self.optics.widest].curve, u)
    }

    /// Density per area at a radius > 0.
    pub(super) fn area_pdf(&self, radius: f64) -> Rgb {
        self.optics.densities.at(radius)
    }

    /// Fraction of the light within a radius.
    pub(super) fn radial_cdf(&self, radius: f64) -> Rgb {
        [0, 1, 2].map(|channel: usize| self.optics.channels[channel].profile.radial_cdf(radius))
    }

    /// Fraction of the light beyond a line at a distance, as the kernels read it.
    pub(super) fn beyond_line(&self, distance: f64) -> Rgb {
        [0, 1, 2].map(|channel: usize| self.optics.channels[channel].edge_curve.at(distance))
    }

    /// Pixels of depth as they count in distances.
    pub(super) fn depth_pixels(&self, apart: f64) -> f64 {
        if self.in_depth { apart } else { 0.0 }
    }
}

/// A tap at a radius that was drawn from a profile.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tap {
    radius: f64,
    /// Where it is, pixels.
    pub(super) offset: [f64; 2],
    /// 1 / p(r) = 2πr dr/du.
    per_density: f64,
    /// Its weight on a flat surface.
    flat_weight: Rgb,
}

impl Tap {
    /// The tap of a quantile (radius, its derivative by u) in a direction.
    pub(super) fn new(point: &Point<'_>, (radius, slope): (f64, f64), direction: [f64; 2]) -> Self {
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

    /// Its weight where it lies `depth` pixels deeper than the point, or higher.
    pub(super) fn weight(&self, point: &Point<'_>, depth: f64) -> Rgb {
        if depth == 0.0 {
            return self.flat_weight;
        }
        let depth = depth * point.pixel;
        let path = (self.radius * self.radius + depth * depth).sqrt();
        point.area_pdf(path).map(|density| weight(density, self.per_density))
    }
}

fn weight(density: f64, per_density: f64) -> f64 {
    (density * per_density).min(LARGEST_WEIGHT)
}

/// cos and sin of the golden angle π (3 - √5).
const GOLDEN_TURN: [f64; 2] = [-0.737_368_878_078_319_8, 0.675_490_294_261_524_1];

/// `direction` turned by the golden angle.
pub(super) fn turned([x, y]: [f64; 2]) -> [f64; 2] {
    [x * GOLDEN_TURN[0] - y * GOLDEN_TURN[1], x * GOLDEN_TURN[1] + y * GOLDEN_TURN[0]]
}

/// 1.5 · 2^52: what is added to this is rounded to whole numbers, ties to even as in WGSL, and without a call.
const TO_WHOLE: f64 = 6_755_399_441_055_744.0;

/// The pixel that `offset` from `position` falls on.
pub(super) fn pixel_at(position: [f64; 2], offset: [f64; 2]) -> [i32; 2] {
    // Far beyond any feature, and exact.
    let place = |axis: usize| {
        let place = (position[axis] + offset[axis]).clamp(-32768.0, 32768.0);
        ((place + TO_WHOLE) - TO_WHOLE) as i32
    };
    [place(0), place(1)]
}

/// Interleaved gradient noise of a pixel in a still picture, see `shaders/lib/noise.wgsl`.
pub(super) fn interleaved_gradient_noise([x, y]: [i32; 2]) -> f64 {
    let dot = 0.067_110_56 * f64::from(x) + 0.005_837_15 * f64::from(y);
    (52.982_918_9 * dot.fract()).fract()
}
