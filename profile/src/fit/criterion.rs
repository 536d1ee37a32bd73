//! What a fit makes small.

use std::f64::consts::PI;

use crate::deviation::{energy_between, r_reflectance};
use crate::{RadialData, RadialProfile, RadialRow};

use super::{Crop, FitError};

/// Which measure of a profile is compared. They are not exchangeable: each weighs other radii.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// r·R(r), which \[L23\] fits. Bright surface albedos count more than dark ones.
    RReflectance,
    /// 2πr·R(r)/A: the density of the exit radius.
    RadialDensity,
    /// Its integral from the first row on.
    Cdf,
}

/// The residual of one row, before it is weighted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Criterion {
    /// The difference of a measure.
    LeastSquares(Measure),
    /// p/t - 1, p being the profile's and t the data's r·R. Rows where the data are 0 are left out.
    RelativeError,
    /// ln(p/t): as the relative error where that is small, but too much counts as much as too little. Rows where
    /// the data are 0 are left out.
    Logarithm,
}

/// How much each row counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Weighting {
    /// All the same, however wide.
    Row,
    /// As much as it is wide: the sum over rows becomes an integral over r. A point is as wide as the radii that
    /// are nearer to it than to its neighbours.
    Radius,
    /// By the inverse of its standard error: what is known better counts more.
    StandardError,
}

/// The rows of one table that take part in a fit.
#[derive(Clone, Debug)]
pub(super) struct Target<'a> {
    pub(super) data: &'a RadialData,
    pub(super) cropped_at: Option<f64>,
    criterion: Criterion,
    rows: Vec<TargetRow>,
}

/// A row with what the data say in the criterion's measure.
#[derive(Clone, Copy, Debug)]
struct TargetRow {
    row: RadialRow,
    value: f64,
    weight: f64,
}

impl<'a> Target<'a> {
    pub(super) fn new(
        data: &'a RadialData,
        criterion: Criterion,
        weighting: Weighting,
        crop: Option<Crop>,
    ) -> Result<Self, FitError> {
        let cropped_at = crop.map(|crop| crop.radius(data)).transpose()?;
        let of_entered = 1.0 / data.surface_albedo();
        let is_cdf = criterion == Criterion::LeastSquares(Measure::Cdf);
        // The integral needs intervals.
        let source = if is_cdf { data.bins() } else { data.rows().to_vec() };
        let mut rows = Vec::with_capacity(source.len());
        let (mut cdf, mut variance) = (0.0, 0.0);
        for (index, row) in source.iter().copied().enumerate() {
            if cropped_at.is_some_and(|end| row.r_hi > end) {
                break;
            }
            let (value, standard_error) = match criterion {
                Criterion::LeastSquares(Measure::RReflectance) => (row.r_reflectance, row.standard_error),
                Criterion::LeastSquares(Measure::RadialDensity) => {
                    let density = 2.0 * PI * of_entered;
                    (density * row.r_reflectance, row.standard_error.map(|error| density * error))
                }
                Criterion::LeastSquares(Measure::Cdf) => {
                    cdf += row.energy() * of_entered;
                    let error = row.standard_error.unwrap_or(0.0) * 2.0 * PI * (row.r_hi - row.r_lo);
                    variance += (error * of_entered).powi(2);
                    (cdf, Some(variance.sqrt()))
                }
                Criterion::RelativeError | Criterion::Logarithm => {
                    (row.r_reflectance, row.standard_error.map(|error| error / row.r_reflectance))
                }
            };
            if value == 0.0 && matches!(criterion, Criterion::RelativeError | Criterion::Logarithm) {
                continue;
            }
            let weight = match weighting {
                Weighting::Row => 1.0,
                Weighting::Radius => width(&source, index).sqrt(),
                Weighting::StandardError => {
                    let known = standard_error.map(f64::recip).filter(|weight| weight.is_finite());
                    known.ok_or(FitError::NoStandardError {
                        surface_albedo: data.surface_albedo(),
                        row: index,
                    })?
                }
            };
            rows.push(TargetRow { row, value, weight });
        }
        Ok(Target { data, cropped_at, criterion, rows })
    }

    /// Rows that take part.
    pub(super) fn rows(&self) -> usize {
        self.rows.len()
    }

    /// The weighted residuals of the rows.
    pub(super) fn residuals(&self, profile: &dyn RadialProfile, into: &mut Vec<f64>) {
        let first = self.rows.first().map_or(0.0, |first| first.row.r_lo);
        into.extend(self.rows.iter().map(|TargetRow { row, value, weight }| {
            let here = || r_reflectance(profile, self.data, row);
            weight
                * match self.criterion {
                    Criterion::LeastSquares(Measure::RReflectance) => here() - value,
                    Criterion::LeastSquares(Measure::RadialDensity) => {
                        2.0 * PI / self.data.surface_albedo() * here() - value
                    }
                    Criterion::LeastSquares(Measure::Cdf) => energy_between(profile, first, row.r_hi) - value,
                    Criterion::RelativeError => here() / value - 1.0,
                    // A profile that has ended is infinitely wrong; the smallest number makes it very wrong.
                    Criterion::Logarithm => (here().max(f64::MIN_POSITIVE) / value).ln(),
                }
        }));
    }
}

/// The length of radius that a row stands for.
fn width(rows: &[RadialRow], index: usize) -> f64 {
    let row = &rows[index];
    if row.r_hi > row.r_lo {
        return row.r_hi - row.r_lo;
    }
    let before = index.checked_sub(1).map_or(row.r_lo, |before| rows[before].r_lo);
    let after = rows.get(index + 1).map_or(row.r_lo, |after| after.r_lo);
    0.5 * (after - before)
}
