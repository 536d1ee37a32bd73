//! Files that appear whole or not at all.

use std::io::Write as _;
use std::path::{Path, PathBuf};

use crate::report::Report;

/// Why a build produced nothing.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BuildError {
    /// The material files have errors.
    #[error("{0}")]
    Materials(Report),
    /// A file could not be written.
    #[error("error: cannot write {}: {source}\n  = help: check that the folder exists and may be written to", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// Not called from a build script.
    #[error(
        "error: OUT_DIR is not set\n  = help: Compiler::build belongs in a build.rs; elsewhere use Compiler::compile"
    )]
    NoOutDir,
}

impl From<Report> for BuildError {
    fn from(report: Report) -> Self {
        Self::Materials(report)
    }
}

/// Writes `contents` to `path` through a temporary file beside it, unless the file holds them already: a new
/// modification time would make Cargo rebuild what depends on it.
pub(crate) fn write_if_changed(path: &Path, contents: &[u8]) -> Result<(), BuildError> {
    if std::fs::read(path).is_ok_and(|old| old == contents) {
        return Ok(());
    }
    let failed = |source| BuildError::Write { path: path.to_owned(), source };
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    std::fs::create_dir_all(folder).map_err(failed)?;
    let mut builder = tempfile::Builder::new();
    // A temporary file is its owner's alone unless told otherwise; the user's mask applies as to any new file.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = builder.tempfile_in(folder).map_err(failed)?;
    file.write_all(contents).map_err(failed)?;
    file.persist(path).map_err(|error| failed(error.error))?;
    Ok(())
}

#[cfg(all(test, unix))]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use std::fs;
    use std::os::unix::fs::PermissionsExt as _;

    #[test]
    fn a_file_is_as_readable_as_any_other() {
        let folder = tempfile::tempdir().unwrap();
        let (ours, usual) = (folder.path().join("ours"), folder.path().join("usual"));
        write_if_changed(&ours, b"x").unwrap();
        // What the system gives a new file under the umask of the user.
        fs::write(&usual, "x").unwrap();
        let mode = |path| fs::metadata(path).unwrap().permissions().mode();
        assert_eq!(mode(&ours), mode(&usual));
    }
}
