//! Sizes of frames.

use std::fmt;

use crate::wgpu;

/// Size of a frame in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Extent {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
}

/// A frame size that no texture can have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SizeError {
    /// Width or height is 0.
    #[error("a frame of {width}×{height} pixels has no pixel: give at least 1×1")]
    Zero {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
    /// Width or height is beyond what the device offers.
    #[error(
        "a frame of {width}×{height} pixels is beyond this device's limit: give at most {limit} per side"
    )]
    BeyondLimit {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
        /// Largest side of a 2-D texture on the device.
        limit: u32,
    },
}

impl Extent {
    /// `width`×`height` pixels.
    pub const fn new(width: u32, height: u32) -> Self {
        Self { width, height }
    }

    /// Size of the first level of a texture.
    pub fn of(texture: &wgpu::Texture) -> Self {
        Self { width: texture.width(), height: texture.height() }
    }

    /// Width over height.
    pub fn aspect(self) -> f32 {
        self.width as f32 / self.height as f32
    }

    /// Checks the size against the device.
    pub(crate) fn check(self, device: &wgpu::Device) -> Result<(), SizeError> {
        let Self { width, height } = self;
        let limit = device.limits().max_texture_dimension_2d;
        if width == 0 || height == 0 {
            return Err(SizeError::Zero { width, height });
        }
        if width > limit || height > limit {
            return Err(SizeError::BeyondLimit { width, height, limit });
        }
        Ok(())
    }
}

/// `1280×720`
impl fmt::Display for Extent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}×{}", self.width, self.height)
    }
}

impl From<Extent> for wgpu::Extent3d {
    fn from(size: Extent) -> Self {
        Self { width: size.width, height: size.height, depth_or_array_layers: 1 }
    }
}
