//! Compiles materials in RON to validated WGSL kernels and typed Rust bindings.

mod bindings;
mod compiler;
mod compose;
pub mod diagnostics;
mod docs;
mod emit;
mod excerpt;
mod identifier;
mod item;
mod layout;
mod lint;
pub mod load;
mod manifest;
pub mod material;
mod output;
mod reflect;
mod resolve;
mod schema;
pub mod source;
mod suggestion;
mod syntax;
mod validate;
mod value;

pub use compiler::{Compilation, Compiler, Pass, runtime_bindings};
pub use diagnostics::{Diagnostic, Report, Severity};
pub use load::{
    Checked, Loaded, LoadedProfile, check_paths, load_directory, load_memory, load_profile, load_profile_file,
};
pub use material::{Material, MaterialSet, ResolvedProfile};
pub use output::BuildError;
pub use source::{FileId, SourceMap, Span, Spanned};
