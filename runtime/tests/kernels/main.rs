//! Laws of the subsurface pass: for every kernel, every profile and both paths.
//!
//! One test program, since its modules share the kernels that they compile.

#![allow(clippy::print_stdout, reason = "measured figures, shown on request")]

#[path = "../gpu/mod.rs"]
mod gpu;

mod buffers;
mod exact;
mod setup;

mod curves;
mod debug_views;
mod edges;
mod energy;
mod errors;
mod footprints;
mod hard_light;
mod hostile;
mod inputs;
mod leaks;
mod material_table;
mod mean_free_path_scale;
mod paths;
mod rejection;
mod steps;
mod sums;
