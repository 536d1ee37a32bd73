//! Where scenes and buffers meet the GPU.
//!
//! The commands prepare a [`Frame`] or [`Buffers`] and save what comes back; a [`Studio`] draws frames, [`diffuse`] runs
//! the subsurface pass alone.

mod buffers;
pub mod device;
mod diffuse;
mod route;
mod studio;
mod uploaded;

pub use buffers::{Buffers, PixelScale};
pub use diffuse::diffuse;
pub use route::Route;
pub use studio::{Drawn, Frame, Needs, Shown, Studio, Timings};
pub use uploaded::{Precision, Uploaded};

use subsurface_runtime::{FrameError, KernelParts, LoadedKernel, SubsurfaceDescriptor, SubsurfacePass, wgpu};

use crate::failure::Failure;
use device::Device;

/// The most taps that may be asked for.
pub use subsurface_kernel::constants::LARGEST_TAP_COUNT as LARGEST_TAPS;

/// The kernel on the device.
pub(crate) fn load(device: &Device, kernel: &KernelParts) -> Result<LoadedKernel, Failure> {
    LoadedKernel::new(&device.device, &device.queue, kernel).map_err(|error| {
        Failure::new(error.to_string(), "give the set fewer materials, or choose another adapter")
    })
}

/// The subsurface pass as the caller chose, or as suits the device.
pub(crate) fn subsurface_pass(
    device: &Device,
    kernel: &KernelParts,
    format: wgpu::TextureFormat,
    Route { path, shape }: Route,
) -> Result<SubsurfacePass, Failure> {
    let descriptor = SubsurfaceDescriptor { path, shape, ..SubsurfaceDescriptor::new(format) };
    SubsurfacePass::new(&device.device, &load(device, kernel)?, &descriptor)
        .map_err(|error| Failure::new(error.to_string(), "choose another --path, or none"))
}

/// A size that the device refuses.
pub(crate) fn beyond_device(error: &impl std::error::Error) -> Failure {
    Failure::new(
        error.to_string(),
        "make the picture smaller: --size times --supersample, or the buffers that are given",
    )
}

/// A call that came too early: ours.
pub(crate) fn out_of_order(error: FrameError) -> Failure {
    Failure::new(error.to_string(), "please report this as a defect")
}
