//! Programs of other projects that the gate runs.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::shell::{self, cargo, run};

/// A program from a crate on crates.io.
pub(crate) struct Tool {
    /// Name of the program.
    program: &'static str,
    /// Name of the crate.
    package: &'static str,
    /// The version that the gate installs; another that is there already is good as well.
    version: &'static str,
    /// True if the gate may build it: without optimization, that takes at most three minutes on two cores.
    is_quick_to_build: bool,
}

/// Spell checker.
pub(crate) const TYPOS: Tool =
    Tool { program: "typos", package: "typos-cli", version: "1.52.0", is_quick_to_build: true };

/// Licences, bans and sources of dependencies.
pub(crate) const CARGO_DENY: Tool =
    Tool { program: "cargo-deny", package: "cargo-deny", version: "0.20.2", is_quick_to_build: false };

/// Where a tool is, or why it is nowhere.
#[derive(Debug)]
pub(crate) enum Found {
    At(PathBuf),
    Not(String),
}

/// Looks for the tool on `PATH` and among those that an earlier run installed; installs it if that is quick.
pub(crate) fn find(tool: &Tool) -> Found {
    let installed = folder().join("bin").join(format!("{}{}", tool.program, std::env::consts::EXE_SUFFIX));
    for program in [Path::new(tool.program), &installed] {
        if starts(program) {
            return Found::At(program.to_owned());
        }
    }
    let command = format!("cargo install {} --locked", tool.package);
    if !tool.is_quick_to_build {
        return Found::Not(format!("`{}` is not installed (`{command}`)", tool.program));
    }
    match install(tool) {
        Ok(()) if starts(&installed) => Found::At(installed),
        Ok(()) => Found::Not(format!("`{}` was installed, and does not start", tool.program)),
        Err(why) => Found::Not(format!("`{}` cannot be installed: {why} (`{command}`)", tool.program)),
    }
}

/// In the target folder: `cargo clean` removes what the gate installed, and nothing else of the user's is touched.
fn folder() -> PathBuf {
    shell::target().join("tools")
}

fn install(tool: &Tool) -> Result<(), String> {
    println!("Installing {} {} into {} …", tool.package, tool.version, folder().display());
    let mut command = cargo();
    // Neither optimized nor for a debugger: a tool runs for seconds, and either takes minutes.
    command.args([
        "install",
        tool.package,
        "--locked",
        "--debug",
        "--quiet",
        "--version",
        tool.version,
        "--root",
    ]);
    // A folder of its own for the build: the tool shares no artifact with the workspace, and leaves none behind.
    command.arg(folder()).env_remove("CARGO_TARGET_DIR").env("CARGO_PROFILE_DEV_DEBUG", "false");
    run(&mut command).map_err(|failure| failure.0)
}

fn starts(program: &Path) -> bool {
    let mut command = Command::new(program);
    command.arg("--version").stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command.status().is_ok_and(|status| status.success())
}
