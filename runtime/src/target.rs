//! Textures that passes render into.

use crate::extent::{Extent, SizeError};
use crate::mips::{self, Encoding};
use crate::wgpu::{self, util::DeviceExt as _};

/// A texture and its view.
#[derive(Clone, Debug)]
pub struct Target {
    /// The texture; can be copied from.
    pub texture: wgpu::Texture,
    /// All of it.
    pub view: wgpu::TextureView,
}

/// Bytes that make no texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TexelsError {
    /// The number of bytes does not fit the size.
    #[error("a texture of {width}×{height} pixels of this format takes {expected} bytes, not {found}")]
    Length {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
        /// Bytes that it takes.
        expected: u64,
        /// Bytes given.
        found: u64,
    },
    /// Width or height is 0 or beyond what the device offers.
    #[error(transparent)]
    Size(#[from] SizeError),
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
        size.check(device)?;
        Ok(Self::of_checked_size(device, size, format, filled, label))
    }

    /// The same of a size that the device is known to take.
    pub(crate) fn of_checked_size(
        device: &wgpu::Device,
        size: Extent,
        format: wgpu::TextureFormat,
        filled: wgpu::TextureUsages,
        label: &str,
    ) -> Self {
        Self::of(device.create_texture(&descriptor(size, format, filled, label)), label)
    }

    /// A texture of one pixel.
    pub(crate) fn single_pixel(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        format: wgpu::TextureFormat,
        label: &str,
        texel: &[u8],
    ) -> Self {
        Self::filled_with(device, queue, Extent::new(1, 1), format, label, 1, texel)
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
        check(device, size, format, texels)?;
        Ok(Self::filled_with(device, queue, size, format, label, 1, texels))
    }

    /// The same of four bytes per pixel, with all smaller levels.
    pub(crate) fn with_levels(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        size: Extent,
        encoding: Encoding,
        label: &str,
        texels: &[u8],
    ) -> Result<Self, TexelsError> {
        let format = match encoding {
            Encoding::Srgb => wgpu::TextureFormat::Rgba8UnormSrgb,
            Encoding::Linear => wgpu::TextureFormat::Rgba8Unorm,
        };
        check(device, size, format, texels)?;
        let levels = mips::levels(size, texels, encoding);
        Ok(Self::filled_with(device, queue, size, format, label, mips::level_count(size), &levels))
    }

    fn filled_with(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        size: Extent,
        format: wgpu::TextureFormat,
        label: &str,
        mip_level_count: u32,
        texels: &[u8],
    ) -> Self {
        let descriptor = wgpu::TextureDescriptor {
            mip_level_count,
            ..descriptor(size, format, wgpu::TextureUsages::COPY_DST, label)
        };
        let order = wgpu::util::TextureDataOrder::LayerMajor;
        Self::of(device.create_texture_with_data(queue, &descriptor, order, texels), label)
    }

    fn of(texture: wgpu::Texture, label: &str) -> Self {
        let view =
            texture.create_view(&wgpu::TextureViewDescriptor { label: Some(label), ..Default::default() });
        Self { texture, view }
    }
}

/// Whether the device has textures of this size, and so many bytes fill one.
fn check(
    device: &wgpu::Device,
    size: Extent,
    format: wgpu::TextureFormat,
    texels: &[u8],
) -> Result<(), TexelsError> {
    size.check(device)?;
    let Extent { width, height } = size;
    let texel = u64::from(format.block_copy_size(None).unwrap_or(0));
    let (expected, found) = (texel * u64::from(width) * u64::from(height), texels.len() as u64);
    if expected == found { Ok(()) } else { Err(TexelsError::Length { width, height, expected, found }) }
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
