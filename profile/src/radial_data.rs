//! Tabulated radial data: what a measurement or a simulation says of one surface albedo.

use std::f64::consts::PI;

use thiserror::Error;

/// Radii closer than this, relative to the larger, are one: the same number written with other digits. It is 8 units
/// in the last place of an `f32`.
pub(crate) const CLOSEST: f64 = 1e-6;

/// One row of [`RadialData`]: a bin, or a point (`r_lo` = `r_hi`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RadialRow {
    /// Inner radius of the bin, or the radius of the point, in mean free paths, ≥ 0.
    pub r_lo: f64,
    /// Outer radius of the bin, or again the radius of the point, in mean free paths.
    pub r_hi: f64,
    /// Mean of r·R(r) over the bin, or r·R(r) at the point, per mean free path, ≥ 0.
    ///
    /// R is per unit area, and the energy that entered is 1.
    pub r_reflectance: f64,
    /// Standard error of `r_reflectance`, ≥ 0, where it is known.
    pub standard_error: Option<f64>,
}

impl RadialRow {
    /// A point without a standard error.
    pub fn point(radius: f64, r_reflectance: f64) -> RadialRow {
        RadialRow { r_lo: radius, r_hi: radius, r_reflectance, standard_error: None }
    }

    /// A bin without a standard error.
    pub fn bin(r_lo: f64, r_hi: f64, r_reflectance: f64) -> RadialRow {
        RadialRow { r_lo, r_hi, r_reflectance, standard_error: None }
    }

    /// The fraction of the entered energy that leaves within the bin: 2π·`r_reflectance`·width; 0 for a point.
    pub fn energy(&self) -> f64 {
        2.0 * PI * self.r_reflectance * (self.r_hi - self.r_lo)
    }
}

/// A radial reflectance profile as a table, for one surface albedo. Radii are in mean free paths.
///
/// The rows are bins or points, not both; sorted, finite, not negative, at least two, not all 0. Bins do not
/// overlap, but there may be gaps between them.
#[derive(Clone, Debug, PartialEq)]
pub struct RadialData {
    surface_albedo: f64,
    rows: Vec<RadialRow>,
}

/// Why rows are no [`RadialData`]. Rows count from 0.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum RadialDataError {
    /// The surface albedo is not in (0, 1].
    #[error("surface albedo {surface_albedo} is outside (0, 1]")]
    SurfaceAlbedoOutOfRange {
        /// The value given.
        surface_albedo: f64,
    },
    /// Fewer than two rows make no curve.
    #[error("surface albedo {surface_albedo} has {rows} row: give 2 or more")]
    TooFewRows {
        /// Surface albedo of the table.
        surface_albedo: f64,
        /// Rows given.
        rows: usize,
    },
    /// A number is infinite or not a number.
    #[error("row {row}: {quantity} is not a finite number")]
    NotFinite {
        /// The row.
        row: usize,
        /// Which number.
        quantity: &'static str,
    },
    /// A number is negative.
    #[error("row {row}: {quantity} is {value}, below 0")]
    Negative {
        /// The row.
        row: usize,
        /// Which number.
        quantity: &'static str,
        /// The value given.
        value: f64,
    },
    /// A bin that ends where it begins, or before: or a point among bins.
    #[error("row {row}: the bin from {r_lo} to {r_hi} has no width")]
    EmptyBin {
        /// The row.
        row: usize,
        /// Where the bin begins.
        r_lo: f64,
        /// Where the bin ends.
        r_hi: f64,
    },
    /// A row begins before the one above it.
    #[error("row {row}: radius {radius} does not follow {previous}: sort the rows by radius")]
    NotSorted {
        /// The row.
        row: usize,
        /// Its radius, or where its bin begins.
        radius: f64,
        /// The same of the row before.
        previous: f64,
    },
    /// A bin begins within the one before it.
    #[error("row {row}: the bin begins at {r_lo}, but the one before ends at {previous}: they overlap")]
    Overlap {
        /// The row.
        row: usize,
        /// Where the bin begins.
        r_lo: f64,
        /// Where the one before ends.
        previous: f64,
    },
    /// Every value is 0.
    #[error("surface albedo {surface_albedo}: every value is 0, so there is no profile")]
    NoEnergy {
        /// Surface albedo of the table.
        surface_albedo: f64,
    },
    /// The integral of finite values is infinite.
    #[error("surface albedo {surface_albedo}: the integral of the values is out of the range of numbers")]
    OutOfNumericRange {
        /// Surface albedo of the table.
        surface_albedo: f64,
    },
}

