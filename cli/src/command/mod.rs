//! The commands, one file each.

#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a command's result goes to standard output, its messages to standard error"
)]

pub mod adapter;
#[cfg(feature = "analysis")]
pub mod bench;
pub mod build;
pub mod check;
#[cfg(feature = "analysis")]
pub mod compare;
pub mod contact_sheet;
pub mod details;
pub mod diffuse;
pub mod export;
pub mod kernel;
mod lights;
mod material_set;
mod number;
#[cfg(feature = "analysis")]
mod output;
#[cfg(feature = "analysis")]
pub mod pictures;
#[cfg(feature = "analysis")]
pub mod profile;
#[cfg(feature = "analysis")]
pub mod reference;
pub mod render;
pub(crate) mod view;

use crate::failure::Failure;
use clap::{Parser, Subcommand};

/// Subsurface scattering as a toolchain: materials in RON, pictures and validated WGSL out.
#[derive(Debug, Parser)]
#[command(name = "subsurface", version, arg_required_else_help = true, max_term_width = 100)]
#[command(after_help = "\
Examples:
  subsurface render --out bust.png
  subsurface check materials
  subsurface contact-sheet --out sheet.png

Exit codes: 0 success, 1 the command reported an error, 2 it was called wrongly, 130 it was interrupted.")]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Draw a scene with a material: the procedural bust, or a glTF file.
    ///
    /// glTF is read with node transforms, base colours and normal maps, in metres by its standard. An object whose glTF
    /// material has the name of a material of the set takes that one, all others take --material.
    Render(render::RenderArguments),
    /// Check material and profile files; print errors and warnings, write nothing.
    ///
    /// All errors of all files come out in one run. Exits with 1 if there is an error; warnings alone exit with 0.
    Check(check::CheckArguments),
    /// Compile a set of materials to WGSL, Rust bindings and a JSON manifest.
    ///
    /// Writes subsurface.wgsl (the kernel module: all materials of the set), subsurface.rs (typed bindings that include
    /// it), subsurface.json (what the module binds, entry points, the parameter table) and subsurface.curves (the
    /// quantile radii of the profiles, a texture); if a profile is a table, also subsurface.tables (its knots). The same
    /// materials give the same bytes. For Rust projects, `subsurface_codegen::Compiler` in build.rs does the same at
    /// every build.
    Build(build::BuildArguments),
    /// Evaluate, judge, fit and draw radial diffusion profiles, in double precision.
    #[cfg(feature = "analysis")]
    Profile(profile::ProfileArguments),
    /// Ground truth by Monte Carlo: simulate, merge, tabulate and check photon walks.
    #[cfg(feature = "analysis")]
    Reference(reference::ReferenceArguments),
    /// Run the subsurface pass alone on your own buffers (OpenEXR in and out).
    ///
    /// Input channels, 16- or 32-bit, as flat names or as layers: irradiance.R/G/B (diffuse irradiance, linear); Z
    /// (distance along the view axis in mm; 0 or inf is background); optional albedo.R/G/B (surface albedo in [0, 1], by
    /// default that of the material) and material (number of the material: the set's names in alphabetical order, from 0;
    /// by default --material everywhere). Output: R, G, B, the diffused irradiance, 32-bit; background passes through.
    ///
    /// This is how to check the kernel against your own ground truth.
    Diffuse(diffuse::DiffuseArguments),
    /// Draw one scene with every profile model that has a published set, side by side with labels.
    ///
    /// The first tile has no subsurface scattering. The others differ in the profile alone; everything else of the
    /// material stays.
    ContactSheet(contact_sheet::ContactSheetArguments),
    /// Write a scene for a path tracer, to see what the light should be.
    ///
    /// `mitsuba` is Mitsuba 3: meshes as PLY in mm, the camera, the lights, and each object as a medium whose mean free
    /// path and albedo are the material's. One file per colour channel; render them with `reference/pictures/render.py`,
    /// and compare with `subsurface compare`.
    Export(export::ExportArguments),
    /// Tell how far a picture is from a truth: RMSE, PSNR, mean, FLIP.
    #[cfg(feature = "analysis")]
    Compare(compare::CompareArguments),
    /// Measure kernels and pictures: errors and times side by side.
    #[cfg(feature = "analysis")]
    Bench(bench::BenchArguments),
    /// Name the graphics adapter that pictures are drawn on.
    Adapter(adapter::AdapterArguments),
}

/// Runs a command.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    match &arguments.command {
        Command::Render(arguments) => render::run(arguments),
        Command::Check(arguments) => check::run(arguments),
        Command::Build(arguments) => build::run(arguments),
        #[cfg(feature = "analysis")]
        Command::Profile(arguments) => profile::run(arguments),
        #[cfg(feature = "analysis")]
        Command::Reference(arguments) => reference::run(arguments),
        Command::Diffuse(arguments) => diffuse::run(arguments),
        Command::ContactSheet(arguments) => contact_sheet::run(arguments),
        Command::Export(arguments) => export::run(arguments),
        #[cfg(feature = "analysis")]
        Command::Compare(arguments) => compare::run(arguments),
        #[cfg(feature = "analysis")]
        Command::Bench(arguments) => bench::run(arguments),
        Command::Adapter(arguments) => adapter::run(arguments),
    }
}
