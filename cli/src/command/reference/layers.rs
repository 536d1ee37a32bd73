//! `subsurface reference layers`.

use super::interruption::{Interruption, pool};
use crate::command::{number, output};
use crate::failure::Failure;
use crate::picture::file;
use crate::progress;
use crate::table::{Align, Table};
use clap::Args;
use std::ops::ControlFlow;
use std::path::{Component, Path, PathBuf};
use subsurface_reference::Estimate;
use subsurface_reference::layers::{LayerProgress, LayerResult, LayerRun, MciError, parse_mci};

/// Arguments of `reference layers`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  subsurface reference layers skin.mci
  subsurface reference layers skin.mci --out results --seed 7 --threads 4")]
pub struct LayersArguments {
    /// MCML's input file, version 1.0.
    #[arg(value_name = "FILE.mci")]
    pub input: PathBuf,
    /// The folder for the output files that FILE.mci names; by default its own.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Seed of the random numbers.
    #[arg(long, value_name = "S", default_value_t = 1)]
    pub seed: u64,
    /// Threads; by default one per core. The result does not depend on it.
    #[arg(long, value_name = "T", value_parser = number::threads)]
    pub threads: Option<usize>,
    /// Show no progress.
    #[arg(long)]
    pub quiet: bool,
}

/// Runs the command.
pub(super) fn run(arguments: &LayersArguments) -> Result<(), Failure> {
    let runs =
        parse_mci(&output::read(&arguments.input)?).map_err(|error| failure(&arguments.input, &error))?;
    let mut files = Vec::new();
    for run in &runs {
        let path = out_file(arguments, run)?;
        file::folder_of(&path)?;
        files.push(path);
    }
    let interruption = Interruption::listen()?;
    let pool = pool(arguments.threads)?;
    let heads = ["file", "photons", "specular", "Rd", "±", "Tt", "±", "absorbed", "±"];
    let aligns = heads.map(|head| (head, if head == "file" { Align::Left } else { Align::Right }));
    let mut table = Table::new(aligns);
    for (run, path) in runs.iter().zip(&files) {
        let bar = progress::photons(run.photons(), 0, arguments.quiet);
        let result = pool.install(|| {
            run.simulate(arguments.seed, &mut |progress: &LayerProgress| {
                bar.set_position(progress.photons);
                let Estimate { mean, standard_error } = progress.diffuse_reflectance;
                bar.set_message(format!("Rd {mean:.5} ± {standard_error:.1e}"));
                if interruption.is_wanted() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            })
        });
        bar.finish_and_clear();
        file::write_atomically(path, result.to_mco().as_bytes())?;
        table.row(row(path, &result));
        if interruption.is_wanted() {
            output::print(&table.to_string())?;
            return Err(Failure::interrupted(
                format!("{} holds the {} photons so far", path.display(), result.photons),
                "a run of layers cannot go on later: start the command again for all photons",
            ));
        }
    }
    output::print(&table.to_string())
}

fn row(path: &Path, result: &LayerResult) -> Vec<String> {
    let mut row = vec![
        path.display().to_string(),
        result.photons.to_string(),
        format!("{:.6}", result.specular_reflectance),
    ];
    for estimate in [result.diffuse_reflectance, result.transmittance, result.absorbed] {
        row.extend([format!("{:.6}", estimate.mean), format!("{:.1e}", estimate.standard_error)]);
    }
    row
}

/// Where the output of `run` goes. The input may come from anywhere: it chooses a file's name, not its folder.
fn out_file(arguments: &LayersArguments, run: &LayerRun) -> Result<PathBuf, Failure> {
    let name = Path::new(run.output_name());
    let mut parts = name.components();
    if !matches!((parts.next(), parts.next()), (Some(Component::Normal(_)), None)) {
        return Err(Failure::new(
            format!(
                "{}: the output file `{}` is not a plain file name",
                arguments.input.display(),
                run.output_name()
            ),
            "name the file without a folder, and give the folder with --out DIR",
        ));
    }
    let own = arguments.input.parent().unwrap_or(Path::new(""));
    Ok(arguments.out.as_deref().unwrap_or(own).join(name))
}

/// The library's errors say their remedy after a semicolon or a colon.
fn failure(path: &Path, error: &MciError) -> Failure {
    let text = error.problem.to_string();
    let place = format!("{}:{}", path.display(), error.line);
    match text.split_once("; ").or_else(|| text.split_once(": ")) {
        Some((message, help)) => Failure::new(format!("{place}: {message}"), help),
        None => Failure::new(format!("{place}: {text}"), "see the manual of MCML for the form of its input"),
    }
}
