//! `cargo xtask shader-cost`: builds and runs `subsurface-cost`.

use std::process::{Command, ExitStatus};

use crate::shell::{self, Failure, cargo, run};

/// Exit status of the program where nothing could be compared: another version of the compiler, or none.
const NOT_COMPARED: [i32; 2] = [3, 4];

pub(crate) fn run_command(arguments: &[String]) -> Result<(), Failure> {
    let status = start(arguments)?;
    // The program has said why.
    if status.success() { Ok(()) } else { Err(Failure(format!("shader-cost ended with {status}"))) }
}

/// Compares with the accepted figures; false where this machine's compiler cannot.
pub(crate) fn check() -> Result<bool, Failure> {
    let status = start(&["--check".to_owned()])?;
    match status.code() {
        Some(0) => Ok(true),
        Some(code) if NOT_COMPARED.contains(&code) => Ok(false),
        _ => Err(Failure("`shader-cost --check` failed: see above".to_owned())),
    }
}

/// Builds the program as the tests do, with the features that all packages want, and runs it in the root.
fn start(arguments: &[String]) -> Result<ExitStatus, Failure> {
    run(cargo().args(["test", "--quiet", "--workspace", "--test", "shader_cost", "--no-run"]))?;
    let name = format!("subsurface-cost{}", std::env::consts::EXE_SUFFIX);
    let mut program = Command::new(shell::target().join("debug").join(name));
    let status = program.args(arguments).current_dir(shell::root()).status();
    status.map_err(|error| Failure(format!("cannot start shader-cost: {error}")))
}
