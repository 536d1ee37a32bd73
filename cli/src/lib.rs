//! The parts of the `subsurface` command line: scenes, picture files and the commands themselves.
//!
//! Scene loading, image files, labels and progress bars live here and nowhere deeper. [`command`] holds one file per
//! command; [`draw`] is where scenes and buffers meet the GPU.
//!
//! # What this crate does not know
//!
//! Profile formulas, WGSL, and what a material file may contain.

pub mod command;
pub mod draw;
pub mod failure;
pub mod kernel_bench;
pub mod picture;
pub mod plot;
pub mod progress;
pub mod scene;
mod suggestion;
pub mod table;
pub mod terminal;
