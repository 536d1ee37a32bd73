//! Which of a kernel's two forms a device runs.

use crate::loaded_kernel::LoadedKernel;
use crate::pass::PassError;
use crate::texture_format::output_format;
use crate::wgpu;

/// Which shader stages do the work. Both give the same picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Path {
    /// Compute shaders over the tiles that hold translucent pixels.
    Compute,
    /// Fragment shaders, with the stencil if there is one.
    Fragment,
}

/// The path that a pass takes, and why it is not the compute path, if it is not.
pub(super) fn choose(
    device: &wgpu::Device,
    kernel: &LoadedKernel,
    format: wgpu::TextureFormat,
    wanted: Option<Path>,
) -> Result<(Path, Option<PassError>), PassError> {
    let compute = check_compute(device, kernel, format, wanted == Some(Path::Compute));
    match (wanted, compute) {
        (Some(Path::Compute) | None, Ok(())) => Ok((Path::Compute, None)),
        (Some(Path::Compute), Err(refusal)) => Err(refusal),
        (Some(Path::Fragment) | None, refusal) => {
            check_render(device, format)?;
            Ok((Path::Fragment, refusal.err()))
        }
    }
}

/// Whether the compute path of `kernel` runs on the device and can write `format`.
///
/// Without the feature that tells of its own, a device promises what WebGPU does. With it a caller who asks for the path
/// may know more.
fn check_compute(
    device: &wgpu::Device,
    kernel: &LoadedKernel,
    format: wgpu::TextureFormat,
    is_wanted: bool,
) -> Result<(), PassError> {
    let limits = device.limits();
    // The tiles, the arguments of the dispatch, and what of the kernel's own lies in storage buffers.
    let storage_buffers = 2 + kernel.storage_buffers();
    let large_enough = limits.max_compute_invocations_per_workgroup >= 256
        && limits.max_compute_workgroup_size_x >= 16
        && limits.max_compute_workgroup_size_y >= 16
        && limits.max_compute_workgroups_per_dimension >= 65535
        && limits.max_storage_buffers_per_shader_stage >= storage_buffers
        && limits.max_storage_textures_per_shader_stage >= 4;
    if !large_enough {
        return Err(PassError::NoCompute);
    }
    let features = device.features();
    let adapter_knows =
        is_wanted && features.contains(wgpu::Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES);
    let Some(output) = output_format(format).filter(|_| {
        features.contains(format.required_features())
            && (adapter_knows || allows(device, format, wgpu::TextureUsages::STORAGE_BINDING))
    }) else {
        return Err(PassError::NotStorable { output: format });
    };
    if kernel.module().wgsl_for(output).is_none() {
        return Err(PassError::Format { kernel: kernel.own_format(), output: format });
    }
    Ok(())
}

/// Whether the device can render to `format`.
pub(super) fn check_render(device: &wgpu::Device, format: wgpu::TextureFormat) -> Result<(), PassError> {
    if allows(device, format, wgpu::TextureUsages::RENDER_ATTACHMENT)
        || device.features().contains(wgpu::Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES)
    {
        Ok(())
    } else {
        Err(PassError::NotRenderable { output: format })
    }
}

fn allows(device: &wgpu::Device, format: wgpu::TextureFormat, usage: wgpu::TextureUsages) -> bool {
    format.guaranteed_format_features(device.features()).allowed_usages.contains(usage)
}
