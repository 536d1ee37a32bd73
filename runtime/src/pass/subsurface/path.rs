//! Which of a kernel's two forms a device runs.

use subsurface_kernel::{KernelParts, RowBinding};

use crate::kernel_format::texture_format;

/// Which shader stages do the work. Both give the same picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Path {
    /// Compute shaders over the tiles that hold translucent pixels.
    Compute,
    /// Fragment shaders, with the stencil if there is one.
    Fragment,
}

/// A path that the device cannot take.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PathError {
    /// No compute shaders, or too small ones.
    #[error(
        "the device has no compute shaders of 256 invocations with four storage textures and up to four storage \
         buffers: use Path::Fragment"
    )]
    NoCompute,
    /// The kernel's compute shaders write another format.
    #[error(
        "the kernel's compute path writes {kernel:?}, and the output is {output:?}: compile the kernel for that format, \
         or use Path::Fragment"
    )]
    Format {
        /// What the kernel was compiled for.
        kernel: Option<wgpu::TextureFormat>,
        /// The output's format.
        output: wgpu::TextureFormat,
    },
}

/// Whether the compute path of `kernel` runs on the device and writes `format`.
pub(super) fn check_compute(
    device: &wgpu::Device,
    kernel: &KernelParts,
    format: wgpu::TextureFormat,
) -> Result<(), PathError> {
    let limits = device.limits();
    // The tiles, the arguments of the dispatch, and what of the kernel's own lies in storage buffers.
    let storage_buffers = 2
        + u32::from(kernel.module().row_binding() == RowBinding::Storage)
        + u32::from(!kernel.profile_tables().is_empty());
    let large_enough = limits.max_compute_invocations_per_workgroup >= 256
        && limits.max_compute_workgroup_size_x >= 16
        && limits.max_compute_workgroup_size_y >= 16
        && limits.max_compute_workgroups_per_dimension >= 65535
        && limits.max_storage_buffers_per_shader_stage >= storage_buffers
        && limits.max_storage_textures_per_shader_stage >= 4;
    if !large_enough {
        return Err(PathError::NoCompute);
    }
    let of_kernel = texture_format(kernel.module().output_format());
    if of_kernel != Some(format) {
        return Err(PathError::Format { kernel: of_kernel, output: format });
    }
    Ok(())
}
