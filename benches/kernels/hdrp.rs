//! The disc of Unity's High Definition Render Pipeline, from its publication: see `hdrp.wgsl`.

use crate::burley::scattering_distance_mm;
use crate::pass::{Pass, Settings};
use subsurface_cli::failure::Failure;
use subsurface_cli::kernel_bench::{Contender, Entry, Goal, Stage};

/// Golubev 2018 with a budget of taps.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hdrp {
    /// The most taps that a pixel takes.
    pub(crate) budget: u32,
}

/// The disc holds 99.7 % of the widest channel: 1 − ¼e^(−x) − ¾e^(−x/3) = 0.997 at x = r/d = 16.56.
const REACH: f64 = 16.56;

impl Contender for Hdrp {
    fn family(&self) -> String {
        "HDRP disc".to_owned()
    }

    fn taps(&self) -> u32 {
        self.budget
    }

    fn goal(&self) -> Option<Goal> {
        Some(Goal::Faster)
    }

    fn enter(&self, stage: &Stage<'_>) -> Result<Entry, Failure> {
        let d = match scattering_distance_mm(stage) {
            Ok(d) => d,
            Err(reason) => return Ok(Entry::Declines(reason)),
        };
        let reach_mm = REACH * d.into_iter().fold(0.0, f64::max);
        let settings = Settings { scattering_distance_mm: d, reach_mm, taps: self.budget, axis: 0 };
        let pass = Pass::new(stage, include_str!("hdrp.wgsl"), &[[0.0; 4]], &[settings])?;
        Ok(Entry::Runs(Box::new(pass)))
    }
}
