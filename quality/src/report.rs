//! What the search found.

use subsurface_kernel::Estimator;

use crate::quality::Tier;

/// The kernel that a search has chosen, and its error.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct QualityReport {
    /// The cheapest kernel whose error is within what was asked for.
    pub estimator: Estimator,
    /// Its error: root mean square over the pixels of a picture, the largest over the pictures that this crate's
    /// documentation lists, at mean radii of 1 to 100 pixels, over channels and materials; a fraction of the white
    /// level, rounded up to three digits.
    pub error: f64,
    /// Largest difference of any one pixel in those pictures, a fraction of the white level.
    pub worst_pixel: f64,
    /// Tap counts of the same kernel for all tiers, the worst tier first.
    pub tiers: [TierReport; 4],
    /// The pictures one by one, each at its footprints.
    pub pictures: Vec<PictureReport>,
}

/// The error in one picture.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct PictureReport {
    /// `step edge`, `line`, `disc`, `crease`, `albedo edge`, `pixel`, `pan`, `ball` or `frame`.
    pub name: &'static str,
    /// Mean radius of the widest channel's profile, pixels.
    pub mean_radius_pixels: f64,
    /// Root mean square over its pixels, the largest over channels and materials, rounded up to three digits.
    pub error: f64,
    /// Largest difference of any one pixel.
    pub worst_pixel: f64,
}

/// An error as it is stated: three digits, rounded up, so that it remains a bound and is the same on every system.
pub(crate) fn stated(error: f64) -> f64 {
    if error <= 0.0 {
        return 0.0;
    }
    let digits = 2 - error.log10().floor() as i32;
    let scale = 10f64.powi(digits.clamp(0, 300));
    // What is a number of three digits already stays so.
    (error * scale - 1e-9).ceil() / scale
}

/// What a tier takes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct TierReport {
    /// The tier.
    pub tier: Tier,
    /// The fewest taps within its error; the best number of taps where none is.
    pub taps: u32,
    /// The error with that many, which is above the tier's own where none is within it.
    pub error: f64,
}
