//! `subsurface reference table`.

use super::run_file;
use crate::command::{number, output};
use crate::failure::Failure;
use clap::Args;
use std::path::PathBuf;
use subsurface_reference::{EstimateError, Run, TruthTable};

/// Arguments of `reference table`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  subsurface reference table --run run.bin --surface-albedo 0.2,0.5,0.8 --out truth.csv
  subsurface reference table --run run.bin --single-scattering-albedo 0.9 --out -")]
pub struct TableArguments {
    /// The run, from `reference simulate` or `reference merge`.
    #[arg(long, value_name = "FILE.bin")]
    pub run: PathBuf,
    #[command(flatten)]
    pub albedos: Albedos,
    /// The table; `-` prints it.
    #[arg(long, value_name = "FILE.csv")]
    pub out: PathBuf,
}

/// Which media.
#[derive(Debug, Args)]
#[group(required = true, multiple = false)]
pub struct Albedos {
    /// Surface albedos A, in [0, 1].
    #[arg(long = "surface-albedo", value_name = "A,A,…", value_delimiter = ',', value_parser = number::surface_albedo, allow_hyphen_values = true)]
    pub surface_albedos: Vec<f64>,
    /// Single-scattering albedos α, in [0, 1].
    #[arg(long = "single-scattering-albedo", value_name = "α,α,…", value_delimiter = ',', value_parser = number::single_scattering_albedo, allow_hyphen_values = true)]
    pub single_scattering_albedos: Vec<f64>,
}

/// Runs the command.
pub(super) fn run(arguments: &TableArguments) -> Result<(), Failure> {
    output::check(&arguments.out)?;
    let run = run_file::read(&arguments.run)?;
    let mut tables = Vec::new();
    for alpha in single_scattering_albedos(&arguments.albedos, &run)? {
        tables.push(run.radial_profile(alpha).map_err(|error| failure(&error))?);
    }
    tables.sort_by(|a, b| a.surface_albedo.total_cmp(&b.surface_albedo));
    tables.dedup_by(|a, b| a.surface_albedo == b.surface_albedo);
    let table = TruthTable {
        half_space: run.half_space(),
        photons: run.photons(),
        seeds: run.seeds().collect(),
        command: command(arguments),
        tables,
    };
    output::write(&arguments.out, &table.to_csv())
}

fn single_scattering_albedos(albedos: &Albedos, run: &Run) -> Result<Vec<f64>, Failure> {
    if albedos.surface_albedos.is_empty() {
        return Ok(albedos.single_scattering_albedos.clone());
    }
    let given = albedos.surface_albedos.iter();
    given.map(|a| run.single_scattering_albedo(*a).map_err(|error| failure(&error))).collect()
}

/// The command that makes the table, for its header.
fn command(arguments: &TableArguments) -> String {
    let list = |numbers: &[f64]| numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
    let Albedos { surface_albedos, single_scattering_albedos } = &arguments.albedos;
    let albedos = match &surface_albedos[..] {
        [] => format!("--single-scattering-albedo {}", list(single_scattering_albedos)),
        some => format!("--surface-albedo {}", list(some)),
    };
    let (run, out) = (arguments.run.display(), arguments.out.display());
    format!("subsurface reference table --run {run} {albedos} --out {out}")
}

/// The library's errors say their remedy after a colon.
pub(super) fn failure(error: &EstimateError) -> Failure {
    let text = error.to_string();
    let (message, help) = text.split_once(": ").unwrap_or((&text, "see --help"));
    Failure::new(message, help)
}
