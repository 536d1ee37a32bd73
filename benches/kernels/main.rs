//! `subsurface bench kernels` with baselines written from publications: PSNR against the dense kernel, and time per
//! frame as a ratio to importance-sampled 17.
//!
//! Takes that command's arguments behind `--`. Where they name no material and no profile, the material has its own
//! profile and Burley's in turn: some of the baselines know no other. Each is held against the dense kernel with the same
//! profile.
//!
//! The baselines take an object's one profile and surface albedo (`--uniform-albedo` for meshes with textures). What
//! their engines do about the cost of memory (tiles in workgroup memory, packed targets) is left out; they run over every
//! pixel and leave the background early.

#![allow(clippy::print_stderr, reason = "a benchmark speaks to its user")]

mod burley;
mod eevee;
mod hdrp;
mod pass;
mod separable;
mod uniform_disc;
mod uniform_subject;

use std::ffi::OsString;
use std::process::ExitCode;
use subsurface_cli::command::bench::{KernelsArguments, run_kernels};
use subsurface_cli::kernel_bench::Contender;

/// The profile for baselines that know no other.
const BURLEY: &str = "burley_searchlight";

fn main() -> ExitCode {
    // Cargo adds this to whatever it runs as a benchmark.
    let given: Vec<OsString> = std::env::args_os().skip(1).filter(|argument| argument != "--bench").collect();
    let mut arguments = KernelsArguments::parse_or_exit(given.clone());
    let chooses_profile = |argument: &OsString| {
        let text = argument.to_string_lossy();
        ["--profile", "--material"].iter().any(|name| text.starts_with(name))
    };
    if !given.iter().any(chooses_profile) {
        arguments.profiles.push(BURLEY.to_owned());
    }
    match run_kernels(&arguments, baselines()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("{}", failure.render());
            ExitCode::from(failure.exit_code())
        }
    }
}

fn baselines() -> Vec<Box<dyn Contender>> {
    let mut all: Vec<Box<dyn Contender>> = Vec::new();
    all.extend([21, 55].map(|budget| -> Box<dyn Contender> { Box::new(hdrp::Hdrp { budget }) }));
    all.push(Box::new(eevee::Eevee));
    all.extend([11, 17, 25].map(|taps| -> Box<dyn Contender> { Box::new(separable::Separable { taps }) }));
    all.extend([17, 33].map(|taps| -> Box<dyn Contender> { Box::new(uniform_disc::UniformDisc { taps }) }));
    all
}
