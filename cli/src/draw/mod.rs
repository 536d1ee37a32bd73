//! Where scenes and buffers meet the GPU.
//!
//! The commands prepare a [`Frame`] or [`Buffers`] and save what comes back; a [`Studio`] draws frames, [`diffuse`] runs
//! the subsurface pass alone.

mod buffers;
pub mod device;
mod studio;
mod uploaded;

pub use buffers::{Buffers, PixelScale, diffuse};
pub use studio::{Drawn, Frame, Shown, Studio};
pub use uploaded::{Precision, Uploaded};

use subsurface_runtime::{KernelParts, Path, SubsurfacePass, wgpu};

use crate::failure::Failure;
use device::Device;

/// The most taps that may be asked for.
pub const LARGEST_TAPS: u32 = 4096;

/// The subsurface pass on a path of the caller's choice, or on the best that the device has.
pub(crate) fn subsurface_pass(
    device: &Device,
    kernel: &KernelParts,
    format: wgpu::TextureFormat,
    stencil: Option<wgpu::TextureFormat>,
    path: Option<Path>,
) -> Result<SubsurfacePass, Failure> {
    let device = &device.device;
    match path {
        None => Ok(SubsurfacePass::new(device, kernel, format, stencil)),
        Some(path) => SubsurfacePass::with_path(device, kernel, format, stencil, path)
            .map_err(|error| Failure::new(error.to_string(), "choose another --path, or none")),
    }
}

/// A size that the device refuses.
pub(crate) fn beyond_device(error: &impl std::error::Error) -> Failure {
    Failure::new(
        error.to_string(),
        "make the picture smaller: --size times --supersample, or the buffers that are given",
    )
}
