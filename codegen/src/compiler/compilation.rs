//! What a set compiles to.

use std::path::{Path, PathBuf};

use subsurface_kernel::{Estimator, KernelParts, Rejection};

use crate::file_names::{PROFILE_CURVES_FILE, PROFILE_TABLES_FILE};
use crate::material::MaterialSet;
use crate::output::{self, BuildError};
use crate::report::Report;
use subsurface_quality::QualityReport;

/// What a set compiles to.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Compilation {
    /// What the passes take: the module with its rows, curves and tables.
    pub parts: KernelParts,
    /// Rust bindings; they include the WGSL from `subsurface.wgsl` beside them.
    pub rust: String,
    /// Reflection manifest: JSON.
    pub manifest: String,
    /// The materials, by number.
    pub set: MaterialSet,
    /// Which taps the estimator leaves out: as the compiler says, or else the set.
    pub rejection: Rejection,
    /// What the estimator was chosen by, if the set asks for an error.
    pub quality: Option<QualityReport>,
    /// SHA-256 of the inputs, hexadecimal.
    pub provenance: String,
    /// Warnings.
    pub report: Report,
    /// Every file that was read, sorted.
    pub files_read: Vec<PathBuf>,
    /// Every directory that was listed, sorted.
    pub directories_read: Vec<PathBuf>,
}

/// What the passes take, without the rest.
impl From<Compilation> for KernelParts {
    fn from(compilation: Compilation) -> Self {
        compilation.parts
    }
}

impl Compilation {
    /// The kernel module: validated WGSL.
    pub fn wgsl(&self) -> &str {
        self.parts.module().wgsl()
    }

    /// The estimator that was generated: the compiler's, or else that of the set.
    pub fn estimator(&self) -> Estimator {
        self.parts.module().estimator()
    }

    /// Names of the materials, by number.
    pub fn material_names(&self) -> Vec<String> {
        self.set.materials.iter().map(|material| material.name.clone()).collect()
    }

    /// Writes `subsurface.rs`, `subsurface.wgsl`, `subsurface.json` and `subsurface.curves` into `directory`, each whole
    /// or not at all; a file that already holds the text is left alone. A set with tabulated profiles adds
    /// `subsurface.tables`.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write_to(&self, directory: &Path) -> Result<(), BuildError> {
        for (name, contents) in [
            ("subsurface.wgsl", self.wgsl().as_bytes()),
            ("subsurface.rs", self.rust.as_bytes()),
            ("subsurface.json", self.manifest.as_bytes()),
            (PROFILE_CURVES_FILE, self.parts.profile_curves()),
            (PROFILE_TABLES_FILE, self.parts.profile_tables()),
        ] {
            // Most sets have no tables, and need no empty file.
            if !contents.is_empty() {
                output::write_if_changed(&directory.join(name), contents)?;
            }
        }
        Ok(())
    }
}
