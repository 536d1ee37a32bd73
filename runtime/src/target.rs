//! Textures that passes render into.

use wgpu::util::DeviceExt as _;

use crate::error::{SizeError, TexelsError, check_size};

/// Stencil value of translucent pixels; only this bit is read or written.
pub const TRANSLUCENT_STENCIL: u32 = 1;

/// Size of a frame in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Extent {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
}

impl Extent {
    /// `width`×`height` pixels.
    pub const fn new(width: u32, height: u32) -> Self {
        Self { width, height }
    }
}

impl From<Extent> for wgpu::Extent3d {
    fn from(size: Extent) -> Self {
        Self { width: size.width, height: size.height, depth_or_array_layers: 1 }
    }
}

/// A texture and its view.
#[derive(Clone, Debug)]
pub struct Target {
    /// The texture; can be copied from.
    pub texture: wgpu::Texture,
    /// All of it.
    pub view: wgpu::TextureView,
}

impl Target {
    /// A 2-D target that can be rendered to, read in shaders and copied from.
    ///
    /// # Errors
    /// A size of 0 or beyond the device's limit.
    pub fn new(
        device: &wgpu::Device,
        size: Extent,
        format: wgpu::TextureFormat,
        label: &str,
    ) -> Result<Self, SizeError> {
        Self::filled_by(device, size, format, wgpu::TextureUsages::RENDER_ATTACHMENT, label)
    }

    /// The same, filled as `filled` says.
    pub(crate) fn filled_by(
        device: &wgpu::Device,
        size: Extent,
        format: wgpu::TextureFormat,
        filled: wgpu::TextureUsages,
        label: &str,
    ) -> Result<Self, SizeError> {
        check_size(device, size)?;
        let texture = device.create_texture(&descriptor(size, format, filled, label));
        let view =
            texture.create_view(&wgpu::TextureViewDescriptor { label: Some(label), ..Default::default() });
        Ok(Self { texture, view })
    }

    /// A texture of one pixel that a queue fills.
    pub(crate) fn single_pixel(device: &wgpu::Device, format: wgpu::TextureFormat, label: &str) -> Self {
        let size = Extent::new(1, 1);
        let texture = device.create_texture(&descriptor(size, format, wgpu::TextureUsages::COPY_DST, label));
        let view =
            texture.create_view(&wgpu::TextureViewDescriptor { label: Some(label), ..Default::default() });
        Self { texture, view }
    }

    /// A 2-D texture of an uncompressed colour format that holds `texels`, rows from the top without padding; to be
    /// read in shaders and copied from.
    ///
    /// # Errors
    /// A size of 0 or beyond the device's limit, or bytes that do not fit it.
    pub fn from_texels(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        size: Extent,
        format: wgpu::TextureFormat,
        label: &str,
        texels: &[u8],
    ) -> Result<Self, TexelsError> {
        check_size(device, size)?;
        let Extent { width, height } = size;
        let texel = u64::from(format.block_copy_size(None).unwrap_or(0));
        let (expected, found) = (texel * u64::from(width) * u64::from(height), texels.len() as u64);
        if expected != found {
            return Err(TexelsError::Length { width, height, expected, found });
        }
        let descriptor = descriptor(size, format, wgpu::TextureUsages::COPY_DST, label);
        let order = wgpu::util::TextureDataOrder::LayerMajor;
        let texture = device.create_texture_with_data(queue, &descriptor, order, texels);
        let view =
            texture.create_view(&wgpu::TextureViewDescriptor { label: Some(label), ..Default::default() });
        Ok(Self { texture, view })
    }
}

/// One 2-D level that can be read in shaders and copied from, and filled as `filled` says.
fn descriptor(
    size: Extent,
    format: wgpu::TextureFormat,
    filled: wgpu::TextureUsages,
    label: &str,
) -> wgpu::TextureDescriptor<'_> {
    wgpu::TextureDescriptor {
        label: Some(label),
        size: size.into(),
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: filled | wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    }
}

/// The targets of the G-buffer pass.
#[derive(Clone, Debug)]
pub struct GBuffer {
    /// Diffuse irradiance, linear RGB; alpha 1 on geometry.
    pub irradiance: Target,
    /// Specular reflection + transmission: radiance that is not scattered; alpha 1 on geometry.
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
}
