//! A profile by rings.

/// r·R(r) of one single-scattering albedo, ring by ring from the axis outwards. Lengths in mean free paths.
#[derive(Clone, Debug, PartialEq)]
pub struct RadialTable {
    /// α of the medium, in [0, 1].
    pub single_scattering_albedo: f64,
    /// A = ∫ R 2πr dr over all radii, those beyond the last ring included.
    pub surface_albedo: f64,
    /// Rings, rising and without gaps from the radius 0.
    pub bins: Vec<RadialBin>,
}

/// One ring of a [`RadialTable`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RadialBin {
    /// Inner radius.
    pub r_lo: f64,
    /// Outer radius.
    pub r_hi: f64,
    /// Mean of r·R(r) over the ring, per mean free path. The energy that leaves in the ring is 2π (r_hi - r_lo) times it.
    pub r_reflectance: f64,
    /// One standard deviation of `r_reflectance`.
    pub standard_error: f64,
    /// Fraction of all reflected energy that leaves within `r_hi`.
    pub cdf_at_r_hi: f64,
}

/// How far two tables of independent photons are apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChiSquared {
    /// Sum of squared differences over their variances.
    pub value: f64,
    /// Rings compared.
    pub degrees_of_freedom: usize,
}

impl ChiSquared {
    /// By how many of its standard deviations the value differs from what it should be: above 4, the tables disagree.
    /// NaN where no ring was compared.
    pub fn deviation(&self) -> f64 {
        let expected = self.degrees_of_freedom as f64;
        // χ² has the variance 2 per degree of freedom.
        (self.value - expected) / (2.0 * expected).sqrt()
    }
}

impl RadialTable {
    /// Rings up to this radius have independent errors. Those further out share one: how many photons outlast the longest walk.
    /// These are spread over radii of 115/(1 - g) mean free paths and more, and for A > 0.95 they count.
    pub const INDEPENDENT_UP_TO: f64 = 61.0;

    /// χ² of the differences of r·R, on the radii that are edges of both tables. Rings that differ in width are joined.
    ///
    /// Left out are rings whose mean is not known to 10 %, since they hold too few photons for the normal distribution that
    /// χ² supposes, and those beyond [`INDEPENDENT_UP_TO`](RadialTable::INDEPENDENT_UP_TO).
    pub fn chi_squared(&self, other: &RadialTable) -> ChiSquared {
        let mut chi_squared = ChiSquared { value: 0.0, degrees_of_freedom: 0 };
        let (mut ours, mut theirs) = (self.bins.as_slice(), other.bins.as_slice());
        while let Some((one, two)) = next_common(&mut ours, &mut theirs) {
            let variance = one.standard_error.powi(2) + two.standard_error.powi(2);
            let smaller = one.r_reflectance.min(two.r_reflectance);
            let populated = variance > 0.0 && variance.sqrt() < 0.1 * smaller;
            if populated && one.r_hi <= Self::INDEPENDENT_UP_TO {
                chi_squared.value += (one.r_reflectance - two.r_reflectance).powi(2) / variance;
                chi_squared.degrees_of_freedom += 1;
            }
        }
        chi_squared
    }
}

/// Takes the fewest rings off both fronts that end at the same radius. Tables begin at the axis, so they begin at one too.
fn next_common(ours: &mut &[RadialBin], theirs: &mut &[RadialBin]) -> Option<(RadialBin, RadialBin)> {
    let (mut one, mut two) = (take(ours)?, take(theirs)?);
    loop {
        if one.r_hi < two.r_hi {
            one = one.joined(&take(ours)?);
        } else if two.r_hi < one.r_hi {
            two = two.joined(&take(theirs)?);
        } else {
            return Some((one, two));
        }
    }
}

fn take(bins: &mut &[RadialBin]) -> Option<RadialBin> {
    let (first, rest) = bins.split_first()?;
    *bins = rest;
    Some(*first)
}

impl RadialBin {
    /// This ring and the next one outwards as one ring.
    fn joined(&self, next: &RadialBin) -> RadialBin {
        let (width, next_width) = (self.r_hi - self.r_lo, next.r_hi - next.r_lo);
        let sum = width + next_width;
        RadialBin {
            r_lo: self.r_lo,
            r_hi: next.r_hi,
            r_reflectance: (self.r_reflectance * width + next.r_reflectance * next_width) / sum,
            // Other photons in another ring.
            standard_error: (self.standard_error * width).hypot(next.standard_error * next_width) / sum,
            cdf_at_r_hi: next.cdf_at_r_hi,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(edges: &[f64], shift: f64) -> RadialTable {
        let bin = |edges: &[f64]| RadialBin {
            r_lo: edges[0],
            r_hi: edges[1],
            r_reflectance: 1.0 + shift,
            standard_error: 0.01,
            cdf_at_r_hi: 0.5,
        };
        let bins = edges.windows(2).map(bin).collect();
        RadialTable { single_scattering_albedo: 0.5, surface_albedo: 0.1, bins }
    }

    #[test]
    fn tables_are_compared_on_their_common_radii() {
        let fine = table(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0], 0.0);
        let coarse = table(&[0.0, 2.0, 3.5, 4.0], 0.02);
        let chi_squared = fine.chi_squared(&coarse);
        assert_eq!(chi_squared.degrees_of_freedom, 2);
        // The errors of the joined ring are 0.01/√2, or hypot(1.5, 0.5)/2 of 0.01.
        let expected = 4.0 / 1.5 + 4.0 / (0.5 + 2.5 / 4.0);
        assert!((chi_squared.value - expected).abs() < 1e-9, "{}", chi_squared.value);
        assert_eq!(coarse.chi_squared(&fine), chi_squared);
        assert_eq!(fine.chi_squared(&table(&[], 0.0)).degrees_of_freedom, 0);
    }
}