impl RadialData {
    /// The table of a surface albedo in (0, 1].
    pub fn new(surface_albedo: f64, rows: Vec<RadialRow>) -> Result<RadialData, RadialDataError> {
        if !(surface_albedo > 0.0 && surface_albedo <= 1.0) {
            return Err(RadialDataError::SurfaceAlbedoOutOfRange { surface_albedo });
        }
        if rows.len() < 2 {
            return Err(RadialDataError::TooFewRows { surface_albedo, rows: rows.len() });
        }
        check_rows(&rows)?;
        let data = RadialData { surface_albedo, rows };
        let energy = data.energy();
        if !energy.is_finite() {
            return Err(RadialDataError::OutOfNumericRange { surface_albedo });
        }
        if energy <= 0.0 {
            return Err(RadialDataError::NoEnergy { surface_albedo });
        }
        Ok(data)
    }

    /// Surface albedo A, in (0, 1].
    pub fn surface_albedo(&self) -> f64 {
        self.surface_albedo
    }

    /// The rows, sorted by radius.
    pub fn rows(&self) -> &[RadialRow] {
        &self.rows
    }

    /// Whether the rows are points, not bins.
    pub fn is_points(&self) -> bool {
        self.rows[0].r_lo == self.rows[0].r_hi
    }

    /// The last radius, in mean free paths: nothing is known beyond.
    pub fn end_radius(&self) -> f64 {
        self.rows[self.rows.len() - 1].r_hi
    }

    /// The table as bins: itself, or the mean of two neighbouring points over the interval between them (the
    /// trapezoidal rule).
    pub fn bins(&self) -> Vec<RadialRow> {
        if !self.is_points() {
            return self.rows.clone();
        }
        let between = |ends: &[RadialRow]| {
            let mean = 0.5 * ends[0].r_reflectance + 0.5 * ends[1].r_reflectance;
            RadialRow::bin(ends[0].r_lo, ends[1].r_lo, mean)
        };
        self.rows.windows(2).map(between).collect()
    }

    /// The fraction of the entered energy that the table holds: ∫ 2πr·R dr over its range, which is the surface
    /// albedo where the table is complete.
    pub fn energy(&self) -> f64 {
        self.bins().iter().map(RadialRow::energy).sum()
    }

    /// The radius within which the table holds `fraction` of its own energy, linear within a bin.
    ///
    /// `fraction` is clamped to [0, 1].
    pub fn quantile(&self, fraction: f64) -> f64 {
        let bins = self.bins();
        let mut rest = fraction.clamp(0.0, 1.0) * self.energy();
        for bin in &bins {
            let energy = bin.energy();
            if rest <= energy && energy > 0.0 {
                return bin.r_lo + (bin.r_hi - bin.r_lo) * (rest / energy);
            }
            rest -= energy;
        }
        self.end_radius()
    }
}

