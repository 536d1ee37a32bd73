//! Compiles materials in RON to validated WGSL kernels and typed Rust bindings.
//!
//! The central type is [`Compiler`]: a directory of materials in, a [`Compilation`] out (WGSL, Rust, a JSON manifest, the
//! bytes of the parameter table and the curves of the profiles), or a [`Report`] with every error of every file. Which
//! [`Estimator`] diffuses is a choice of the set, or of the caller.
//!
//! In a `build.rs`:
//!
//! ```no_run
//! subsurface_codegen::Compiler::new("materials").build_or_exit();
//! ```
//!
//! and in the crate, `include!(concat!(env!("OUT_DIR"), "/subsurface.rs"));` brings the materials as an enum, the kernel
//! and its typed bindings. The front half (loading, checking, diagnostics) ends in a [`MaterialSet`]; the back half links
//! the shaders that the set needs, validates them with naga and reflects them.
//!
//! What this crate does not know: the GPU; how light scatters (that is `subsurface-profile`'s, and the shaders').

mod bindings;
mod clear;
mod compiler;
mod compose;
mod constants;
mod curves;
pub mod diagnostics;
mod dispatch_text;
mod docs;
mod draft;
mod emit;
mod excerpt;
mod file_names;
mod identifier;
mod item;
mod layout;
mod lint;
pub mod load;
mod manifest;
pub mod material;
mod material_row;
mod mixture_text;
mod model_row;
mod no_profile;
mod output;
mod profile_text;
mod quality;
mod quality_request;
mod reflect;
mod report;
mod resolve;
mod schema;
pub mod source;
mod specular_albedo;
mod suggestion;
mod syntax;
mod table;
mod unrolled;
mod validate;
mod value;
mod value_mismatch;

pub use clear::ClearMaterial;
pub use compiler::{Compilation, Compiler, Pass, runtime_bindings};
pub use diagnostics::{Diagnostic, Severity};
pub use load::{
    Checked, Loaded, LoadedProfile, LoadedTable, check_paths, load_directory, load_memory, load_profile,
    load_profile_file, load_radial_table,
};
pub use material::{DiffuseLobe, Material, MaterialSet, ResolvedProfile};
pub use output::BuildError;
pub use profile_text::profile_file_text;
pub use quality_request::QualityRequest;
pub use report::Report;
pub use source::{FileId, SourceMap, Span, Spanned};
pub use subsurface_kernel::{Estimator, KernelParts, OutputFormat, Rejected, Rejection};
pub use subsurface_quality::{PictureReport, Quality, QualityReport, Tier, TierReport};
