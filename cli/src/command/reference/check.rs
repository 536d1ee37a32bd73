//! `subsurface reference check`.

use super::run_file;
use super::table::failure;
use crate::command::output;
use crate::failure::Failure;
use crate::table::{Align, Table};
use clap::Args;
use std::path::PathBuf;
use subsurface_reference::{RadialTable, Run, TruthTable, truth};

/// Arguments of `reference check`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  subsurface reference check --run new.bin
  subsurface reference simulate --entry searchlight --photons 1e6 --seed 99 --out new.bin")]
pub struct CheckArguments {
    /// The run, from `reference simulate` or `reference merge`; of another seed than the stored truth.
    #[arg(long, value_name = "FILE.bin")]
    pub run: PathBuf,
}

/// Runs the command.
pub(super) fn run(arguments: &CheckArguments) -> Result<(), Failure> {
    let run = run_file::read(&arguments.run)?;
    let stored = stored(&run)?;
    if let Some(seed) = run.seeds().find(|seed| stored.seeds.contains(seed)) {
        return Err(Failure::new(
            format!("the run and the stored truth share the seed {seed}: they may share photons"),
            "simulate with another --seed",
        ));
    }
    let heads = ["A", "rings", "χ²", "χ² per ring", "largest deviation in σ"];
    let mut table = Table::new(heads.map(|head| (head, Align::Right)));
    let (mut rings, mut sum) = (0, 0.0);
    for expected in &stored.tables {
        let edges: Vec<f64> = expected
            .bins
            .iter()
            .map(|bin| bin.r_lo)
            .chain(expected.bins.last().map(|bin| bin.r_hi))
            .collect();
        let found = run
            .radial_profile_on(expected.single_scattering_albedo, &edges)
            .map_err(|error| failure(&error))?;
        let deviations = deviations(&found, expected, run.photons(), stored.photons);
        let chi_squared: f64 = deviations.iter().map(|z| z * z).sum();
        let largest = deviations.iter().fold(0.0, |largest: f64, z| largest.max(z.abs()));
        rings += deviations.len();
        sum += chi_squared;
        table.row([
            expected.surface_albedo.to_string(),
            deviations.len().to_string(),
            format!("{chi_squared:.1}"),
            format!("{:.3}", chi_squared / deviations.len() as f64),
            format!("{largest:.2}"),
        ]);
    }
    output::print(&format!(
        "{}, {} photons; stored truth: {} photons\n{table}χ² per ring {:.3} over all {rings}\n",
        run_file::describe(run.half_space()),
        run.photons(),
        stored.photons,
        sum / rings as f64
    ))
}

/// The stored table of the run's half-space.
fn stored(run: &Run) -> Result<&'static TruthTable, Failure> {
    let tables =
        [truth::searchlight(), truth::diffuse(), truth::searchlight_eta_1_4(), truth::diffuse_eta_1_4()];
    tables.into_iter().find(|table| table.half_space == run.half_space()).ok_or_else(|| {
        let stored: Vec<String> = tables.iter().map(|table| run_file::describe(table.half_space)).collect();
        Failure::new(
            format!("no stored truth has this half-space: {}", run_file::describe(run.half_space())),
            format!("stored are: {}", stored.join("; ")),
        )
    })
}

/// Differences over their standard error.
///
/// The stored one is known well and falls with the square root of the photons, so that it tells the run's as well: in a
/// ring that few photons of the run have reached, their own spread says little.
fn deviations(found: &RadialTable, expected: &RadialTable, photons: u64, stored_photons: u64) -> Vec<f64> {
    let factor = (1.0 + stored_photons as f64 / photons as f64).sqrt();
    let rings = found.bins.iter().zip(&expected.bins);
    rings
        .map(|(a, b)| (a.r_reflectance - b.r_reflectance) / (factor * b.standard_error))
        .filter(|z| z.is_finite())
        .collect()
}
