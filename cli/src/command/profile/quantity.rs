//! What a figure shows of a profile.

use super::curve::{Curve, rings};
use crate::plot::Axis;
use clap::ValueEnum;
use std::f64::consts::TAU;
use subsurface_profile::RadialData;

/// What the vertical axis shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Quantity {
    /// r·R(r), linear: what is integrated over the surface.
    #[default]
    RReflectance,
    /// R(r), logarithmic: how the profile falls off.
    Reflectance,
    /// The share of the reflected energy that leaves within r.
    Cdf,
    /// The radius for a uniform random number: the inverse of the former.
    InverseCdf,
    /// 2πr·R(r)/A less that of the truth: the area between the curve and 0 is the L1 of `profile compare`.
    Residual,
}

/// The unit of every length in a figure.
const MFP: &str = "mean free path";

/// Points of a curve: more than a figure has pixels between bends.
const STEPS: u32 = 480;

/// The largest u that is drawn: the radii beyond have no end.
const LARGEST_U: f64 = 0.995;

impl Quantity {
    /// What the figure is called.
    pub(super) fn title(self) -> &'static str {
        match self {
            Self::RReflectance => "r·R(r)",
            Self::Reflectance => "R(r)",
            Self::Cdf => "Cumulative distribution",
            Self::InverseCdf => "Inverse of the cumulative distribution",
            Self::Residual => "Residual of 2πr·R(r)/A",
        }
    }

    /// The share of the energy that the figure's radii enclose, unless the user says how far they go.
    pub(super) fn quantile(self) -> f64 {
        match self {
            Self::RReflectance => 0.95,
            Self::Cdf | Self::Residual => 0.99,
            Self::InverseCdf => LARGEST_U,
            Self::Reflectance => 0.998,
        }
    }

    /// The horizontal axis for radii up to `end`; `low` is where a logarithmic axis begins.
    pub(super) fn x_axis(self, end: f64, low: Option<f64>) -> Axis {
        if self == Self::InverseCdf {
            return Axis::linear("u, the share of the energy that leaves within r", 0.0, 1.0);
        }
        let label = format!("r ({MFP}s)");
        match low {
            Some(low) => Axis::log(label, low, end),
            None => Axis::linear(label, 0.0, end),
        }
    }

    /// The vertical axis over points of the truth and of the curves, for radii up to `end`.
    pub(super) fn y_axis(self, truth_points: &[(f64, f64)], curves: &[(f64, f64)], end: f64) -> Axis {
        let finite = |points: &[(f64, f64)]| -> Vec<f64> {
            points.iter().map(|point| point.1).filter(|y| y.is_finite()).collect()
        };
        let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
        let (truth, curves) = (finite(truth_points), finite(curves));
        // A curve far off must not press the truth flat.
        let top = largest(&curves).min(2.0 * largest(&truth)).max(largest(&truth));
        match self {
            Self::RReflectance => Axis::linear(format!("r·R(r) (1/{MFP})"), 0.0, top).with_round_end(),
            Self::Reflectance => {
                let smallest = truth.iter().copied().filter(|y| *y > 0.0).fold(f64::INFINITY, f64::min);
                let low = 10f64.powf(smallest.log10().floor());
                // R is infinite at 0: the figure shows what lies a hundredth of its width away from there.
                let near = truth_points.iter().filter(|point| point.0 > 0.01 * end).map(|point| point.1);
                let high = near.fold(low, f64::max);
                Axis::log(format!("R(r) (1/{MFP}²)"), low, high).with_round_end()
            }
            Self::Cdf => Axis::linear("share of the energy that leaves within r", 0.0, 1.0),
            Self::InverseCdf => Axis::linear(format!("r ({MFP}s)"), 0.0, end).with_round_end(),
            Self::Residual => {
                let size = curves.iter().map(|y| y.abs()).fold(0.0, f64::max).max(1e-6);
                let end = Axis::linear("", 0.0, size).with_round_end().high;
                Axis::linear(format!("2πr·R/A − truth (1/{MFP})"), -end, end)
            }
        }
    }

    /// The points of a curve along `x`; the residual needs the truth's table.
    pub(super) fn curve(self, curve: &Curve, x: &Axis, truth: &RadialData) -> Vec<(f64, f64)> {
        if self == Self::Residual {
            let residual = |bin: &subsurface_profile::RadialRow| {
                let density = TAU * bin.r_reflectance / truth.surface_albedo();
                (0.5 * (bin.r_lo + bin.r_hi), curve.mean_density(bin.r_lo, bin.r_hi) - density)
            };
            return truth.bins().iter().map(residual).collect();
        }
        let value = |x: f64| match self {
            Self::RReflectance => curve.r_reflectance(x),
            // The profile may be infinite at 0, which is no point of a figure.
            Self::Reflectance => curve.reflectance(x).min(f64::MAX),
            Self::Cdf => curve.cdf(x),
            _ => curve.inverse_cdf(x),
        };
        let positions = (0..=STEPS).map(|step| x.value(f64::from(step) / f64::from(STEPS)));
        positions
            .filter(|x| self != Self::InverseCdf || *x <= LARGEST_U)
            .map(|x| (x, value(x)))
            .filter(|(_, y)| self != Self::Reflectance || *y > 0.0)
            .collect()
    }

    /// The points of the truth with radii up to `end`, and one beyond, so that a line reaches the frame.
    pub(super) fn truth(self, truth: &RadialData, end: f64) -> Vec<(f64, f64)> {
        let point = |(bin, cdf): (subsurface_profile::RadialRow, f64)| {
            let middle = 0.5 * (bin.r_lo + bin.r_hi);
            match self {
                Self::RReflectance => (middle, bin.r_reflectance),
                Self::Reflectance => (middle, bin.r_reflectance / middle),
                Self::Cdf => (bin.r_hi, cdf),
                Self::InverseCdf => (cdf, bin.r_hi),
                Self::Residual => (middle, 0.0),
            }
        };
        rings(truth)
            .filter(|(bin, cdf)| bin.r_lo < end && (self != Self::InverseCdf || *cdf <= LARGEST_U))
            .map(point)
            .filter(|(_, y)| self != Self::Reflectance || *y > 0.0)
            .collect()
    }

    /// One standard error of the truth to each side, as the outline of an area around 0; for the residual alone.
    pub(super) fn noise(truth: &RadialData) -> Vec<(f64, f64)> {
        let bins = truth.bins();
        let side = |sign: f64| {
            let error = move |bin: &subsurface_profile::RadialRow| {
                let error = bin.standard_error.unwrap_or(0.0);
                (0.5 * (bin.r_lo + bin.r_hi), sign * TAU * error / truth.surface_albedo())
            };
            bins.iter().map(error).collect::<Vec<_>>()
        };
        side(1.0).into_iter().chain(side(-1.0).into_iter().rev()).collect()
    }
}
