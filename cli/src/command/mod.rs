//! The commands, one file each.

#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a command's result goes to standard output, its messages to standard error"
)]

pub mod build;
pub mod check;
pub mod contact_sheet;
pub mod diffuse;
mod material_set;
mod number;
pub mod profile;
pub mod render;
mod view;

use crate::failure::Failure;
use clap::{Parser, Subcommand};

/// Subsurface scattering as a toolchain: materials in RON, pictures and validated WGSL out.
#[derive(Debug, Parser)]
#[command(name = "subsurface", version, arg_required_else_help = true, max_term_width = 100)]
#[command(after_help = "\
Examples:
  subsurface render --out bust.png
  subsurface check materials
  subsurface profile eval --model burley_diffuse --surface-albedo 0.8 --mean-free-path-mm 1.3 --radii 0,0.5,1

Exit codes: 0 success, 1 the command reported an error, 2 it was called wrongly.")]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Draw a scene with a material: the procedural bust, or a glTF file.
    Render(render::RenderArguments),
    /// Check material and profile files; print errors and warnings, write nothing.
    Check(check::CheckArguments),
    /// Compile a set of materials to WGSL, Rust bindings and a JSON manifest.
    Build(build::BuildArguments),
    /// Evaluate or sample a radial diffusion profile on the CPU, in double precision.
    Profile(profile::ProfileArguments),
    /// Run the subsurface pass alone on your own buffers (OpenEXR in and out).
    Diffuse(diffuse::DiffuseArguments),
    /// Draw one scene with every profile model, side by side with labels.
    ContactSheet(contact_sheet::ContactSheetArguments),
}

/// Runs a command.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    match &arguments.command {
        Command::Render(arguments) => render::run(arguments),
        Command::Check(arguments) => check::run(arguments),
        Command::Build(arguments) => build::run(arguments),
        Command::Profile(arguments) => profile::run(arguments),
        Command::Diffuse(arguments) => diffuse::run(arguments),
        Command::ContactSheet(arguments) => contact_sheet::run(arguments),
    }
}
