//! The cropping rule of Liang et al. 2023.

use crate::RadialData;

use super::FitError;

/// \[L23\] eq. (6): rows beyond the first radius at which r·R(r) ≤ ε·(r·R)(0) are left out.
///
/// The paper prints the rule for R, but only applied to r·R does it reproduce the paper's coefficients. Radii are
/// tried in the paper's steps: 0.05 up to 0.5, then 0.1 up to 1, 0.2 up to 2, 0.5 up to 5, and 1 beyond, in mean
/// free paths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crop {
    /// ε, in (0, 1).
    pub threshold: f64,
}

impl Crop {
    /// The paper's ε = 0.005.
    pub const LIANG_2023: Crop = Crop { threshold: 0.005 };

    /// The radius to which the data are kept, in mean free paths; their end where no radius fulfils the rule.
    ///
    /// The value of a bin holds from its middle, between two middles or points the data are read as a straight line,
    /// and before the first they are constant: (r·R)(0) is the value of the first row.
    pub fn radius(&self, data: &RadialData) -> Result<f64, FitError> {
        let Crop { threshold } = *self;
        if !(threshold > 0.0 && threshold < 1.0) {
            return Err(FitError::CropOutOfRange { threshold });
        }
        let limit = threshold * data.rows()[0].r_reflectance;
        let end = data.end_radius();
        // Counted in whole twentieths, which do not drift. A table that begins with 0 has nothing to compare with.
        let mut twentieths = 0_u64;
        loop {
            let radius = twentieths as f64 / 20.0;
            if radius >= end || limit == 0.0 {
                return Ok(end);
            }
            if r_reflectance_at(data, radius) <= limit {
                return Ok(radius);
            }
            twentieths += match twentieths {
                0..10 => 1,
                10..20 => 2,
                20..40 => 4,
                40..100 => 10,
                // Steps of 1, but not more than 10⁴ of them over a long table.
                _ => 20 * (end / 1e4).max(1.0) as u64,
            };
        }
    }
}

/// r·R of the data at a radius, by linear interpolation.
fn r_reflectance_at(data: &RadialData, radius: f64) -> f64 {
    let middle = |row: usize| 0.5 * data.rows()[row].r_lo + 0.5 * data.rows()[row].r_hi;
    let value = |row: usize| data.rows()[row].r_reflectance;
    let (mut below, mut above) = (0, data.rows().len() - 1);
    if radius <= middle(below) {
        return value(below);
    }
    if radius >= middle(above) {
        return value(above);
    }
    while above - below > 1 {
        let row = below + (above - below) / 2;
        if middle(row) <= radius {
            below = row;
        } else {
            above = row;
        }
    }
    let t = (radius - middle(below)) / (middle(above) - middle(below));
    value(below) + t * (value(above) - value(below))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may panic")]

    use super::*;
    use crate::RadialRow;

    /// r·R = e^(-r/d) at points 0.01 apart, up to 30.
    fn exponential(d: f64) -> RadialData {
        let rows = (0..=3000).map(|step| {
            let r = 0.01 * f64::from(step);
            RadialRow::point(r, (-r / d).exp())
        });
        RadialData::new(0.5, rows.collect()).unwrap()
    }

    #[test]
    fn the_rule_takes_the_first_step_beyond_the_threshold() {
        // e^(-r/d) ≤ 0.005 from r = 5.298 d: the next radius that the steps reach.
        for (d, expected) in [(0.05, 0.30), (0.13, 0.7), (0.2, 1.2), (0.7, 4.0), (1.0, 6.0), (3.1, 17.0)] {
            assert_eq!(Crop::LIANG_2023.radius(&exponential(d)).unwrap(), expected, "d = {d}");
        }
    }

    #[test]
    fn data_that_never_fall_so_far_are_kept_whole() {
        assert_eq!(Crop::LIANG_2023.radius(&exponential(100.0)).unwrap(), 30.0);
        let from_zero = [RadialRow::point(0.0, 0.0), RadialRow::point(1.0, 1.0), RadialRow::point(2.0, 0.5)];
        let data = RadialData::new(0.5, from_zero.to_vec()).unwrap();
        assert_eq!(Crop::LIANG_2023.radius(&data).unwrap(), 2.0);
    }

    #[test]
    fn a_very_long_table_ends_too() {
        let rows = vec![RadialRow::bin(0.0, 1e15, 1.0), RadialRow::bin(1e15, 1e16, 0.9)];
        let data = RadialData::new(0.5, rows).unwrap();
        assert_eq!(Crop::LIANG_2023.radius(&data).unwrap(), 1e16);
    }

    #[test]
    fn thresholds_outside_0_and_1_are_refused() {
        for threshold in [0.0, 1.0, -1.0, f64::NAN, f64::INFINITY] {
            let error = Crop { threshold }.radius(&exponential(1.0));
            assert!(matches!(error, Err(FitError::CropOutOfRange { .. })), "{error:?}");
        }
    }
}
