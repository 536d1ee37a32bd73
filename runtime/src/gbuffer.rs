//! What the G-buffer pass draws into.

use crate::extent::{Extent, SizeError};
use crate::target::Target;
use crate::wgpu;

/// Stencil value of translucent pixels; only this bit is read or written.
pub const TRANSLUCENT_STENCIL: u32 = 1;

/// The targets of the G-buffer pass, of one size.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct GBuffer {
    /// Diffuse irradiance, linear RGB, as the camera's angle has it; alpha is what it is multiplied by where it leaves
    /// towards the camera: about 1, and 1.4 for a mirror at a grazing angle.
    pub irradiance: Target,
    /// Specular reflection + transmission: radiance that is not scattered; alpha is 0 behind all geometry, and on it 1 or
    /// the number of a diffuse lobe with the cosine at which light leaves (`pack_exit` of the shaders).
    pub unscattered: Target,
    /// Surface albedo (red, green, blue) and the material number, −1 where nothing is translucent.
    pub surface: Target,
    /// Depth and stencil: [`TRANSLUCENT_STENCIL`] marks translucent pixels.
    pub depth_stencil: Target,
    /// The depth aspect alone, for reading.
    pub depth: wgpu::TextureView,
}

impl GBuffer {
    /// Format of the colour targets: half floats hold irradiance above 1 and material numbers to 2048 exactly.
    pub const COLOUR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
    /// Format of depth and stencil: the one with a stencil that every WebGPU device has.
    pub const DEPTH_STENCIL_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth24PlusStencil8;

    /// Targets of `size`.
    ///
    /// # Errors
    /// A size of 0 or beyond the device's limit.
    pub fn new(device: &wgpu::Device, size: Extent) -> Result<Self, SizeError> {
        let colour = |label| Target::new(device, size, Self::COLOUR_FORMAT, label);
        let depth_stencil = Target::new(device, size, Self::DEPTH_STENCIL_FORMAT, "GBuffer depth-stencil")?;
        let depth = depth_stencil.texture.create_view(&wgpu::TextureViewDescriptor {
            label: Some("GBuffer depth"),
            aspect: wgpu::TextureAspect::DepthOnly,
            ..Default::default()
        });
        Ok(Self {
            irradiance: colour("GBuffer irradiance")?,
            unscattered: colour("GBuffer unscattered")?,
            surface: colour("GBuffer surface")?,
            depth_stencil,
            depth,
        })
    }

    /// Size of every target.
    pub fn size(&self) -> Extent {
        Extent::of(&self.irradiance.texture)
    }
}
