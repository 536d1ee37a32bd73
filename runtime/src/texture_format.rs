//! Output formats of kernels and texture formats of wgpu.

use subsurface_kernel::OutputFormat;

use crate::wgpu;

/// The texture format of a kernel's output format.
pub fn texture_format(format: OutputFormat) -> Option<wgpu::TextureFormat> {
    Some(match format {
        OutputFormat::Rgba8Unorm => wgpu::TextureFormat::Rgba8Unorm,
        OutputFormat::Rgba16Float => wgpu::TextureFormat::Rgba16Float,
        OutputFormat::Rgba32Float => wgpu::TextureFormat::Rgba32Float,
        OutputFormat::Rg11b10Ufloat => wgpu::TextureFormat::Rg11b10Ufloat,
        OutputFormat::Rgb10a2Unorm => wgpu::TextureFormat::Rgb10a2Unorm,
        OutputFormat::Rgba16Unorm => wgpu::TextureFormat::Rgba16Unorm,
        OutputFormat::Bgra8Unorm => wgpu::TextureFormat::Bgra8Unorm,
        _ => return None,
    })
}

/// The output format of a kernel whose compute path writes textures of `format`; `None` for formats that WGSL cannot
/// store to, such as those of depth or sRGB.
pub fn output_format(format: wgpu::TextureFormat) -> Option<OutputFormat> {
    OutputFormat::ALL.into_iter().find(|known| texture_format(*known) == Some(format))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_output_format_has_a_texture_format_of_its_own() {
        for format in OutputFormat::ALL {
            let texture = texture_format(format).expect("wgpu knows every format of WGSL");
            assert_eq!(output_format(texture), Some(format));
        }
        assert_eq!(output_format(wgpu::TextureFormat::Bgra8UnormSrgb), None);
    }
}
