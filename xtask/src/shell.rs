//! Programs that the commands start.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Why a command stopped: a message for its user.
#[derive(Debug)]
pub(crate) struct Failure(pub(crate) String);

/// The repository's root.
pub(crate) fn root() -> PathBuf {
    let manifest = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    manifest.parent().map(PathBuf::from).unwrap_or(manifest)
}

/// Cargo's target folder: the one that this program was built in.
pub(crate) fn target() -> PathBuf {
    let own = std::env::current_exe().ok();
    // target/debug/xtask
    let target = own.as_deref().and_then(Path::parent).and_then(Path::parent).map(Path::to_owned);
    target.unwrap_or_else(|| root().join("target"))
}

/// The Cargo that runs this program, in the root.
pub(crate) fn cargo() -> Command {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.current_dir(root());
    command
}

/// Runs to the end; another exit status than 0 is a failure.
pub(crate) fn run(command: &mut Command) -> Result<(), Failure> {
    let program = command.get_program().to_string_lossy().into_owned();
    match command.current_dir(root()).status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(Failure(format!("`{program}` ended with {status}"))),
        Err(error) => Err(Failure(format!("cannot start `{program}`: {error}"))),
    }
}
