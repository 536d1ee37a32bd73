//! The contract between material compiler and passes, typed.
//!
//! The central type is [`KernelParts`]: a WGSL module, the rows of its materials, and the curves and tables of their
//! profiles. The compiler builds it, the passes take it; [`KernelParts::builder`] refuses parts that do not fit. An
//! [`Estimator`] says how light is gathered, a [`DebugView`] what a pass can show instead, and [`constants`] holds every
//! number that stands in Rust and in WGSL: the compiler writes them into the module from here.
//!
//! ```
//! use subsurface_kernel::Estimator;
//!
//! let estimator: Estimator = "interleaved:8".parse()?;
//! assert_eq!(estimator, Estimator::Interleaved { taps: 8 });
//! assert_eq!(estimator.to_string(), "Interleaved, 8 taps");
//! # Ok::<(), subsurface_kernel::EstimatorError>(())
//! ```
//!
//! What this crate does not know: naga, wgpu, files, materials, and how light scatters.

mod compute_shape;
pub mod constants;
mod debug_view;
mod estimator;
mod module;
mod output_format;
mod parts;
mod parts_error;
mod rejection;
mod tap_counts;

pub use compute_shape::ComputeShape;
pub use constants::{Constant, ConstantValue};
pub use debug_view::DebugView;
pub use estimator::{Estimator, EstimatorError};
pub use module::{KernelModule, RowBinding};
pub use output_format::OutputFormat;
pub use parts::{KernelParts, KernelPartsBuilder};
pub use parts_error::PartsError;
pub use rejection::{Rejected, Rejection};
pub use tap_counts::TapCounts;
