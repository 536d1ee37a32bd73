//! The simulation of a run.

use std::ops::ControlFlow;

use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;
use rayon::iter::{IntoParallelIterator, ParallelIterator};

use crate::Estimate;
use crate::random::mix;

use super::result::LayerResult;
use super::run::LayerRun;
use super::tally::Tally;
use super::walk::Walk;

/// Packets with one stream of random numbers.
const BATCH: u64 = 1024;

/// Batches for each thread between two calls of the progress callback: enough that threads seldom wait for each other,
/// few enough that an interruption takes effect soon.
const BATCHES_PER_THREAD: u64 = 32;

/// How far a simulation has come.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct LayerProgress {
    /// Packets traced.
    pub photons: u64,
    /// Packets asked for.
    pub requested: u64,
    /// Diffuse reflectance so far.
    pub diffuse_reflectance: Estimate,
    /// Transmittance so far.
    pub transmittance: Estimate,
}

impl LayerRun {
    /// Traces the packets on all threads of the current rayon pool.
    ///
    /// `progress` is called between groups of batches on the calling thread; when it breaks, the result holds the packets
    /// that were traced by then. A run that is not interrupted depends on `seed` alone, never on threads or machine.
    pub fn simulate(
        &self,
        seed: u64,
        progress: &mut dyn FnMut(&LayerProgress) -> ControlFlow<()>,
    ) -> LayerResult {
        let walk = Walk::new(self.stack(), self.grid());
        let empty = || Tally::new(self.grid(), self.stack().layers().len());
        let batches = self.photons().div_ceil(BATCH);
        let group = BATCHES_PER_THREAD * rayon::current_num_threads() as u64;
        let mut sum = empty();
        let mut first = 0;
        while first < batches {
            let last = batches.min(first.saturating_add(group));
            let tally = (first..last)
                .into_par_iter()
                .fold(empty, |mut tally, batch| {
                    let mut rng = stream(seed, batch);
                    for _ in 0..BATCH.min(self.photons() - batch * BATCH) {
                        walk.trace(&mut rng, &mut tally);
                    }
                    tally
                })
                .reduce(empty, |mut left, right| {
                    left.merge(&right);
                    left
                });
            sum.merge(&tally);
            first = last;
            let report = LayerProgress {
                photons: sum.photons,
                requested: self.photons(),
                diffuse_reflectance: sum.reflected.total.estimate(sum.photons, 1.0),
                transmittance: sum.transmitted.total.estimate(sum.photons, 1.0),
            };
            if progress(&report).is_break() {
                break;
            }
        }
        LayerResult::new(self, seed, walk.specular_reflectance(), &sum)
    }
}

/// Random numbers of one batch.
///
/// Seed and batch are spread over the 256 bits of the state by SplitMix64, a bijection, so no two batches of a seed begin
/// alike, and the chance that two of their sequences overlap is negligible at a period of 2²⁵⁶ − 1.
fn stream(seed: u64, batch: u64) -> Xoshiro256PlusPlus {
    let mut state = [0; 32];
    let words = [mix(seed), mix(batch), mix(seed ^ mix(!batch)), mix(mix(seed).wrapping_add(batch))];
    for (bytes, word) in state.chunks_exact_mut(8).zip(words) {
        bytes.copy_from_slice(&word.to_le_bytes());
    }
    Xoshiro256PlusPlus::from_seed(state)
}
