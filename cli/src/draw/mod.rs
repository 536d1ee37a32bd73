//! Where scenes and buffers meet the GPU.
//!
//! The commands prepare a [`Frame`] or [`Buffers`] and save what comes back; a [`Studio`] draws frames, [`diffuse`] runs
//! the subsurface pass alone.

mod buffers;
pub mod device;
mod studio;

pub use buffers::{Buffers, PixelScale, diffuse};
pub use studio::{Drawn, Frame, Studio};

use subsurface_codegen::Compilation;
use subsurface_runtime::SubsurfaceKernel;

use crate::failure::Failure;

/// The number of taps when none is asked for.
pub const DEFAULT_TAPS: u32 = subsurface_runtime::SubsurfaceView::DEFAULT_TAPS;
/// The most taps that may be asked for.
pub const LARGEST_TAPS: u32 = 4096;

/// The kernel of compiled materials.
fn kernel(materials: &Compilation) -> Result<SubsurfaceKernel, Failure> {
    let (wgsl, table) = (materials.wgsl.clone(), materials.material_table.clone());
    SubsurfaceKernel::new(wgsl, table, materials.material_names(), materials.profile_tables.clone())
        .map_err(|error| Failure::new(error.to_string(), "please report this as a defect of the compiler"))
}

/// A size that the device refuses.
fn beyond_device(error: &impl std::error::Error) -> Failure {
    Failure::new(
        error.to_string(),
        "make the picture smaller: --size times --supersample, or the buffers that are given",
    )
}
