//! Parts that do not make a kernel.

use crate::{Estimator, TapCounts};

/// Parts that do not make a kernel: they are not of one compilation.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PartsError {
    /// No material.
    #[error("a kernel needs at least one material: compile a set that has one")]
    NoMaterials,
    /// Rows of another size than the module reads.
    #[error(
        "the table has rows of {rows} bytes for a module that reads {module}: give module and rows of one compilation"
    )]
    RowStride {
        /// Bytes of a row as the module reads it.
        module: u32,
        /// Bytes of a row as given.
        rows: u32,
    },
    /// The rows are not one per material.
    #[error(
        "{bytes} bytes of rows do not hold {materials} material{s} of {stride} bytes each: give rows and names of one \
         compilation",
        s = if *materials == 1 { "" } else { "s" }
    )]
    Rows {
        /// Bytes of all rows.
        bytes: usize,
        /// Number of names.
        materials: usize,
        /// Bytes of a row.
        stride: u32,
    },
    /// The curves are not a texture of that size.
    #[error(
        "curves of {width}×{height} texels take 16 bytes each in rows of 64, not {bytes} bytes in all: give curves and \
         size of one compilation"
    )]
    ProfileCurves {
        /// Width, texels.
        width: u32,
        /// Height, texels.
        height: u32,
        /// Bytes of the curves.
        bytes: usize,
    },
    /// Profile tables that are missing, or no whole number of knots.
    #[error(
        "the module reads profile tables in knots of {stride} bytes, and {bytes} bytes of them are given: give module \
         and profile tables of one compilation"
    )]
    ProfileTables {
        /// Bytes given.
        bytes: usize,
        /// Bytes of a knot as the module reads it.
        stride: u32,
    },
    /// Profile tables for a module that reads none.
    #[error(
        "the module reads no profile tables, and {bytes} bytes of them are given: give module and profile tables of one \
         compilation"
    )]
    UnreadProfileTables {
        /// Bytes given.
        bytes: usize,
    },
    /// An estimator that the module does not hold.
    #[error(
        "{estimator} needs `{entry_point}`, and the module has {}: give the estimator that the module was compiled for",
        list(found)
    )]
    Estimator {
        /// The estimator.
        estimator: Estimator,
        /// An entry point that it needs.
        entry_point: &'static str,
        /// Those that the module has.
        found: Vec<String>,
    },
    /// Taps that the estimator cannot have.
    #[error("{estimator}: expected {expected} of taps")]
    Taps {
        /// The estimator.
        estimator: Estimator,
        /// The numbers that it may have.
        expected: TapCounts,
    },
}

fn list(names: &[String]) -> String {
    if names.is_empty() {
        return "no entry points".to_owned();
    }
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}
