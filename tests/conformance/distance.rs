//! How far a profile is from the truth, in one number.

use std::f64::consts::PI;

use subsurface_profile::RadialProfile;
use subsurface_reference::{RadialBin, RadialTable};

/// How the radii are spaced over which an error is averaged: it decides what the mean says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Spacing {
    /// Even in r.
    Even,
    /// Even in ln r.
    Logarithmic,
}

/// A theory or a model as the mean of r·R over a ring from its inner to its outer radius, mean free paths.
pub(crate) type RingMean<'a> = &'a dyn Fn(f64, f64) -> f64;

/// Σ wᵢ |pᵢ - tᵢ| over the rings of the truth, p and t being means of r·R.
pub(crate) struct Distance<'a> {
    truth: &'a [RadialBin],
    weights: Vec<f64>,
}

impl<'a> Distance<'a> {
    /// The mean of |R/T - 1| over radii so spaced between the two ends of `range`.
    pub(crate) fn mean_relative_error(
        table: &'a RadialTable,
        spacing: Spacing,
        range: [f64; 2],
    ) -> Distance<'a> {
        let weight = |bin: &RadialBin| {
            let (lo, hi) = (bin.r_lo.max(range[0]), bin.r_hi.min(range[1]));
            match spacing {
                _ if lo >= hi => 0.0,
                Spacing::Even => hi - lo,
                Spacing::Logarithmic => (hi / lo).ln(),
            }
        };
        let sum: f64 = table.bins.iter().map(weight).sum();
        // The whole ring on both sides, though a part of it counts: within a ring the ratio does not change.
        let relative = |bin: &RadialBin| match weight(bin) {
            0.0 => 0.0,
            weight => weight / sum / bin.r_reflectance,
        };
        Distance { truth: &table.bins, weights: table.bins.iter().map(relative).collect() }
    }

    /// ∫ |p - t| dr of 2πr·R/A, over the range of the truth.
    pub(crate) fn l1(table: &'a RadialTable) -> Distance<'a> {
        let width = |bin: &RadialBin| 2.0 * PI * (bin.r_hi - bin.r_lo) / table.surface_albedo;
        Distance { truth: &table.bins, weights: table.bins.iter().map(width).collect() }
    }

    /// The distance of a theory or a model.
    pub(crate) fn of(&self, ring: RingMean<'_>) -> f64 {
        self.of_rings(|index| ring(self.truth[index].r_lo, self.truth[index].r_hi))
    }

    /// The distance of the mean of r·R that each ring has by its number.
    pub(crate) fn of_rings(&self, ring: impl Fn(usize) -> f64) -> f64 {
        let mut sum = 0.0;
        for (index, (bin, weight)) in self.truth.iter().zip(&self.weights).enumerate() {
            if *weight > 0.0 {
                sum += weight * (ring(index) - bin.r_reflectance).abs();
            }
        }
        sum
    }
}

/// Mean of r·R over a ring of a profile whose unit of length is the mean free path.
pub(crate) fn ring_mean(profile: &dyn RadialProfile, r_lo: f64, r_hi: f64) -> f64 {
    let energy = if profile.radial_cdf(r_lo) < 0.5 {
        profile.radial_cdf(r_hi) - profile.radial_cdf(r_lo)
    } else {
        profile.radial_tail(r_lo) - profile.radial_tail(r_hi)
    };
    profile.surface_albedo() * energy / (2.0 * PI * (r_hi - r_lo))
}
