//! How far a profile is from tabulated data.

use std::f64::consts::PI;

use crate::{RadialData, RadialProfile, RadialRow};

/// How far a profile is from tabulated data of the same surface albedo, in the measures that papers use.
///
/// The profile's length must be 1 mm, since the radii of the data are in mean free paths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// ∫ |p - t| dr, p and t being 2πr·R/A of the profile and the data: by bins, over the range of the data.
    ///
    /// From 0 to 2; half of it bounds the distance of the cdfs.
    pub l1: f64,
    /// The mean of |R/T - 1| over r uniform in [0, [`end_radius`](Self::end_radius)], R the profile, T the data.
    pub mean_relative_error: f64,
    /// Errors of r·R over r uniform in [0, `end_radius`].
    pub whole: SquaredError,
    /// The radius to which the two errors above reach, in mean free paths.
    pub end_radius: f64,
    /// The share of the data's energy that lies beyond the profile's own end; 0 for a profile without one.
    pub data_outside: f64,
    /// The share of the profile's energy that lies beyond the last radius of the data.
    pub profile_outside: f64,
}

/// Errors of r·R over a range of radii. NaN where the range holds no data.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SquaredError {
    /// Mean of the squared difference, per mean free path squared.
    pub mean: f64,
    /// R² = 1 - Σ(p - t)²/Σ(t - mean t)²: 1 for a perfect fit, 0 for one no better than a constant.
    pub r_squared: f64,
}

impl Deviation {
    /// Share of the data's energy within the radius to which [`of`](Self::of) measures.
    pub const QUANTILE: f64 = 0.999;

    /// The deviation up to the radius within which the data hold 99.9 % of their energy.
    pub fn of(profile: &dyn RadialProfile, data: &RadialData) -> Deviation {
        Deviation::within(profile, data, data.quantile(Self::QUANTILE))
    }

    /// The deviation up to `end_radius`, in mean free paths.
    pub fn within(profile: &dyn RadialProfile, data: &RadialData, end_radius: f64) -> Deviation {
        let beyond = |bin: &RadialRow, end: f64| {
            let width = (bin.r_hi - bin.r_lo.max(end)).max(0.0);
            2.0 * PI * bin.r_reflectance * width
        };
        let bins = data.bins();
        let data_outside = profile
            .max_radius()
            .map_or(0.0, |end| bins.iter().map(|bin| beyond(bin, end)).sum::<f64>() / data.energy());
        Deviation {
            l1: l1(profile, data),
            mean_relative_error: mean_relative_error(profile, data, [0.0, end_radius]),
            whole: SquaredError::of(profile, data, [0.0, end_radius]),
            end_radius,
            data_outside,
            profile_outside: profile.radial_tail(data.end_radius()),
        }
    }
}

impl SquaredError {
    /// The errors of r·R over r uniform in `range`, mean free paths.
    ///
    /// \[L23\] Table 1 samples r evenly. Rows of a table may differ in width; each counts as wide as it is.
    pub fn of(profile: &dyn RadialProfile, data: &RadialData, range: [f64; 2]) -> SquaredError {
        let rows = weighted(data, range);
        let weight: f64 = rows.iter().map(|(weight, _)| weight).sum();
        let mean = rows.iter().map(|(weight, row)| weight * row.r_reflectance).sum::<f64>() / weight;
        let squares = |difference: &dyn Fn(&RadialRow) -> f64| {
            rows.iter().map(|(weight, row)| weight * difference(row).powi(2)).sum::<f64>() / weight
        };
        let error = squares(&|row| r_reflectance(profile, data, row) - row.r_reflectance);
        let variance = squares(&|row| row.r_reflectance - mean);
        SquaredError { mean: error, r_squared: 1.0 - error / variance }
    }
}

/// ∫ |p - t| dr of 2πr·R/A by bins, over the range of the data.
pub fn l1(profile: &dyn RadialProfile, data: &RadialData) -> f64 {
    let bins = data.bins();
    let difference = |bin: &RadialRow| {
        (energy_between(profile, bin.r_lo, bin.r_hi) - bin.energy() / data.surface_albedo()).abs()
    };
    bins.iter().map(difference).sum()
}

/// The mean of |R/T - 1| over r uniform in `range`, mean free paths; R the profile, T the data.
///
/// Rows where the data are 0 have no relative error and are left out. NaN where no row is left.
pub fn mean_relative_error(profile: &dyn RadialProfile, data: &RadialData, range: [f64; 2]) -> f64 {
    let mut rows = weighted(data, range);
    rows.retain(|(_, row)| row.r_reflectance > 0.0);
    let weight: f64 = rows.iter().map(|(weight, _)| weight).sum();
    let error = |row: &RadialRow| (r_reflectance(profile, data, row) / row.r_reflectance - 1.0).abs();
    rows.iter().map(|(weight, row)| weight * error(row)).sum::<f64>() / weight
}

/// What the profile says in the place of `row`: the mean of r·R over the bin, or r·R at the point.
pub(crate) fn r_reflectance(profile: &dyn RadialProfile, data: &RadialData, row: &RadialRow) -> f64 {
    let radial = if row.r_lo == row.r_hi {
        profile.radial_pdf(row.r_lo)
    } else {
        energy_between(profile, row.r_lo, row.r_hi) / (row.r_hi - row.r_lo)
    };
    data.surface_albedo() * radial / (2.0 * PI)
}

/// Fraction of the profile's energy between two radii, by whichever of cdf and tail has more digits there.
pub(crate) fn energy_between(profile: &dyn RadialProfile, r_lo: f64, r_hi: f64) -> f64 {
    if profile.radial_cdf(r_lo) < 0.5 {
        profile.radial_cdf(r_hi) - profile.radial_cdf(r_lo)
    } else {
        profile.radial_tail(r_lo) - profile.radial_tail(r_hi)
    }
}

