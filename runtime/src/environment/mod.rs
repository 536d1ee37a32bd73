//! Light from far away all around.

mod harmonics;
mod prefilter;

use std::fmt;

use crate::bindings::kernel;
use crate::wgpu;

use prefilter::{LEVELS, SIZE, prefiltered};

/// Bytes of a texel: four half floats.
const TEXEL_BYTES: u32 = 8;

/// Light from far away all around, from an equirectangular image: what enters, as nine coefficients; what is reflected, as
/// a texture whose levels are as blurred as lobes are rough.
///
/// The middle of the image lies towards −z, its right half towards +x, its top towards +y.
#[derive(Clone, Debug)]
pub struct Environment {
    irradiance: [[f32; 4]; 9],
    radiance: wgpu::TextureView,
    sampler: wgpu::Sampler,
}

/// Why an image is no environment.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EnvironmentError {
    /// Its width is not twice its height.
    #[error(
        "an environment of {width}x{height} pixels: an equirectangular image is twice as wide as it is high"
    )]
    Aspect {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
    /// It has too many or too few pixels.
    #[error("{found} pixels for an environment of {width}x{height}")]
    Pixels {
        /// Pixels that are given.
        found: usize,
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
    /// A pixel is no light.
    #[error("the environment has {value:?} at pixel ({x}, {y}): light is finite, and 0 or more")]
    Radiance {
        /// The pixel.
        value: [f32; 3],
        /// Its column.
        x: u32,
        /// Its row from the top.
        y: u32,
    },
}

/// An equirectangular image of radiance.
#[derive(Clone, Copy)]
struct Image<'a> {
    width: u32,
    height: u32,
    pixels: &'a [[f32; 3]],
}

impl fmt::Debug for Image<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Image({}x{})", self.width, self.height)
    }
}

impl Environment {
    /// Reads an image of radiance: rows from the top, linear red, green, blue. Takes a part of a second.
    ///
    /// # Errors
    /// An image that is not twice as wide as it is high, or a pixel that is negative, infinite or no number.
    pub fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        width: u32,
        height: u32,
        pixels: &[[f32; 3]],
    ) -> Result<Self, EnvironmentError> {
        if height == 0 || u64::from(width) != 2 * u64::from(height) {
            return Err(EnvironmentError::Aspect { width, height });
        }
        if pixels.len() as u64 != u64::from(width) * u64::from(height) {
            return Err(EnvironmentError::Pixels { found: pixels.len(), width, height });
        }
        let is_light = |pixel: &[f32; 3]| pixel.iter().all(|value| value.is_finite() && *value >= 0.0);
        if let Some(index) = pixels.iter().position(|pixel| !is_light(pixel)) {
            let (x, y) = (index as u32 % width, index as u32 / width);
            return Err(EnvironmentError::Radiance { value: pixels[index], x, y });
        }
        let image = Image { width, height, pixels };
        let environment = Self::empty(device, SIZE, LEVELS, harmonics::irradiance(image));
        for (level, texels) in prefiltered(image).iter().enumerate() {
            let size = SIZE.map(|edge| (edge >> level).max(1));
            upload(queue, environment.radiance.texture(), level as u32, size, texels);
        }
        Ok(environment)
    }

    /// No light at all.
    pub(crate) fn darkness(device: &wgpu::Device) -> Self {
        Self::empty(device, [1, 1], 1, [[0.0; 4]; 9])
    }

    fn empty(device: &wgpu::Device, size: [u32; 2], levels: u32, irradiance: [[f32; 4]; 9]) -> Self {
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("Environment radiance"),
            size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
            mip_level_count: levels,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba16Float,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("Environment sampler"),
            // Around the horizon it goes on, over the poles it does not.
            address_mode_u: wgpu::AddressMode::Repeat,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        Self { irradiance, radiance: texture.create_view(&Default::default()), sampler }
    }

    pub(crate) fn radiance(&self) -> &wgpu::TextureView {
        &self.radiance
    }

    pub(crate) fn sampler(&self) -> &wgpu::Sampler {
        &self.sampler
    }

    pub(crate) fn uniform(&self, intensity: f32, turn_radians: f32) -> kernel::Environment {
        kernel::Environment {
            irradiance: self.irradiance,
            levels: self.radiance.texture().mip_level_count() as f32,
            turn: turn_radians / std::f32::consts::TAU,
            intensity: if intensity.is_finite() { intensity.max(0.0) } else { 0.0 },
            padding_156: [0; 4],
        }
    }
}

fn upload(queue: &wgpu::Queue, texture: &wgpu::Texture, level: u32, size: [u32; 2], texels: &[[f32; 3]]) {
    let bytes: Vec<u8> = texels
        .iter()
        .flat_map(|[red, green, blue]| [*red, *green, *blue, 1.0])
        .flat_map(|value| half(value).to_le_bytes())
        .collect();
    queue.write_texture(
        wgpu::TexelCopyTextureInfo {
            texture,
            mip_level: level,
            origin: wgpu::Origin3d::ZERO,
            aspect: wgpu::TextureAspect::All,
        },
        &bytes,
        wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(size[0] * TEXEL_BYTES),
            rows_per_image: None,
        },
        wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
    );
}

/// The nearest half float of a number that is 0 or more; what is larger than all of them is the largest.
fn half(value: f32) -> u16 {
    const LARGEST: f32 = 65504.0;
    let value = value.clamp(0.0, LARGEST);
    if value < 6.103_515_6e-5 {
        // Below the normal ones: steps of 2⁻²⁴.
        return (value * 16_777_216.0).round() as u16;
    }
    // Rounds the thirteen bits that a half float has not, and rebases the exponent from 127 to 15.
    let bits = value.to_bits();
    let rounded = bits + 0xfff + ((bits >> 13) & 1);
    ((rounded >> 13) - ((127 - 15) << 10)) as u16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_floats_are_the_nearest() {
        for (value, bits) in [
            (0.0, 0),
            (1.0, 0x3c00),
            (0.5, 0x3800),
            (65504.0, 0x7bff),
            (1e9, 0x7bff),
            (1.000_976_6, 0x3c01),
            (1.000_2, 0x3c00),
            (5.960_464_5e-8, 1),
            (6.103_515_6e-5, 0x0400),
        ] {
            assert_eq!(half(value), bits, "{value}");
        }
    }
}
