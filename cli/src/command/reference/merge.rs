//! `subsurface reference merge`.

use super::run_file;
use crate::failure::Failure;
use crate::picture::file;
use crate::say;
use clap::Args;
use std::path::PathBuf;

/// Arguments of `reference merge`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  subsurface reference merge seed1.bin seed2.bin seed3.bin --out all.bin")]
pub struct MergeArguments {
    /// Runs of one half-space, two or more, each of other seeds.
    #[arg(required = true, num_args = 2.., value_name = "FILE.bin")]
    pub runs: Vec<PathBuf>,
    /// The sum. It may be one of the runs.
    #[arg(long, value_name = "FILE.bin")]
    pub out: PathBuf,
}

/// Runs the command.
pub(super) fn run(arguments: &MergeArguments) -> Result<(), Failure> {
    file::folder_of(&arguments.out)?;
    let mut sum = None;
    for path in &arguments.runs {
        let run = run_file::read(path)?;
        let Some(sum) = &mut sum else {
            sum = Some(run);
            continue;
        };
        sum.merge(&run).map_err(|error| {
            let text = error.to_string();
            let (message, help) = text.rsplit_once(": ").unwrap_or((&text, "leave this run out"));
            Failure::new(format!("cannot add {}: {message}", path.display()), help)
        })?;
    }
    if let Some(sum) = sum {
        run_file::write(&arguments.out, &sum)?;
        say!("{}: {} photons, {} scatterings", arguments.out.display(), sum.photons(), sum.events());
    }
    Ok(())
}
