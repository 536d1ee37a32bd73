//! Texts that a command prints or writes.

use crate::failure::Failure;
use crate::picture::file;
use std::io::{ErrorKind, Write as _};
use std::path::Path;

/// Prints a text to standard output. A reader that has seen enough (`… | head`) is no failure.
pub(super) fn print(text: &str) -> Result<(), Failure> {
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        Err(error) => Err(Failure::new(format!("cannot print: {error}"), "check where standard output goes")),
        Ok(()) => Ok(()),
    }
}

/// Writes a text to a file, whole or not at all; `-` is standard output.
pub(super) fn write(path: &Path, text: &str) -> Result<(), Failure> {
    if path.as_os_str() == "-" {
        return print(text);
    }
    Ok(file::write_atomically(path, text.as_bytes())?)
}

/// Refuses a file whose folder does not exist, before long work begins.
pub(super) fn check(path: &Path) -> Result<(), Failure> {
    if path.as_os_str() != "-" {
        file::folder_of(path)?;
    }
    Ok(())
}

/// Reads a text file.
pub(super) fn read(path: &Path) -> Result<String, Failure> {
    std::fs::read_to_string(path).map_err(|reason| {
        let help = match reason.kind() {
            ErrorKind::InvalidData => "expected a text file in UTF-8",
            _ => "check the path",
        };
        Failure::new(format!("cannot read {}: {reason}", path.display()), help)
    })
}
