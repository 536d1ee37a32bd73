//! The light beyond a line, as kernels read it: the twin of `shaders/kernels/separable/edge_spread.wgsl`.

use subsurface_kernel::constants::EDGE_POWER;

use crate::gather::curve::{STEPS, fraction};

/// Shares of the light beyond a line at even steps of the root of its distance, and straight between.
#[derive(Debug)]
pub(crate) struct EdgeCurve {
    reach: f64,
    beyond: [f64; STEPS + 1],
}

impl EdgeCurve {
    /// The curve of `beyond` up to a distance.
    pub(crate) fn new(beyond: impl Fn(f64) -> f64, reach: f64) -> Self {
        let knot = |index: usize| beyond(reach * fraction(index).powi(EDGE_POWER));
        Self { reach, beyond: std::array::from_fn(knot) }
    }

    /// Share of the light beyond a line at this distance.
    pub(crate) fn at(&self, distance: f64) -> f64 {
        if distance >= self.reach {
            return 0.0;
        }
        let place = (distance / self.reach).max(0.0).sqrt().sqrt() * STEPS as f64;
        let step = (place as usize).min(STEPS - 1);
        let (start, end) = (self.beyond[step], self.beyond[step + 1]);
        start + (end - start) * (place - step as f64)
    }
}
