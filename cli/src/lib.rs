//! The parts of the `subsurface` command line: scenes, picture files and the commands themselves.
//!
//! Scene loading, image files, labels and progress bars live here and nowhere deeper. [`command`] holds one file per
//! command; [`draw`] is where scenes and buffers meet the GPU.
//!
//! Without the feature `analysis` (a default), the commands `profile`, `reference` and `bench` are left out, with all
//! that only they need.
//!
//! # What this crate does not know
//!
//! Profile formulas, WGSL, and what a material file may contain.

pub mod command;
pub mod draw;
pub mod failure;
#[cfg(feature = "analysis")]
pub mod kernel_bench;
pub mod mitsuba;
pub mod picture;
#[cfg(feature = "analysis")]
pub mod picture_bench;
#[cfg(feature = "analysis")]
pub mod plot;
pub mod progress;
pub mod scene;
mod suggestion;
#[cfg(feature = "analysis")]
pub mod table;
pub mod terminal;
