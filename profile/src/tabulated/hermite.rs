//! One piece of a monotone cubic, and the slopes that make a cubic monotone.
//!
//! Fritsch and Carlson 1980, "Monotone Piecewise Cubic Interpolation": a cubic between two points of slope δ is
//! monotone if its slopes at both ends lie within [0, 3δ].

/// The cdf between two knots: the cubic that has the mass between them, and the density at both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    /// Distance of the knots, > 0.
    pub(super) width: f64,
    /// Fraction of the energy between them, ≥ 0.
    pub(super) mass: f64,
    /// Density at the first and the second, ≥ 0.
    pub(super) density: [f64; 2],
}

impl Piece {
    /// The same piece seen from its other end.
    pub(super) fn reversed(self) -> Piece {
        let [first, second] = self.density;
        Piece { density: [second, first], ..self }
    }

    /// The mass below s, as coefficients of s, s², s³.
    pub(super) fn coefficients(&self) -> [f64; 3] {
        let [first, second] = self.density.map(|density| density * self.width);
        [first, 3.0 * self.mass - 2.0 * first - second, first + second - 2.0 * self.mass]
    }

    /// Mass in the first part s, from 0 to 1, of the piece.
    ///
    /// To full relative accuracy as s → 0.
    pub(super) fn mass_below(&self, s: f64) -> f64 {
        if s >= 1.0 {
            return self.mass;
        }
        let [linear, square, cube] = self.coefficients();
        // Rounding may leave the range of a monotone function by an ulp, where it is flat.
        (s * (linear + s * (square + s * cube))).clamp(0.0, self.mass)
    }

    /// The density at s, from 0 to 1.
    pub(super) fn density_at(&self, s: f64) -> f64 {
        let [first, second] = self.density;
        let rest = 1.0 - s;
        let density = first * rest * (1.0 - 3.0 * s)
            + second * s * (1.0 - 3.0 * rest)
            + 6.0 * self.mass / self.width * s * rest;
        // Not `max`, which hides NaN.
        if density < 0.0 { 0.0 } else { density }
    }

    /// The density at s over s, for a piece whose density begins with 0.
    pub(super) fn density_over_distance(&self, s: f64) -> f64 {
        let rest = 1.0 - s;
        let density = self.density[1] * (1.0 - 3.0 * rest) + 6.0 * self.mass / self.width * rest;
        density.max(0.0)
    }
}

/// Densities at the knots of a histogram, such that every piece is monotone: inside, the harmonic mean of the
/// densities of both bins, weighted by width (Fritsch and Butland 1984, as in PCHIP); 0 at the end, where the
/// profile ends.
pub(super) fn knot_densities(widths: &[f64], bin_densities: &[f64]) -> Vec<f64> {
    // Only ratios of widths count. An eighth of them, a power of two which changes no digit, leaves sums room.
    let widths: Vec<f64> = widths.iter().map(|width| 0.125 * width).collect();
    let bins = widths.len();
    let mut densities = Vec::with_capacity(bins + 1);
    densities.push(first_density(&widths, bin_densities));
    for bin in 1..bins {
        let (before, after) = (bin_densities[bin - 1], bin_densities[bin]);
        let (from, to) = (2.0 * widths[bin] + widths[bin - 1], widths[bin] + 2.0 * widths[bin - 1]);
        let is_empty = before == 0.0 || after == 0.0;
        densities.push(if is_empty { 0.0 } else { (from + to) / (from / before + to / after) });
    }
    densities.push(0.0);
    densities
}

/// The parabola through the first two bins, kept within the monotone range of the first.
fn first_density(widths: &[f64], bin_densities: &[f64]) -> f64 {
    let (&[w0, w1, ..], &[d0, d1, ..]) = (widths, bin_densities) else { return bin_densities[0] };
    (((2.0 * w0 + w1) * d0 - w0 * d1) / (w0 + w1)).clamp(0.0, 3.0 * d0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_at_the_end_of_the_range_of_numbers_count() {
        let knots = knot_densities(&[7e22, 1.2e308], &[8e-220, 8e-309]);
        assert!(knots.iter().all(|density| density.is_finite()), "{knots:?}");
    }

    #[test]
    fn a_piece_of_linear_density_is_that() {
        let piece = Piece { width: 2.0, mass: 1.0, density: [0.8, 0.2] };
        for s in [0.0, 0.1, 0.5, 0.9, 1.0] {
            assert!((piece.density_at(s) - (0.8 - 0.6 * s)).abs() < 1e-15);
            assert!((piece.mass_below(s) - (1.6 * s - 0.6 * s * s)).abs() < 1e-15);
        }
    }

    #[test]
    fn both_ends_say_the_same() {
        let piece = Piece { width: 0.3, mass: 0.2, density: [1.9, 0.1] };
        for s in [0.0, 0.01, 0.3, 0.77, 1.0] {
            let (from_left, from_right) = (piece.mass_below(s), piece.reversed().mass_below(1.0 - s));
            assert!((from_left + from_right - piece.mass).abs() < 1e-16);
            assert!((piece.density_at(s) - piece.reversed().density_at(1.0 - s)).abs() < 1e-15);
        }
    }

    #[test]
    fn slopes_stay_in_the_monotone_range() {
        let widths = [0.1, 3.0, 0.01, 1.0, 1.0];
        let bins = [5.0, 0.001, 100.0, 0.0, 2.0];
        let knots = knot_densities(&widths, &bins);
        for (bin, density) in bins.iter().enumerate() {
            for knot in &knots[bin..bin + 2] {
                assert!((0.0..=3.0 * density).contains(knot), "bin {bin}: {knots:?}");
            }
        }
    }

    #[test]
    fn a_smooth_histogram_gives_its_density() {
        // The density e^-x by bins of 0.01: its means know it at the knots to the square of the width.
        let mean = |bin: u32| ((-0.01 * f64::from(bin)).exp() - (-0.01 * f64::from(bin + 1)).exp()) / 0.01;
        let bins: Vec<f64> = (0..300).map(mean).collect();
        let knots = knot_densities(&[0.01; 300], &bins);
        for (knot, density) in (0..300).zip(&knots) {
            let exact = (-0.01 * f64::from(knot)).exp();
            assert!((density / exact - 1.0).abs() < 1e-4, "knot {knot}: {density}, not {exact}");
        }
    }
}
