//! Twin of `shaders/kernels/interleaved/near.wgsl`: the shares of a pixel and its eight neighbours.

use subsurface_kernel::constants::{
    HALF_LOG_3_OF_2, NEAR_RADIUS_PIXELS, RING_RADIUS_PIXELS, SMALLEST_WEIGHT,
};

use crate::gather::gathered::Rgb;
use crate::gather::point::Point;

/// Shares of the light on a flat surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PixelShares {
    /// Of the pixel itself.
    pub(crate) centre: Rgb,
    /// Of each pixel beside it.
    pub(crate) beside: Rgb,
    /// Of each pixel across its corners.
    pub(crate) across: Rgb,
}

impl PixelShares {
    pub(crate) fn new(point: &Point<'_>) -> Self {
        let centre = point.radial_cdf(NEAR_RADIUS_PIXELS * point.pixel);
        let inside = point.radial_cdf(RING_RADIUS_PIXELS * point.pixel);
        let blend = point.blend();
        let mut shares = Self { centre: [0.0; 3], beside: [0.0; 3], across: [0.0; 3] };
        for channel in 0..3 {
            let own = 1.0 + blend * (centre[channel] - 1.0);
            let ring = blend * (inside[channel] - centre[channel]);
            let growth = (own + ring) / own.max(SMALLEST_WEIGHT);
            let across = 0.5 * growth.powf(HALF_LOG_3_OF_2);
            let beside = ring / (4.0 + 4.0 * across);
            shares.centre[channel] = own;
            shares.beside[channel] = beside;
            shares.across[channel] = beside * across;
        }
        shares
    }
}
