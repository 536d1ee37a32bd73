//! `subsurface reference`: ground truth by Monte Carlo.

mod albedo;
mod check;
mod interruption;
mod layers;
mod merge;
mod run_file;
mod simulate;
mod table;

use crate::failure::Failure;
use clap::{Args, Subcommand, ValueEnum};
use subsurface_reference::Entry;

/// Ground truth by Monte Carlo: simulate, merge, tabulate and check photon walks.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  subsurface reference simulate --entry searchlight --photons 1e7 --out run.bin
  subsurface reference table --run run.bin --surface-albedo 0.2,0.5,0.8 --out truth.csv
  subsurface profile compare --truth truth.csv")]
pub struct ReferenceArguments {
    /// What to do.
    #[command(subcommand)]
    pub command: ReferenceCommand,
}

/// What to do with the ground truth.
#[derive(Debug, Subcommand)]
pub enum ReferenceCommand {
    /// Let photons walk through a half-space, and keep where they leave after how many scatterings.
    ///
    /// Paths do not depend on the single-scattering albedo, so one run serves all albedos. The same photons give the
    /// same bytes on any machine and any number of threads. A run can be interrupted (Ctrl-C) and goes on with the
    /// same command; it is also saved every 30 seconds. Runs of other seeds can be added: see `reference merge`.
    Simulate(simulate::SimulateArguments),
    /// Add up runs of one half-space, for example of several machines. Each needs a seed of its own.
    Merge(merge::MergeArguments),
    /// Turn a run into a CSV table: r·R(r) with standard errors, ring by ring, for chosen albedos.
    ///
    /// Lengths are in mean free paths. `profile compare --truth`, `profile fit --data` and profile files read it.
    Table(table::TableArguments),
    /// Test a run against the stored truth: χ² of r·R(r) over the rings, for each stored surface albedo.
    ///
    /// χ² per ring is near 1 where run and truth differ by no more than both of their standard errors say.
    Check(check::CheckArguments),
    /// Print the surface albedo A of a medium for its single-scattering albedo α, or the inverse.
    ///
    /// The exact values are those of Chandrasekhar's H functions, for index-matched isotropic scattering; beside them
    /// the conversion that profiles use, and for perpendicular entry the one of Liang et al. 2023, eq. (8).
    Albedo(albedo::AlbedoArguments),
    /// Simulate layered media as MCML does: reads its input files, writes its output files.
    ///
    /// Lengths are in cm. Each run of FILE.mci makes the output file that it names.
    Layers(layers::LayersArguments),
}

/// How light enters the medium.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum EntryName {
    /// Perpendicular, at one point.
    Searchlight,
    /// At one point, from all directions with the same radiance.
    Diffuse,
}

impl EntryName {
    fn entry(self) -> Entry {
        match self {
            Self::Searchlight => Entry::Searchlight,
            Self::Diffuse => Entry::Diffuse,
        }
    }
}

/// Runs the command.
pub fn run(arguments: &ReferenceArguments) -> Result<(), Failure> {
    match &arguments.command {
        ReferenceCommand::Simulate(arguments) => simulate::run(arguments),
        ReferenceCommand::Merge(arguments) => merge::run(arguments),
        ReferenceCommand::Table(arguments) => table::run(arguments),
        ReferenceCommand::Check(arguments) => check::run(arguments),
        ReferenceCommand::Albedo(arguments) => albedo::run(arguments),
        ReferenceCommand::Layers(arguments) => layers::run(arguments),
    }
}
