//! Files on disk or in memory, each read once, within limits.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::{self, Read};
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use crate::diagnostics::Diagnostic;
use crate::report::Report;
use crate::source::{FileId, Span};
use crate::table::LARGEST_TABLE;

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

    /// Reads a material or profile file; `None` when that fails, which is reported.
    pub(super) fn read(&mut self, path: &Path) -> Option<FileId> {
        self.open(path, &RON).map_err(|diagnostic| self.report.push(*diagnostic)).ok()
    }

    /// Reads a table; the error has no place where there is no file.
    pub(super) fn read_table(&mut self, path: &Path) -> Result<FileId, Box<Diagnostic>> {
        // In memory there are no folders to climb.
        let path = if matches!(self.origin, Origin::Memory(_)) { lexical(path) } else { path.to_owned() };
        self.open(&path, &TABLE)
    }

    fn open(&mut self, path: &Path, kind: &Kind) -> Result<FileId, Box<Diagnostic>> {
        self.files.insert(path.to_owned());
        let read = match &self.origin {
            Origin::Disk => read_disk(path, kind.largest),
            Origin::Memory(files) => match files.get(path) {
                Some(bytes) if bytes.len() as u64 > kind.largest => {
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
                let largest = kind.largest;
                return Err(Box::new(
                    Diagnostic::error(format!(
                        "the file has {size} bytes, more than the limit of {largest} bytes ({} MiB)",
                        largest / (1024 * 1024)
                    ))
                    .label(Span::new(file, 0..0), "not read")
                    .help(kind.usual_size),
                ));
            }
            Err(error) => {
                let message = format!("cannot read `{}`: {}", shown(path), reason(&error));
                return Err(Box::new(
                    Diagnostic::error(message).help("check that the file exists and is readable"),
                ));
            }
        };
        match String::from_utf8(bytes) {
            Ok(text) => Ok(self.report.sources_mut().add(path, text)),
            Err(error) => {
                let offset = error.utf8_error().valid_up_to();
                let byte = error.as_bytes().get(offset).copied().unwrap_or_default();
                // The text before the first bad byte is valid, so offsets up to it stay the same.
                let text = String::from_utf8_lossy(error.as_bytes()).into_owned();
                let end = text[offset..].chars().next().map_or(offset, |c| offset + c.len_utf8());
                let file = self.report.sources_mut().add(path, text);
                Err(Box::new(
                    Diagnostic::error("the file is not UTF-8")
                        .label(
                            Span::new(file, offset..end),
                            format!("byte 0x{byte:02X} at offset {offset} begins no UTF-8 character"),
                        )
                        .help("save the file as UTF-8"),
                ))
            }
        }
    }
}

/// What is expected of a file.
struct Kind {
    /// Bytes.
    largest: u64,
    /// The remedy where it is larger.
    usual_size: &'static str,
}

const RON: Kind =
    Kind { largest: LARGEST_FILE, usual_size: "a material has a few lines: is this another kind of file?" };

const TABLE: Kind = Kind {
    largest: LARGEST_TABLE,
    usual_size: "a few hundred radii for each of some surface albedos describe any profile: use wider bins",
};

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

fn read_disk(path: &Path, largest: u64) -> io::Result<Contents> {
    let metadata = fs::metadata(path)?;
    if !metadata.is_file() {
        // Opening a pipe would wait for a writer.
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "it is not a regular file"));
    }
    if metadata.len() > largest {
        return Ok(Contents::TooLarge(metadata.len()));
    }
    let mut bytes = Vec::new();
    fs::File::open(path)?.take(largest + 1).read_to_end(&mut bytes)?;
    let size = bytes.len() as u64; // a file may grow between the two calls
    Ok(if size > largest { Contents::TooLarge(size) } else { Contents::Bytes(bytes) })
}

/// The path without `.` and `..`, as far as they can be left out.
fn lexical(path: &Path) -> PathBuf {
    let mut result = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir if result.file_name().is_some() => {
                result.pop();
            }
            other => result.push(other),
        }
    }
    result
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
