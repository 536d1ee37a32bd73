//! `subsurface check`.

use super::material_set::colour;
use crate::failure::Failure;
use crate::say;
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use subsurface_codegen::check_paths;

/// How diagnostics are printed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// As rustc prints them, on standard error.
    #[default]
    Human,
    /// A JSON array on standard output, for editors: `severity`, `message`, `file`, `line`, `column`, `end_line`,
    /// `end_column`, `label`, `help`, `secondary`; numbers from 1, the end exclusive.
    Json,
}

/// Arguments of `subsurface check`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  subsurface check materials
  subsurface check materials/skin.ron materials/profiles/burley_diffuse.ron
  subsurface check --format json materials")]
pub struct CheckArguments {
    /// Directories of materials, material files and profile files.
    #[arg(required = true, value_name = "PATH")]
    pub paths: Vec<PathBuf>,
    /// How diagnostics are printed.
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
}

/// Runs the command.
pub fn run(arguments: &CheckArguments) -> Result<(), Failure> {
    let checked = check_paths(&arguments.paths);
    let report = &checked.report;
    let (errors, warnings) = (report.errors().count(), report.warnings().count());
    let summary = format!(
        "{}, {} in {}",
        counted(errors, "error"),
        counted(warnings, "warning"),
        counted(checked.files_read.len(), "file")
    );
    match arguments.format {
        Format::Json => say!("{:#}", report.to_json()),
        Format::Human if !report.is_empty() => eprintln!("{}", report.render(colour())),
        Format::Human => (),
    }
    if errors > 0 {
        return Err(Failure::reported(summary));
    }
    if arguments.format == Format::Human {
        eprintln!("{summary}");
    }
    Ok(())
}

fn counted(count: usize, noun: &str) -> String {
    if count == 1 { format!("1 {noun}") } else { format!("{count} {noun}s") }
}
