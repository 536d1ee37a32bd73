//! Counts of photons by scattering count and ring.

use crate::radial_grid::RINGS;

/// Exits per (row of scattering counts, ring), and what did not exit. Integers, so that the order of adding does not
/// matter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Histogram {
    /// `rows × RINGS`, row by row.
    exits: Vec<u64>,
    /// Photons that were given up at the short limit.
    pub(crate) short_survivors: u64,
    /// Followed photons that were given up at the long limit.
    pub(crate) long_survivors: u64,
    /// Scatterings simulated.
    pub(crate) events: u64,
}

impl Histogram {
    pub(crate) fn new(rows: usize) -> Histogram {
        Histogram { exits: vec![0; rows * RINGS], short_survivors: 0, long_survivors: 0, events: 0 }
    }

    #[inline(always)]
    pub(crate) fn record(&mut self, row: usize, ring: usize, scatterings: u32) {
        self.exits[row * RINGS + ring] += 1;
        self.events += u64::from(scatterings);
    }

    #[inline(always)]
    pub(crate) fn give_up(&mut self, long: bool, scatterings: u32) {
        if long {
            self.long_survivors += 1;
        } else {
            self.short_survivors += 1;
        }
        self.events += u64::from(scatterings);
    }

    pub(crate) fn add(&mut self, other: &Histogram) {
        for (count, more) in self.exits.iter_mut().zip(&other.exits) {
            *count += more;
        }
        self.short_survivors += other.short_survivors;
        self.long_survivors += other.long_survivors;
        self.events += other.events;
    }

    pub(crate) fn clear(&mut self) {
        self.exits.fill(0);
        (self.short_survivors, self.long_survivors, self.events) = (0, 0, 0);
    }

    pub(crate) fn exits(&self) -> &[u64] {
        &self.exits
    }

    pub(crate) fn exits_mut(&mut self) -> &mut [u64] {
        &mut self.exits
    }

    pub(crate) fn row(&self, row: usize) -> &[u64] {
        &self.exits[row * RINGS..(row + 1) * RINGS]
    }
}
