//! Files on disk or in memory, each read once, within limits.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::diagnostics::{Diagnostic, Report};
use crate::source::{FileId, Span};

/// Largest file that is read, in bytes. The largest material known to us has 2 KiB.
pub const LARGEST_FILE: u64 = 1024 * 1024;

/// Reads files, and keeps a record of it.
#[derive(Debug)]
pub(super) struct Reader {
    pub(super) report: Report,
    origin: Origin,
    files: BTreeSet<PathBuf>,
    directories: BTreeSet<PathBuf>,
}

#[derive(Debug)]
enum Origin {
    Disk,
    Memory(BTreeMap<PathBuf, Vec<u8>>),
}

impl Reader {
    pub(super) fn disk() -> Self {
        Self::new(Origin::Disk)
    }

    pub(super) fn memory(files: BTreeMap<PathBuf, Vec<u8>>) -> Self {
        Self::new(Origin::Memory(files))
    }

    fn new(origin: Origin) -> Self {
        Self { report: Report::default(), origin, files: BTreeSet::new(), directories: BTreeSet::new() }
    }

    /// The report, the files read and the directories listed.
    pub(super) fn finish(self) -> (Report, Vec<PathBuf>, Vec<PathBuf>) {
        (self.report, self.files.into_iter().collect(), self.directories.into_iter().collect())
    }

    /// The text of a file that was read.
    pub(super) fn text(&self, file: FileId) -> Arc<str> {
        Arc::clone(self.report.sources().text(file))
    }

    /// The `.ron` files of a directory, sorted. A directory that is not `required` may be missing.
    pub(super) fn list(&mut self, dir: &Path, required: bool) -> Vec<PathBuf> {
        let listed = match &self.origin {
            Origin::Disk => list_disk(dir),
            Origin::Memory(files) => {
                Ok(files.keys().filter(|path| path.parent() == Some(dir)).cloned().collect())
            }
        };
        match listed {
            Ok(mut paths) => {
                self.directories.insert(dir.to_owned());
                paths.retain(|path| path.extension().is_some_and(|extension| extension == "ron"));
                paths.sort();
                paths
            }
            Err(error) if !required && error.kind() == io::ErrorKind::NotFound => Vec::new(),
            Err(error) => {
                let help = match error.kind() {
                    io::ErrorKind::NotFound => {
                        "create the directory, with a file `NAME.ron` for each material"
                    }
                    io::ErrorKind::NotADirectory => "give the directory that holds the materials, not a file",
                    _ => "make the directory readable for this user",
                };
                let message = format!("cannot read the directory `{}`: {}", shown(dir), reason(&error));
                self.report.push(Diagnostic::error(message).help(help));
                Vec::new()
            }
        }
    }

    /// Reads a file; `None` when that fails, which is reported.
    pub(super) fn read(&mut self, path: &Path) -> Option<FileId> {
        self.files.insert(path.to_owned());
        let read = match &self.origin {
            Origin::Disk => read_disk(path),
            Origin::Memory(files) => match files.get(path) {
                Some(bytes) if bytes.len() as u64 > LARGEST_FILE => {
                    Ok(Contents::TooLarge(bytes.len() as u64))
                }
                Some(bytes) => Ok(Contents::Bytes(bytes.clone())),
                None => Err(io::ErrorKind::NotFound.into()),
            },
        };
        let bytes = match read {
            Ok(Contents::Bytes(bytes)) => bytes,
            Ok(Contents::TooLarge(size)) => {
                let file = self.report.sources_mut().add(path, "");
                self.report.push(
                    Diagnostic::error(format!(
                        "the file has {size} bytes, more than the limit of {LARGEST_FILE} bytes (1 MiB)"
                    ))
                    .label(Span::new(file, 0..0), "not read")
                    .help("a material has a few lines: is this another kind of file?"),
                );
                return None;
            }
            Err(error) => {
                let message = format!("cannot read `{}`: {}", shown(path), reason(&error));
                self.report
                    .push(Diagnostic::error(message).help("check that the file exists and is readable"));
                return None;
            }
        };
        match String::from_utf8(bytes) {
            Ok(text) => Some(self.report.sources_mut().add(path, text)),
            Err(error) => {
                let offset = error.utf8_error().valid_up_to();
                let byte = error.as_bytes().get(offset).copied().unwrap_or_default();
                // The text before the first bad byte is valid, so offsets up to it stay the same.
                let text = String::from_utf8_lossy(error.as_bytes()).into_owned();
                let end = text[offset..].chars().next().map_or(offset, |c| offset + c.len_utf8());
                let file = self.report.sources_mut().add(path, text);
                self.report.push(
                    Diagnostic::error("the file is not UTF-8")
                        .label(
                            Span::new(file, offset..end),
                            format!("byte 0x{byte:02X} at offset {offset} begins no UTF-8 character"),
                        )
                        .help("save the file as UTF-8"),
                );
                None
            }
        }
    }
}

enum Contents {
    Bytes(Vec<u8>),
    TooLarge(u64),
}

fn list_disk(dir: &Path) -> io::Result<Vec<PathBuf>> {
    let mut paths = Vec::new();
    for entry in fs::read_dir(dir)? {
        let path = entry?.path();
        // A folder that happens to be called `x.ron` is no file; a link to nowhere is one that cannot be read.
        if !path.is_dir() {
            paths.push(path);
        }
    }
    Ok(paths)
}

fn read_disk(path: &Path) -> io::Result<Contents> {
    let metadata = fs::metadata(path)?;
    if !metadata.is_file() {
        // Opening a pipe would wait for a writer.
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "it is not a regular file"));
    }
    if metadata.len() > LARGEST_FILE {
        return Ok(Contents::TooLarge(metadata.len()));
    }
    let mut bytes = Vec::new();
    fs::File::open(path)?.take(LARGEST_FILE + 1).read_to_end(&mut bytes)?;
    let size = bytes.len() as u64; // a file may grow between the two calls
    Ok(if size > LARGEST_FILE { Contents::TooLarge(size) } else { Contents::Bytes(bytes) })
}

/// The reason in words that are the same on every system, where there are some.
fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "it does not exist".to_owned(),
        io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
        io::ErrorKind::NotADirectory => "it is not a directory".to_owned(),
        _ => error.to_string(),
    }
}

fn shown(path: &Path) -> String {
    path.to_string_lossy().replace(std::path::MAIN_SEPARATOR, "/")
}