/// The rows within `range`, each with the length of radius that it stands for.
fn weighted(data: &RadialData, [from, to]: [f64; 2]) -> Vec<(f64, RadialRow)> {
    let rows = data.rows();
    let mut weighted = Vec::with_capacity(rows.len());
    for (index, row) in rows.iter().enumerate() {
        // A point stands for the radii that are nearer to it than to its neighbours.
        let (lo, hi) = if data.is_points() {
            let before = index.checked_sub(1).map_or(row.r_lo, |before| rows[before].r_lo);
            let after = rows.get(index + 1).map_or(row.r_lo, |after| after.r_lo);
            (0.5 * (before + row.r_lo), 0.5 * (row.r_lo + after))
        } else {
            (row.r_lo, row.r_hi)
        };
        let width = hi.min(to) - lo.max(from);
        if width > 0.0 {
            weighted.push((width, *row));
        }
    }
    weighted
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may panic")]

    use super::*;
    use crate::{Channel, Medium, Model};

    fn profile(stem: &str, surface_albedo: f64) -> Box<dyn RadialProfile> {
        let medium = Medium::new(surface_albedo, 1.0).unwrap();
        Model::published(stem).unwrap().profile(medium, Channel::Red).unwrap()
    }

    /// 400 bins up to 20 mean free paths.
    fn table_of(profile: &dyn RadialProfile) -> RadialData {
        let surface_albedo = profile.surface_albedo();
        let rows = (0..400).map(|bin| {
            let (r_lo, r_hi) = (0.05 * f64::from(bin), 0.05 * f64::from(bin + 1));
            let energy = surface_albedo * energy_between(profile, r_lo, r_hi);
            RadialRow::bin(r_lo, r_hi, energy / (2.0 * PI * (r_hi - r_lo)))
        });
        RadialData::new(surface_albedo, rows.collect()).unwrap()
    }

    #[test]
    fn a_profile_does_not_deviate_from_its_own_table() {
        let burley = profile("burley_searchlight", 0.5);
        let deviation = Deviation::of(&*burley, &table_of(&*burley));
        // Roundings of 400 differences.
        assert!(deviation.l1 < 1e-13 && deviation.mean_relative_error < 1e-12, "{deviation:?}");
        let SquaredError { mean, r_squared } = deviation.whole;
        assert!(mean < 1e-28 && r_squared > 1.0 - 1e-15, "{deviation:?}");
        assert_eq!(deviation.data_outside, 0.0);
        assert!((deviation.profile_outside - burley.radial_tail(20.0)).abs() < 1e-15);
    }

    #[test]
    fn a_constant_factor_is_its_own_relative_error() {
        let burley = profile("burley_searchlight", 0.5);
        let mut rows = table_of(&*burley).rows().to_vec();
        for row in &mut rows {
            row.r_reflectance *= 0.8;
        }
        let scaled = RadialData::new(0.5, rows).unwrap();
        let deviation = Deviation::of(&*burley, &scaled);
        // 1/0.8 - 1; the L1 distance is 0.2 of the energy within 20 mean free paths.
        assert!((deviation.mean_relative_error - 0.25).abs() < 1e-12, "{deviation:?}");
        assert!((deviation.l1 - 0.2 * burley.radial_cdf(20.0)).abs() < 1e-13, "{deviation:?}");
    }

    #[test]
    fn what_lies_beyond_the_end_of_a_profile_is_counted() {
        let truth = profile("exponential_dipole_searchlight", 0.8);
        let polynomial = profile("liang_2023", 0.8);
        let end = polynomial.max_radius().unwrap();
        let table = table_of(&*truth);
        let deviation = Deviation::of(&*polynomial, &table);
        let expected = (truth.radial_cdf(20.0) - truth.radial_cdf(end)) / truth.radial_cdf(20.0);
        // One bin of 0.05 is split at the end, as if its density were constant.
        assert!((deviation.data_outside - expected).abs() < 1e-4, "{deviation:?}, not {expected}");
        assert_eq!(deviation.profile_outside, 0.0);
    }

    #[test]
    fn the_error_of_a_range_is_the_mean_of_its_halves() {
        let (burley, truth) =
            (profile("burley_searchlight", 0.5), profile("exponential_dipole_searchlight", 0.5));
        let table = table_of(&*truth);
        let mean = |range| SquaredError::of(&*burley, &table, range).mean;
        let (near, far, whole) = (mean([0.0, 3.0]), mean([3.0, 6.0]), mean([0.0, 6.0]));
        // Roundings of 120 squares.
        assert!(near > far && (0.5 * (near + far) - whole).abs() < 1e-13 * whole, "{near} {far} {whole}");
    }

    #[test]
    fn a_range_without_data_has_no_error() {
        let burley = profile("burley_searchlight", 0.5);
        let error = SquaredError::of(&*burley, &table_of(&*burley), [30.0, 40.0]);
        assert!(error.mean.is_nan() && error.r_squared.is_nan());
        assert!(mean_relative_error(&*burley, &table_of(&*burley), [30.0, 40.0]).is_nan());
    }

    #[test]
    fn points_count_as_far_as_they_are_nearest() {
        let rows = [0.0, 1.0, 3.0].map(|r| RadialRow::point(r, 0.1));
        let data = RadialData::new(0.5, rows.to_vec()).unwrap();
        let weights: Vec<f64> = weighted(&data, [0.0, 3.0]).iter().map(|(weight, _)| *weight).collect();
        assert_eq!(weights, [0.5, 1.5, 1.0]);
    }
}
