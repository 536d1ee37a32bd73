//! `subsurface reference simulate`.

use super::interruption::{Interruption, pool};
use super::{EntryName, run_file};
use crate::command::number;
use crate::failure::Failure;
use crate::picture::file;
use crate::progress;
use crate::say;
use clap::Args;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::{Duration, Instant};
use subsurface_reference::{Goal, HalfSpace, Outcome, Progress, Run};

/// Arguments of `reference simulate`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  subsurface reference simulate --entry searchlight --photons 1e7 --out run.bin
  subsurface reference simulate --entry diffuse --photons 1e9 --standard-error 0.002 --seed 7 --out diffuse.bin
  subsurface reference simulate --entry searchlight --anisotropy 0.9 --refractive-index 1.4 --photons 1e6 \\
      --threads 4 --out tissue.bin")]
pub struct SimulateArguments {
    /// How light enters.
    #[arg(long, value_enum)]
    pub entry: EntryName,
    /// Photons that the run shall hold in the end, those that it holds already included. They come in batches of 65536.
    #[arg(long, value_name = "N", value_parser = number::photons)]
    pub photons: u64,
    /// Seed of the random numbers. Runs that are to be merged need different ones.
    #[arg(long, value_name = "S", default_value_t = 1)]
    pub seed: u64,
    /// Mean cosine g of the scattering angle (Henyey–Greenstein), in (-1, 0.999]; 0 is isotropic.
    #[arg(long, value_name = "g", default_value = "0", value_parser = number::anisotropy, allow_hyphen_values = true)]
    pub anisotropy: f64,
    /// Refractive index of the medium over that of the outside, 1 or more; 1 is matched.
    #[arg(long, value_name = "η", default_value_t = 1.0, allow_hyphen_values = true)]
    pub refractive_index: f64,
    /// Stop earlier, once the relative standard error of r·R is below E in every ring that holds a thousandth of the
    /// energy reflected at the single-scattering albedo 0.9.
    #[arg(long, value_name = "E", value_parser = number::standard_error, allow_hyphen_values = true)]
    pub standard_error: Option<f64>,
    /// Threads; by default one per core. The result does not depend on it.
    #[arg(long, value_name = "T", value_parser = number::threads)]
    pub threads: Option<usize>,
    /// The run. If there is one already, the simulation goes on from there.
    #[arg(long, value_name = "FILE.bin")]
    pub out: PathBuf,
    /// Start over: replace a run that is there.
    #[arg(long)]
    pub fresh: bool,
    /// Show no progress.
    #[arg(long)]
    pub quiet: bool,
}

/// Time between two saves: what a power cut can cost.
const CHECKPOINT: Duration = Duration::from_secs(30);

/// Runs the command.
pub(super) fn run(arguments: &SimulateArguments) -> Result<(), Failure> {
    let interruption = Interruption::listen()?;
    let half_space =
        HalfSpace::new(arguments.entry.entry(), arguments.anisotropy, arguments.refractive_index)
            .map_err(|error| split(&error.to_string()))?;
    let goal = goal(arguments)?;
    file::folder_of(&arguments.out)?;
    let mut run = begin(arguments, half_space)?;
    let already = run.photons();
    let bar = progress::photons(arguments.photons, already, arguments.quiet);
    let outcome = pool(arguments.threads)?.install(|| {
        let mut saved = Instant::now();
        loop {
            let outcome = run.simulate(&goal, &mut |progress: &Progress| {
                // Photons come in batches, so that the last may go beyond the goal.
                bar.set_length(progress.photons_goal.max(progress.photons));
                bar.set_position(progress.photons);
                bar.set_message(format!("± {:.3} %", 100.0 * progress.relative_standard_error));
                let pause = interruption.is_wanted() || saved.elapsed() > CHECKPOINT;
                if pause { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            });
            // A goal that is reached already saves nothing.
            if run.photons() > already || arguments.fresh || !arguments.out.exists() {
                run_file::write(&arguments.out, &run)?;
            }
            saved = Instant::now();
            if outcome != Outcome::Interrupted || interruption.is_wanted() {
                return Ok::<Outcome, Failure>(outcome);
            }
        }
    })?;
    bar.finish_and_clear();
    let out = arguments.out.display();
    let photons = run.photons();
    match outcome {
        Outcome::Interrupted => Err(Failure::interrupted(
            format!("{out} holds the {photons} photons so far"),
            "the same command goes on from there",
        )),
        Outcome::StandardError => {
            say!(
                "{out}: {photons} photons, {} scatterings; the standard error is small enough",
                run.events()
            );
            Ok(())
        }
        _ => {
            say!("{out}: {photons} photons, {} scatterings", run.events());
            Ok(())
        }
    }
}

fn goal(arguments: &SimulateArguments) -> Result<Goal, Failure> {
    let goal = Goal::photons(arguments.photons);
    let goal = match arguments.standard_error {
        Some(error) => goal.and_then(|goal| goal.or_relative_standard_error(error)),
        None => goal,
    };
    goal.map_err(|error| split(&error.to_string()))
}

/// The run to go on with, or a new one.
fn begin(arguments: &SimulateArguments, half_space: HalfSpace) -> Result<Run, Failure> {
    let out = arguments.out.display();
    let there = if arguments.fresh { None } else { run_file::read_if_there(&arguments.out)? };
    let Some(run) = there else { return Ok(Run::new(half_space, arguments.seed)) };
    let fresh = "choose another --out, or start over with --fresh";
    if run.half_space() != half_space {
        let (held, asked) = (run_file::describe(run.half_space()), run_file::describe(half_space));
        return Err(Failure::new(
            format!("{out} is a run of another half-space: {held}, not {asked}"),
            fresh,
        ));
    }
    if run.seeds().ne([arguments.seed]) {
        let seeds: Vec<String> = run.seeds().map(|seed| seed.to_string()).collect();
        let message = format!("{out} is a run of seed {}, not {}", seeds.join(", "), arguments.seed);
        return Err(Failure::new(message, fresh));
    }
    eprintln!("going on with {out}: {} photons are there", run.photons());
    Ok(run)
}

/// The library's errors say their remedy after a colon.
fn split(text: &str) -> Failure {
    let (message, help) = text.split_once(": ").unwrap_or((text, "see --help"));
    Failure::new(message, help)
}
