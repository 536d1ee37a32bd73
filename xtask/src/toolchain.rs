//! The oldest Rust that the workspace promises to build with.

use std::process::Command;

use crate::shell::{self, Failure};

/// `rust-version` of the workspace.
pub(crate) fn oldest() -> Result<String, Failure> {
    let path = shell::root().join("Cargo.toml");
    let manifest = std::fs::read_to_string(&path)
        .map_err(|error| Failure(format!("cannot read {}: {error}", path.display())))?;
    let version = manifest.lines().find_map(|line| line.strip_prefix("rust-version = "));
    version
        .map(|version| version.trim_matches('"').to_owned())
        .ok_or_else(|| Failure("Cargo.toml has no line `rust-version = \"…\"`".to_owned()))
}

/// The Cargo of that toolchain, in the root; `None` if it is not installed.
pub(crate) fn cargo(version: &str) -> Option<Command> {
    let listed = Command::new("rustup").args(["toolchain", "list"]).output().ok()?;
    let name = named(version, &String::from_utf8_lossy(&listed.stdout))?;
    let mut command = Command::new("rustup");
    command.args(["run", &name, "cargo"]).current_dir(shell::root());
    // Those of the toolchain that runs this program.
    for variable in ["CARGO", "RUSTC", "RUSTDOC", "RUSTUP_TOOLCHAIN"] {
        command.env_remove(variable);
    }
    Some(command)
}

/// The first toolchain of that version in what `rustup toolchain list` prints.
fn named(version: &str, listed: &str) -> Option<String> {
    let names = listed.lines().filter_map(|line| line.split_whitespace().next());
    let is_it = |name: &&str| {
        let rest = name.strip_prefix(version);
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '-']))
    };
    names.into_iter().find(is_it).map(str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::named;

    #[test]
    fn a_toolchain_is_found_by_its_version_whatever_its_host() {
        let listed = "stable-x86_64-unknown-linux-gnu (active, default)\n1.880.0-x86_64-unknown-linux-gnu\n\
                      1.88.0-x86_64-unknown-linux-gnu\n";
        assert_eq!(named("1.88", listed).as_deref(), Some("1.88.0-x86_64-unknown-linux-gnu"));
        assert_eq!(
            named("1.88", "1.88-aarch64-apple-darwin\n").as_deref(),
            Some("1.88-aarch64-apple-darwin")
        );
        assert_eq!(named("1.88", "stable-x86_64-unknown-linux-gnu (default)\n"), None);
    }
}
