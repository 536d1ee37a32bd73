//! Output formats of kernels, as wgpu names them.

use subsurface_kernel::OutputFormat;

/// The texture format of a kernel's output format.
pub fn texture_format(format: OutputFormat) -> Option<wgpu::TextureFormat> {
    Some(match format {
        OutputFormat::Rgba8Unorm => wgpu::TextureFormat::Rgba8Unorm,
        OutputFormat::Rgba16Float => wgpu::TextureFormat::Rgba16Float,
        OutputFormat::Rgba32Float => wgpu::TextureFormat::Rgba32Float,
        OutputFormat::Rg11b10Ufloat => wgpu::TextureFormat::Rg11b10Ufloat,
        OutputFormat::Rgb10a2Unorm => wgpu::TextureFormat::Rgb10a2Unorm,
        OutputFormat::Rgba16Unorm => wgpu::TextureFormat::Rgba16Unorm,
        _ => return None,
    })
}
