//! Files that hold a run.

use crate::failure::Failure;
use crate::picture::file;
use std::io::ErrorKind;
use std::path::Path;
use subsurface_reference::{HalfSpace, Run};

/// Reads a run.
pub(super) fn read(path: &Path) -> Result<Run, Failure> {
    match read_if_there(path)? {
        Some(run) => Ok(run),
        None => Err(Failure::new(
            format!("there is no file {}", path.display()),
            "`subsurface reference simulate --out FILE` makes one",
        )),
    }
}

/// Reads a run, if there is a file.
pub(super) fn read_if_there(path: &Path) -> Result<Option<Run>, Failure> {
    let bytes = match std::fs::read(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        Err(error) => {
            return Err(Failure::new(format!("cannot read {}: {error}", path.display()), "check the path"));
        }
        Ok(bytes) => bytes,
    };
    Run::from_bytes(&bytes).map(Some).map_err(|error| {
        let text = error.to_string();
        let (message, help) = text.split_once(": ").unwrap_or((&text, "simulate again"));
        Failure::new(format!("{}: {message}", path.display()), help)
    })
}

/// Writes a run, whole or not at all.
pub(super) fn write(path: &Path, run: &Run) -> Result<(), Failure> {
    Ok(file::write_atomically(path, &run.to_bytes())?)
}

/// A half-space in words.
pub(super) fn describe(half_space: HalfSpace) -> String {
    let entry = match half_space.entry() {
        subsurface_reference::Entry::Searchlight => "searchlight",
        subsurface_reference::Entry::Diffuse => "diffuse",
        _ => "another",
    };
    let (g, eta) = (half_space.anisotropy(), half_space.refractive_index());
    format!("{entry} entry, anisotropy {g}, refractive index {eta}")
}
