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
    /// Factor on the mean free path, where [`with_mean_free_path_scale`](Self::with_mean_free_path_scale) made it.
    pub mean_free_path_scale: Option<Target>,
    /// Depth and stencil: [`TRANSLUCENT_STENCIL`] marks translucent pixels.
    pub depth_stencil: Target,
    /// The depth aspect alone, for reading.
    pub depth: wgpu::TextureView,
}

impl GBuffer {
    /// Format of the colour targets: half floats hold irradiance above 1 and material numbers to 2048 exactly.
    pub const COLOUR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
    /// Format of the mean free path's scale.
    pub const SCALE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R16Float;
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
            mean_free_path_scale: None,
            depth_stencil,
            depth,
        })
    }

    /// The same with one more target of two bytes a pixel, for objects that scale the mean free path.
    #[must_use]
    pub fn with_mean_free_path_scale(mut self, device: &wgpu::Device) -> Self {
        let (format, written) = (Self::SCALE_FORMAT, wgpu::TextureUsages::RENDER_ATTACHMENT);
        let label = "GBuffer mean free path scale";
        let scale = Target::of_checked_size(device, self.size(), format, written, label);
        self.mean_free_path_scale = Some(scale);
        self
    }

    /// Size of every target.
    pub fn size(&self) -> Extent {
        Extent::of(&self.irradiance.texture)
    }
}
