//! Scattering counts, and how they are grouped.
//!
//! A photon that scattered n times weighs αⁿ. Counts up to [`ScatteringCounts::EXACT`] have a row of their own in the
//! histogram. Above, a row holds the counts of a range whose width is at most 1/256 of its beginning. αⁿ is
//! averaged over the range with the weights n^(-3/2), the law by which photons leave. Were the true law n^(-3/2)·(1 + s),
//! with s linear in ln n over the range, the error relative to the row would be s'·(width²/12)·n|ln α| < 3·10⁻⁶ for
//! slopes up to 2, and n|ln α| is of order one where such rows matter at all.

use crate::HalfSpace;

/// The rows of a histogram for one medium.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct ScatteringCounts {
    /// The last count up to which all photons are followed.
    short: u32,
    /// The last count up to which some photons are followed.
    long: u32,
    /// The last count of each row above [`Self::EXACT`].
    group_ends: Vec<u32>,
}

impl ScatteringCounts {
    /// Up to here each scattering count has its own row.
    pub(crate) const EXACT: u32 = 1024;
    /// A row above [`Self::EXACT`] that begins at n spans n / `GROUPS_PER_E` counts.
    const GROUPS_PER_E: u32 = 256;
    /// All photons are followed for this many scatterings when g = 0. On the way to n, a photon scatters 3√n times on
    /// average (34 here), since most leave. One in eight goes on to `LONG_ISOTROPIC`, which is another 300 for each: the
    /// two parts cost the same.
    const SHORT_ISOTROPIC: f64 = 128.0;
    /// Where diffusion theory takes over when g = 0. Its exit law n^(-3/2) is off by less than 10⁻³ of itself here.
    const LONG_ISOTROPIC: f64 = 10_000.0;

    /// Similarity (σs' = (1 - g) σs): forward scattering takes 1/(1 - g) times as many events to the same end.
    pub(crate) fn of(half_space: &HalfSpace) -> ScatteringCounts {
        let stretch = 1.0 / (1.0 - half_space.anisotropy());
        let long = (Self::LONG_ISOTROPIC * stretch).ceil() as u32;
        let short = (Self::SHORT_ISOTROPIC * stretch).ceil() as u32;
        let mut group_ends = Vec::new();
        let mut end = Self::EXACT;
        while end < long {
            // No row holds counts on both sides of `short`: photons weigh differently there.
            let mut next = (end + (end / Self::GROUPS_PER_E).max(1)).min(long);
            if end < short && next > short {
                next = short;
            }
            group_ends.push(next);
            end = next;
        }
        ScatteringCounts { short, long, group_ends }
    }

    pub(crate) fn short(&self) -> u32 {
        self.short
    }

    pub(crate) fn long(&self) -> u32 {
        self.long
    }

    /// Rows: 1 ..= EXACT, then the groups. Row 0 is n = 1.
    pub(crate) fn rows(&self) -> usize {
        Self::EXACT as usize + self.group_ends.len()
    }

    /// Rows that all photons can reach; the others are reached by the followed ones only.
    pub(crate) fn short_rows(&self) -> usize {
        self.row(self.short) + 1
    }

    /// The row of the scattering count `n`, which is at least 1 and at most `long`.
    #[inline]
    pub(crate) fn row(&self, n: u32) -> usize {
        if n <= Self::EXACT {
            n as usize - 1
        } else {
            Self::EXACT as usize + self.group_ends.partition_point(|&end| end < n)
        }
    }

    /// αⁿ per row, averaged over the row's counts. Products and roots only, so that it is the same on every machine.
    pub(crate) fn powers(&self, single_scattering_albedo: f64) -> Vec<f64> {
        let mut power = 1.0;
        let mut next_power = || {
            power *= single_scattering_albedo;
            // Not a subnormal: those are slow, and nobody can tell.
            if power < 1e-300 {
                power = 0.0;
            }
            power
        };
        let mut powers: Vec<f64> = (0..Self::EXACT).map(|_| next_power()).collect();
        let mut begin = Self::EXACT;
        for &end in &self.group_ends {
            let (mut sum, mut weights) = (0.0, 0.0);
            for n in begin + 1..=end {
                let n = f64::from(n);
                let weight = 1.0 / (n * n.sqrt());
                weights += weight;
                sum += weight * next_power();
            }
            powers.push(sum / weights);
            begin = end;
        }
        powers
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Entry;

    #[test]
    fn rows_cover_all_counts_in_order() {
        for anisotropy in [0.0, -0.5, 0.3, 0.9, HalfSpace::MAXIMUM_ANISOTROPY] {
            let half_space = HalfSpace::new(Entry::Searchlight, anisotropy, 1.0).expect("valid");
            let counts = ScatteringCounts::of(&half_space);
            let mut last = 0;
            for n in 1..=counts.long().max(ScatteringCounts::EXACT) {
                let row = counts.row(n);
                assert!(row == last || row == last + 1);
                last = row;
            }
            assert_eq!(last + 1, counts.rows());
            assert!(counts.row(counts.short() + 1) > counts.row(counts.short()));
        }
    }

    #[test]
    fn the_power_of_a_row_is_that_of_its_counts() {
        let counts = ScatteringCounts::of(&HalfSpace::matched_isotropic(Entry::Diffuse));
        let powers = counts.powers(0.999);
        for n in [1, 2, 100, 1024, 1030, 5000, 10_000] {
            // A row above 1024 is at most 1/256 wide: α^n changes by at most e^(n/256·0.001) - 1 over it.
            let tolerance = if n <= 1024 { 1e-12 } else { f64::from(n) * 0.001 / 256.0 * 1.1 };
            let exact = 0.999_f64.powf(f64::from(n));
            assert!((powers[counts.row(n)] / exact - 1.0).abs() < tolerance, "{n}");
        }
        assert!(counts.powers(1.0).iter().all(|&power| (power - 1.0).abs() < 1e-14));
    }
}
