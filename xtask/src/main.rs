//! The commands of the README: `cargo xtask demo`, `test`, `ci`, `bless`, `accuracy`, `pictures`, `tables` and
//! `shader-cost`.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a command line speaks to its user")]

mod driver;
mod gate;
mod page;
mod shader_cost;
mod shell;
mod tables;
mod tool;
mod toolchain;

use std::process::{Command, ExitCode};

use driver::Build;
use shell::{Failure, cargo, run};

const HELP: &str = "\
The commands of this repository.

Usage: cargo xtask <COMMAND>

Commands:
  demo    Find or install a Vulkan driver, build, and render a labelled contact sheet of the profile models
  test    Find or install a Vulkan driver, then run every test
  ci [--quick] [--keep-going]
          The gate: formatting, spelling, dependencies, lints, documentation, every test, wgpu 29, accuracy, tables,
          shader cost and the oldest Rust; ends with what was run, how long it took, and what was not run and why. With
          --quick, only formatting, lints and unit tests; with --keep-going, the steps after a failed one too
  bless   Accept the texts and pictures that the tests now produce; then look at `git diff`
  accuracy [--check]
          Write docs/accuracy.md and its figures by running the commands that stand in xtask/accuracy.md; with
          --check, write nothing and fail where the files in docs differ from what the commands give
  pictures
          Write docs/pictures.md and its sheets by running the commands that stand in xtask/pictures.md: pictures against
          those of a path tracer in reference/pictures
  tables [--check]
          Write the tables of README.md and materials/README.md that commands print; with --check, write nothing and
          fail where they differ
  shader-cost [OPTIONS]
          What GPU compilers make of the kernels: registers, spills, occupancy, cycles, loads; --help says more

Examples:
  cargo xtask demo
  cargo xtask demo --size 480x600 --taps 128
  cargo xtask test -p subsurface-runtime
  cargo xtask ci --quick
  cargo xtask accuracy --check
  cargo xtask shader-cost --gpu navi21 --kernel interleaved:4
";

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let command = arguments.next();
    let rest: Vec<String> = arguments.collect();
    let result = match command.as_deref() {
        Some("demo") => demo(&rest),
        Some("test") => test(&rest),
        Some("ci") => gate::run_command(&rest),
        Some("bless") => bless(&rest),
        Some("accuracy") => page::ACCURACY.run_command(&rest),
        Some("pictures") => page::PICTURES.run_command(&rest),
        Some("tables") => tables::run_command(&rest),
        Some("shader-cost") => shader_cost::run_command(&rest),
        Some("help" | "--help" | "-h") => {
            print!("{HELP}");
            Ok(())
        }
        _ => {
            eprint!("{HELP}");
            return ExitCode::from(2);
        }
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(Failure(message)) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

/// Renders the contact sheet; further arguments go to `subsurface contact-sheet`.
fn demo(arguments: &[String]) -> Result<(), Failure> {
    driver::ensure(Build::Demo)?;
    let sheet = shell::root().join("target").join("demo").join("contact-sheet.png");
    std::fs::create_dir_all(sheet.parent().unwrap_or(&sheet))
        .map_err(|error| Failure(format!("cannot make the folder of {}: {error}", sheet.display())))?;
    run(Build::Demo.program().args(["contact-sheet", "--out"]).arg(&sheet).args(arguments))
}

/// Runs every test; further arguments go to `cargo test`.
fn test(arguments: &[String]) -> Result<(), Failure> {
    driver::ensure(Build::Test)?;
    run(&mut cargo_test(arguments))
}

/// Runs the tests that compare with stored results and stores what they produce now.
fn bless(arguments: &[String]) -> Result<(), Failure> {
    driver::ensure(Build::Test)?;
    run(cargo_test(arguments).env("INSTA_UPDATE", "always").env("SUBSURFACE_BLESS", "1"))
}

/// `cargo test` of the packages that the arguments name, or of all.
fn cargo_test(arguments: &[String]) -> Command {
    let mut command = cargo();
    command.arg("test");
    if !arguments.iter().any(|argument| argument.starts_with("-p") || argument.starts_with("--package")) {
        command.arg("--workspace");
    }
    command.args(arguments);
    command
}
