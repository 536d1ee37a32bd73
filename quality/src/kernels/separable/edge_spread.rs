//! The light beyond a line and the reach of its light, as kernels read them: the twin of
//! `shaders/kernels/separable/edge_spread.wgsl`.

use subsurface_kernel::constants::EDGE_POWER;

use crate::gather::curve::{Knots, STEPS, fraction, line_quantiles, quantile};

/// Shares of the light beyond a line at even steps of the root of its distance, and straight between.
#[derive(Debug)]
pub(crate) struct EdgeCurve {
    reach: f64,
    beyond: Knots,
    /// Distances within which a line keeps a share of its light.
    lines: Knots,
}

impl EdgeCurve {
    /// The curve of `beyond` up to a distance.
    pub(crate) fn new(beyond: impl Fn(f64) -> f64, reach: f64) -> Self {
        let knot = |index: usize| beyond(reach * fraction(index).powi(EDGE_POWER));
        let beyond = std::array::from_fn(knot);
        Self { reach, beyond, lines: line_quantiles(&beyond, reach) }
    }

    /// Distance on both sides of a line within which it keeps the share `inside` of its light.
    pub(crate) fn line_reach(&self, inside: f64) -> f64 {
        quantile(&self.lines, inside).0
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
