//! The `subsurface` command line.

#![allow(clippy::print_stderr, reason = "the last word of a command that failed")]

use clap::Parser as _;
use std::process::ExitCode;
use subsurface_cli::command::{self, Arguments};
use subsurface_cli::failure::Failure;

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => match error.downcast_ref::<Failure>() {
            Some(failure) => {
                eprintln!("{}", failure.render());
                ExitCode::from(failure.exit_code())
            }
            None => {
                eprintln!("error: {error:#}");
                ExitCode::FAILURE
            }
        },
    }
}

fn run() -> anyhow::Result<()> {
    Ok(command::run(&Arguments::parse())?)
}
