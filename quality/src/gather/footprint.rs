//! How many taps a footprint is worth: the twin of `shaders/gather/footprint.wgsl`.

use std::f64::consts::TAU;

use subsurface_kernel::constants::{LARGEST_FILTER_RADIUS, LARGEST_TAP_COUNT};

use crate::gather::point::Point;

impl Point<'_> {
    /// Taps of a budget that the footprint is worth.
    pub(crate) fn footprint_taps(&self, budget: u32) -> u32 {
        if self.filter_radius_pixels < 1.0 {
            return 0;
        }
        let radius = self.filter_radius_pixels.min(LARGEST_FILTER_RADIUS);
        ((0.125 * TAU * radius * radius).ceil() as u32).min(budget.min(LARGEST_TAP_COUNT))
    }

    /// Share of the diffused light in the result.
    pub(crate) fn blend(&self) -> f64 {
        (self.filter_radius_pixels - 1.0).clamp(0.0, 1.0)
    }
}
