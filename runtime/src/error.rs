//! Sizes that cannot be rendered.

use crate::target::Extent;

/// A frame size that no texture can have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SizeError {
    /// Width or height is 0.
    #[error("a frame of {width}×{height} pixels has no pixel: width and height start at 1")]
    Zero {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
    /// Width or height is beyond what the device offers.
    #[error("a frame of {width}×{height} pixels is beyond this device's limit of {limit} per side")]
    BeyondLimit {
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
        /// Largest side of a 2-D texture on the device.
        limit: u32,
    },
}

/// Checks `size` against the device.
pub(crate) fn check_size(device: &wgpu::Device, size: Extent) -> Result<(), SizeError> {
    let Extent { width, height } = size;
    let limit = device.limits().max_texture_dimension_2d;
    if width == 0 || height == 0 {
        return Err(SizeError::Zero { width, height });
    }
    if width > limit || height > limit {
        return Err(SizeError::BeyondLimit { width, height, limit });
    }
    Ok(())
}
