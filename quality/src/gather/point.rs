//! A material at a footprint: the twin of `SurfacePoint` in `shaders/gather/point.wgsl`.

use subsurface_kernel::constants::FILTER_QUANTILE;

use crate::gather::curve::quantile;
use crate::gather::gathered::Rgb;
use crate::optics::Optics;
use crate::pictures::scene::Surface;

/// A material at a footprint. Lengths without a unit in their name are in that of the optics.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point<'a> {
    pub(crate) optics: &'a Optics,
    /// Length that a pixel spans.
    pub(crate) pixel: f64,
    /// Radius that holds nearly all of the widest channel's light, pixels.
    pub(crate) filter_radius_pixels: f64,
    /// Whether depth counts in distances.
    pub(crate) in_depth: bool,
    /// Whether missing energy is returned to the pixel.
    pub(crate) returned: bool,
}

impl<'a> Point<'a> {
    pub(crate) fn new(optics: &'a Optics, mean_radius_pixels: f64, in_depth: bool, returned: bool) -> Self {
        Self::of_pixel(optics, optics.mean_radius / mean_radius_pixels, in_depth, returned)
    }

    /// The point where a pixel spans `pixel`.
    fn of_pixel(optics: &'a Optics, pixel: f64, in_depth: bool, returned: bool) -> Self {
        let radius = quantile(&optics.channels[optics.widest].curve, FILTER_QUANTILE).0;
        Self { optics, pixel, filter_radius_pixels: radius / pixel, in_depth, returned }
    }

    /// The same place where it shows another surface.
    pub(crate) fn on(&self, surface: Surface) -> Self {
        let others = self.optics.others.as_deref();
        let optics = surface.place().zip(others).map_or(self.optics, |(place, others)| &others[place]);
        Self::of_pixel(optics, self.pixel, self.in_depth, self.returned)
    }

    /// (radius, its derivative by u) of the widest channel at the quantile `u`.
    pub(crate) fn quantile(&self, u: f64) -> (f64, f64) {
        quantile(&self.optics.channels[self.optics.widest].curve, u)
    }

    /// Density per area at the root of a squared radius > 0.
    pub(crate) fn area_pdf_at_squared(&self, squared: f64) -> Rgb {
        self.optics.densities.at_squared(squared)
    }

    /// Fraction of the light within a radius.
    pub(crate) fn radial_cdf(&self, radius: f64) -> Rgb {
        [0, 1, 2].map(|channel: usize| self.optics.channels[channel].profile.radial_cdf(radius))
    }

    /// Fraction of the light beyond a line at a distance, as the kernels read it.
    pub(crate) fn beyond_line(&self, distance: f64) -> Rgb {
        [0, 1, 2].map(|channel: usize| self.optics.channels[channel].edge_curve.at(distance))
    }

    /// Pixels of depth as they count in distances.
    pub(crate) fn depth_pixels(&self, apart: f64) -> f64 {
        if self.in_depth { apart } else { 0.0 }
    }
}