fn check_rows(rows: &[RadialRow]) -> Result<(), RadialDataError> {
    let is_points = rows[0].r_lo == rows[0].r_hi;
    for (row, RadialRow { r_lo, r_hi, r_reflectance, standard_error }) in rows.iter().copied().enumerate() {
        let quantities = [
            ("the radius", r_lo),
            ("the outer radius", r_hi),
            ("the reflectance", r_reflectance),
            ("the standard error", standard_error.unwrap_or(0.0)),
        ];
        for (quantity, value) in quantities {
            if !value.is_finite() {
                return Err(RadialDataError::NotFinite { row, quantity });
            }
            if value < 0.0 {
                return Err(RadialDataError::Negative { row, quantity, value });
            }
        }
        if (r_lo == r_hi) != is_points || r_hi < r_lo {
            return Err(RadialDataError::EmptyBin { row, r_lo, r_hi });
        }
        let Some(previous) = row.checked_sub(1).map(|before| rows[before]) else { continue };
        if r_lo <= previous.r_lo {
            return Err(RadialDataError::NotSorted { row, radius: r_lo, previous: previous.r_lo });
        }
        if previous.r_hi - r_lo > CLOSEST * r_lo {
            return Err(RadialDataError::Overlap { row, r_lo, previous: previous.r_hi });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may panic")]

    use super::*;

    fn bins(ends: &[[f64; 2]]) -> Vec<RadialRow> {
        ends.iter().map(|[r_lo, r_hi]| RadialRow::bin(*r_lo, *r_hi, 0.1)).collect()
    }

    #[test]
    fn a_table_knows_its_energy_and_quantiles() {
        let data = RadialData::new(0.5, bins(&[[0.0, 1.0], [1.0, 3.0]])).unwrap();
        // 2π·0.1·3: a few roundings.
        assert!((data.energy() - 0.6 * PI).abs() < 1e-15);
        assert!((data.quantile(0.5) - 1.5).abs() < 1e-15);
        assert_eq!((data.quantile(0.0), data.quantile(1.0), data.end_radius()), (0.0, 3.0, 3.0));
        let points =
            RadialData::new(0.5, vec![RadialRow::point(0.0, 0.2), RadialRow::point(2.0, 0.0)]).unwrap();
        assert!(points.is_points());
        assert_eq!(points.bins(), [RadialRow::bin(0.0, 2.0, 0.1)]);
    }

    #[test]
    fn what_is_no_table_says_why() {
        use RadialDataError as E;
        let refuse = |rows: Vec<RadialRow>| RadialData::new(0.5, rows).unwrap_err();
        for surface_albedo in [0.0, -0.1, 1.1, f64::NAN, f64::INFINITY] {
            let error = RadialData::new(surface_albedo, bins(&[[0.0, 1.0], [1.0, 2.0]])).unwrap_err();
            assert!(matches!(error, E::SurfaceAlbedoOutOfRange { .. }), "{error}");
        }
        assert!(matches!(refuse(Vec::new()), E::TooFewRows { rows: 0, .. }));
        assert!(matches!(refuse(bins(&[[0.0, 1.0]])), E::TooFewRows { rows: 1, .. }));
        assert!(matches!(refuse(bins(&[[0.0, 1.0], [1.0, f64::NAN]])), E::NotFinite { row: 1, .. }));
        assert!(matches!(refuse(bins(&[[0.0, 1.0], [1.0, f64::INFINITY]])), E::NotFinite { row: 1, .. }));
        assert!(matches!(refuse(bins(&[[-1.0, 1.0], [1.0, 2.0]])), E::Negative { row: 0, .. }));
        assert!(matches!(refuse(bins(&[[0.0, 1.0], [2.0, 1.5]])), E::EmptyBin { row: 1, .. }));
        assert!(matches!(refuse(bins(&[[0.0, 1.0], [1.0, 1.0]])), E::EmptyBin { row: 1, .. }));
        assert!(matches!(refuse(bins(&[[1.0, 2.0], [0.0, 1.0]])), E::NotSorted { row: 1, .. }));
        assert!(matches!(refuse(bins(&[[0.0, 0.0], [0.0, 0.0]])), E::NotSorted { row: 1, .. }));
        assert!(matches!(refuse(bins(&[[0.0, 1.0], [0.5, 2.0]])), E::Overlap { row: 1, .. }));
        let dark = vec![RadialRow::bin(0.0, 1.0, 0.0), RadialRow::bin(1.0, 2.0, 0.0)];
        assert!(matches!(refuse(dark), E::NoEnergy { .. }));
        let bright = vec![RadialRow::bin(0.0, 1e300, 1e300), RadialRow::bin(1e300, 2e300, 1e300)];
        assert!(matches!(refuse(bright), E::OutOfNumericRange { .. }));
        let below = vec![RadialRow::bin(0.0, 1.0, -1e-9), RadialRow::bin(1.0, 2.0, 1.0)];
        assert!(matches!(refuse(below), E::Negative { row: 0, quantity: "the reflectance", .. }));
        let error = RadialRow { standard_error: Some(-1.0), ..RadialRow::bin(0.0, 1.0, 1.0) };
        assert!(matches!(refuse(vec![error, RadialRow::bin(1.0, 2.0, 1.0)]), E::Negative { .. }));
    }

    #[test]
    fn gaps_and_roundings_are_no_error() {
        assert!(RadialData::new(0.5, bins(&[[0.0, 0.1 + 0.2], [0.3, 0.6]])).is_ok());
        assert!(RadialData::new(0.5, bins(&[[0.5, 1.0], [1.5, 2.0]])).is_ok());
    }
}
