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

use subsurface_codegen::{Compilation, Kernel};
use subsurface_runtime::{KernelKind, KernelParts, Path, SubsurfaceKernel, SubsurfacePass, wgpu};

use crate::failure::Failure;
use device::Device;

/// The most taps that may be asked for.
pub const LARGEST_TAPS: u32 = 4096;

/// The kernel of compiled materials.
pub(crate) fn kernel(materials: &Compilation) -> Result<SubsurfaceKernel, Failure> {
    let kind = match materials.kernel {
        Kernel::ImportanceSampled { .. } => KernelKind::ImportanceSampled,
        Kernel::Separable { .. } => KernelKind::Separable,
        Kernel::Interleaved { .. } => KernelKind::Interleaved,
        Kernel::Dense => KernelKind::Dense,
        other => {
            let message = format!("the kernel {other} is not known to this program");
            return Err(Failure::new(message, "choose another with --kernel"));
        }
    };
    let parts = KernelParts {
        wgsl: materials.wgsl.clone().into(),
        material_table: materials.material_table.clone().into(),
        material_names: materials.material_names().into_iter().map(Into::into).collect(),
        profile_tables: materials.profile_tables.clone().into(),
        profile_curves: materials.profile_curves.clone().into(),
        curve_size: materials.curve_size,
        kind,
        taps: materials.kernel.taps(),
    };
    SubsurfaceKernel::new(parts)
        .map_err(|error| Failure::new(error.to_string(), "please report this as a defect of the compiler"))
}

/// The subsurface pass on a path of the caller's choice, or on the best that the device has.
pub(crate) fn subsurface_pass(
    device: &Device,
    kernel: &SubsurfaceKernel,
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
