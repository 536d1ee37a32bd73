//! A profile that is a table.

mod hermite;
mod model;

use std::f64::consts::PI;
use std::sync::Arc;

use crate::RadialProfile;
use crate::inverse::increasing_root;
use crate::radial_profile::{legal_radius, legal_u};

use hermite::Piece;

pub use model::{TabulatedError, TabulatedKnot, TabulatedModel};

/// The member of [`TabulatedModel`] that belongs to one medium.
#[derive(Clone, Debug, PartialEq)]
pub struct TabulatedProfile {
    surface_albedo: f64,
    mean_free_path_mm: f64,
    /// Radii of the knots in mean free paths: from 0, increasing, at least two.
    radii: Arc<[f64]>,
    knots: Vec<Knot>,
}

/// What the profile says at one radius.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Knot {
    /// Fraction of the energy within.
    cdf: f64,
    /// Fraction beyond.
    tail: f64,
    /// Density of the exit radius, 2πr·R/A, per mean free path.
    density: f64,
    /// Fraction between this knot and the next; 0 at the last.
    mass: f64,
}

impl TabulatedProfile {
    /// A profile from the density at each radius and the fraction between it and the next, which sum to 1.
    fn new(
        surface_albedo: f64,
        mean_free_path_mm: f64,
        radii: Arc<[f64]>,
        densities_and_masses: impl Iterator<Item = (f64, f64)>,
    ) -> TabulatedProfile {
        let mut knots: Vec<Knot> =
            densities_and_masses.map(|(density, mass)| Knot { cdf: 0.0, tail: 0.0, density, mass }).collect();
        let (mut cdf, mut tail) = (0.0, 0.0);
        for knot in &mut knots {
            knot.cdf = f64::min(cdf, 1.0);
            cdf += knot.mass;
        }
        for knot in knots.iter_mut().rev() {
            tail += knot.mass;
            knot.tail = f64::min(tail, 1.0);
        }
        TabulatedProfile { surface_albedo, mean_free_path_mm, radii, knots }
    }

    fn unit_end(&self) -> f64 {
        self.radii[self.radii.len() - 1]
    }

    /// The piece between a knot and the next.
    fn piece(&self, index: usize) -> Piece {
        Piece {
            width: self.radii[index + 1] - self.radii[index],
            mass: self.knots[index].mass,
            density: [self.knots[index].density, self.knots[index + 1].density],
        }
    }

    /// The argument in mean free paths, or the end of the profile.
    fn unit_radius(&self, radius_mm: f64) -> f64 {
        let radius_mm = legal_radius(radius_mm);
        // Compared in mm first, so that the profile ends exactly at `max_radius` however the quotient rounds.
        if radius_mm >= self.unit_end() * self.mean_free_path_mm {
            self.unit_end()
        } else {
            (radius_mm / self.mean_free_path_mm).clamp(0.0, self.unit_end())
        }
    }

    /// The knot at or below a radius that lies before the end.
    fn knot_below(&self, r: f64) -> usize {
        // The first radius is 0, so that the partition point is at least 1; NaN compares as beyond all, and the last
        // piece makes NaN of it.
        let last = self.radii.len() - 2;
        self.radii.partition_point(|radius| *radius <= r).saturating_sub(1).min(last)
    }

    fn unit_pdf(&self, r: f64) -> f64 {
        if r >= self.unit_end() {
            return 0.0;
        }
        let index = self.knot_below(r);
        let piece = self.piece(index);
        piece.density_at((r - self.radii[index]) / piece.width)
    }

    fn unit_cdf(&self, r: f64) -> f64 {
        let index = self.knot_below(r);
        let piece = self.piece(index);
        (self.knots[index].cdf + piece.mass_below((r - self.radii[index]) / piece.width)).clamp(0.0, 1.0)
    }

    fn unit_tail(&self, r: f64) -> f64 {
        let index = self.knot_below(r);
        let piece = self.piece(index).reversed();
        let after = self.knots[index + 1].tail;
        (after + piece.mass_below((self.radii[index + 1] - r) / piece.width)).clamp(0.0, 1.0)
    }
}

impl RadialProfile for TabulatedProfile {
    fn surface_albedo(&self) -> f64 {
        self.surface_albedo
    }

    /// Infinite at r = 0, as 1/r, unless the table's r·R begins with 0.
    fn area_pdf(&self, radius_mm: f64) -> f64 {
        let r = self.unit_radius(radius_mm);
        let first = self.piece(0);
        let over_r = if r < first.width && first.density[0] == 0.0 {
            // 2πr·R/A vanishes with r, and so does what it is divided by.
            first.density_over_distance(r / first.width) / first.width
        } else {
            self.unit_pdf(r) / r
        };
        over_r / (2.0 * PI) / self.mean_free_path_mm / self.mean_free_path_mm
    }

    fn radial_pdf(&self, radius_mm: f64) -> f64 {
        self.unit_pdf(self.unit_radius(radius_mm)) / self.mean_free_path_mm
    }

    fn radial_cdf(&self, radius_mm: f64) -> f64 {
        let r = self.unit_radius(radius_mm);
        let cdf = self.unit_cdf(r);
        // The larger of cdf and tail is the complement of the other, so that the two add up to 1.
        if cdf >= 0.5 { 1.0 - self.unit_tail(r) } else { cdf }
    }

    fn radial_tail(&self, radius_mm: f64) -> f64 {
        let r = self.unit_radius(radius_mm);
        let cdf = self.unit_cdf(r);
        if cdf >= 0.5 { self.unit_tail(r) } else { 1.0 - cdf }
    }

    /// Bisection among the knots, then Newton's method on the cubic between two of them.
    fn sample_radius(&self, u: f64) -> f64 {
        if u.is_nan() {
            return u;
        }
        let u = legal_u(u);
        if u == 0.0 {
            return 0.0;
        }
        let knots = &self.knots;
        let r = if u < 0.5 {
            let near = knots.partition_point(|knot| knot.cdf <= u).saturating_sub(1).min(knots.len() - 2);
            let piece = self.piece(near);
            self.radii[near] + piece.width * piece.root(u - knots[near].cdf)
        } else {
            let q = 1.0 - u;
            let far = knots.partition_point(|knot| knot.tail >= q).clamp(1, knots.len() - 1);
            let piece = self.piece(far - 1).reversed();
            self.radii[far] - piece.width * piece.root(q - knots[far].tail)
        };
        r * self.mean_free_path_mm
    }

    fn max_radius(&self) -> Option<f64> {
        Some(self.unit_end() * self.mean_free_path_mm)
    }
}

impl Piece {
    /// The s at which [`mass_below`](Piece::mass_below) is `target`.
    fn root(&self, target: f64) -> f64 {
        let [linear, square, cube] = self.coefficients();
        // What each term alone would give; the smallest is the right one as the target tends to 0.
        let alone = [target / linear, (target / square).sqrt(), (target / cube).cbrt()];
        let start = alone.into_iter().filter(|s| *s >= 0.0).fold(1.0, f64::min);
        let value_and_slope = |s: f64| (self.mass_below(s) - target, self.density_at(s) * self.width);
        increasing_root(value_and_slope, [0.0, 1.0], start, 0.0)
    }
}
