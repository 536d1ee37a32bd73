//! Taps of constant density: see `uniform_disc.wgsl`.

use crate::pass::{Pass, Settings};
use crate::uniform_subject::{profiles, widest_radius_mm};
use subsurface_cli::failure::Failure;
use subsurface_cli::kernel_bench::{Contender, Entry, Stage};

/// Taps of constant density over the disc.
#[derive(Clone, Copy, Debug)]
pub(crate) struct UniformDisc {
    /// Taps per pixel.
    pub(crate) taps: u32,
}

/// Share of the widest channel's energy that the disc holds: of 0.3 to 0.99, this gives the smallest error. A wider
/// disc loses more in density than it gains in reach.
const REACH_QUANTILE: f64 = 0.5;

/// Entries of the profile's table.
const ENTRIES: u32 = 256;

impl Contender for UniformDisc {
    fn family(&self) -> String {
        "uniform disc".to_owned()
    }

    fn taps(&self) -> u32 {
        self.taps
    }

    fn enter(&self, stage: &Stage<'_>) -> Result<Entry, Failure> {
        let profiles = match profiles(stage) {
            Ok(profiles) => profiles,
            Err(reason) => return Ok(Entry::Declines(reason)),
        };
        let reach_mm = widest_radius_mm(&profiles, REACH_QUANTILE);
        let entry = |index: u32| {
            // Not at 0, where r·R(r) is a limit that not every profile can evaluate.
            let share = f64::from(index.max(1)) / f64::from(ENTRIES - 1);
            let radius_mm = share * share * reach_mm;
            let [r, g, b] = profiles.each_ref().map(|p| (radius_mm * p.area_pdf(radius_mm)) as f32);
            [r, g, b, 0.0]
        };
        let table: Vec<[f32; 4]> = (0..ENTRIES).map(entry).collect();
        let settings = Settings { reach_mm, taps: self.taps, ..Settings::default() };
        let pass = Pass::new(stage, include_str!("uniform_disc.wgsl"), &table, &[settings])?;
        Ok(Entry::Runs(Box::new(pass)))
    }
}
