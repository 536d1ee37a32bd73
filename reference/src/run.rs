//! A simulation of one half-space.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use crate::batch_set::BatchSet;
use crate::histogram::Histogram;
use crate::scattering_count::ScatteringCounts;
use crate::walk::{BATCH, Walk};
use crate::{Goal, HalfSpace, Outcome, Progress};

/// Photons that walked through one half-space: how many left, where, and after how many scatterings.
///
/// Paths do not depend on the single-scattering albedo α, so this serves all of them: R_α = Σ αⁿ Hₙ. A run knows which
/// batches of photons it holds; the same batches are the same bytes, however they came together.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    pub(crate) half_space: HalfSpace,
    pub(crate) counts: ScatteringCounts,
    /// Never empty. The smallest seed is the one that goes on.
    pub(crate) sources: BTreeMap<u64, BatchSet>,
    pub(crate) histogram: Histogram,
}

/// Why two runs cannot be merged.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MergeError {
    /// They are about different media.
    #[error("the runs simulate different half-spaces, {0:?} and {1:?}: merge runs of one medium only")]
    HalfSpace(HalfSpace, HalfSpace),
    /// They hold the same photons.
    #[error("both runs hold photons of seed {0}, some of them the same: give each machine a seed of its own")]
    Overlap(u64),
    /// More photons than can be counted.
    #[error("together the runs hold more photons than can be counted")]
    TooMany,
}

impl Run {
    /// No run holds more photons or scatterings, so that those of two can be added: at 10¹⁰ per second, 14 years.
    pub(crate) const MOST: u64 = 1 << 62;

    /// A run without photons. `seed` decides all random numbers.
    pub fn new(half_space: HalfSpace, seed: u64) -> Run {
        let counts = ScatteringCounts::of(&half_space);
        let histogram = Histogram::new(counts.rows());
        Run { half_space, counts, sources: BTreeMap::from([(seed, BatchSet::default())]), histogram }
    }

    /// Photons that entered.
    pub fn photons(&self) -> u64 {
        self.batches() * BATCH
    }

    /// Scatterings simulated.
    pub fn events(&self) -> u64 {
        self.histogram.events
    }

    /// The medium.
    pub fn half_space(&self) -> HalfSpace {
        self.half_space
    }

    /// The seed with which [`simulate`](Run::simulate) goes on: the smallest of those merged.
    pub fn seed(&self) -> u64 {
        self.sources.keys().next().copied().unwrap_or_default()
    }

    /// All seeds of which photons were merged, rising.
    pub fn seeds(&self) -> impl Iterator<Item = u64> {
        self.sources.keys().copied()
    }

    pub(crate) fn batches(&self) -> u64 {
        self.sources.values().map(BatchSet::len).sum()
    }

    /// Adds photons until the goal is reached or `progress` breaks. Runs on the threads of the current rayon pool.
    ///
    /// Photons come in batches of 65536, so there may be a few more than asked for. `progress` is called between rounds
    /// of batches; after a break the run is as good as any other and can go on later. The same photons are the same bytes on
    /// any number of threads, with any breaks.
    pub fn simulate(
        &mut self,
        goal: &Goal,
        progress: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
    ) -> Outcome {
        /// Batches between looks at the standard error.
        const CHECK: u64 = 64;
        /// Scatterings per photon above which a batch takes seconds.
        const LONG_WALK: u32 = 100_000;
        let walk = Walk::new(self.half_space);
        // A round keeps each thread busy four times, so that none waits long for the last; once where the caller would wait
        // too long to break off.
        let batches_per_thread = if self.counts.long() > LONG_WALK { 1 } else { 4 };
        let threads = rayon::current_num_threads();
        let mut partial: Vec<Histogram> = Vec::new();
        let batches_goal = goal.photon_count().div_ceil(BATCH);
        let mut relative_standard_error = self.relative_standard_error();
        loop {
            let batches = self.batches();
            if let Some(error) = goal.standard_error()
                && batches > 0
                && batches.is_multiple_of(CHECK)
                && relative_standard_error <= error
            {
                return Outcome::StandardError;
            }
            if batches >= batches_goal {
                return Outcome::Photons;
            }
            let round = (batches_per_thread * threads as u64)
                .min(batches_goal - batches)
                .min(CHECK - batches % CHECK);
            let seed = self.seed();
            let todo = self.sources.entry(seed).or_default().missing(round);
            partial.resize_with(threads.min(todo.len()).max(partial.len()), || {
                Histogram::new(self.counts.rows())
            });
            let next = AtomicUsize::new(0);
            partial.par_iter_mut().for_each(|histogram| {
                while let Some(&batch) = todo.get(next.fetch_add(1, Ordering::Relaxed)) {
                    walk.run_batch(seed, batch, histogram);
                }
            });
            for histogram in &mut partial {
                self.histogram.add(histogram);
                histogram.clear();
            }
            self.sources.entry(seed).or_default().extend(todo.into_iter().map(|batch| (batch, batch + 1)));
            relative_standard_error = self.relative_standard_error();
            let report = Progress {
                photons: self.photons(),
                photons_goal: goal.photon_count(),
                events: self.events(),
                relative_standard_error,
            };
            if progress(&report).is_break() {
                return Outcome::Interrupted;
            }
        }
    }

    /// Adds the photons of another run. Order does not matter.
    ///
    /// # Errors
    ///
    /// Another half-space, or photons that this run already holds. Then this run is unchanged.
    pub fn merge(&mut self, other: &Run) -> Result<(), MergeError> {
        if self.half_space != other.half_space {
            return Err(MergeError::HalfSpace(self.half_space, other.half_space));
        }
        for (seed, batches) in &other.sources {
            if self.sources.get(seed).is_some_and(|own| own.overlaps(batches)) {
                return Err(MergeError::Overlap(*seed));
            }
        }
        if self.photons() + other.photons() > Run::MOST || self.events() + other.events() > Run::MOST {
            return Err(MergeError::TooMany);
        }
        for (&seed, batches) in &other.sources {
            self.sources.entry(seed).or_default().extend(batches.ranges().iter().copied());
        }
        self.histogram.add(&other.histogram);
        Ok(())
    }
}
