//! Names of the files that a build writes beside WGSL, Rust and manifest.

/// File of the curves of all profiles, beside the WGSL.
pub(crate) const PROFILE_CURVES_FILE: &str = "subsurface.curves";

/// File of the tables of tabulated profiles, beside the WGSL.
pub(crate) const PROFILE_TABLES_FILE: &str = "subsurface.tables";
