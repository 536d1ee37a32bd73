//! Frames that cannot be rendered.

use subsurface_kernel::DebugView;

use crate::target::Extent;

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

/// Why a pass cannot take its inputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ResizeError {
    /// The size.
    #[error(transparent)]
    Size(#[from] SizeError),
    /// The pass was made for a stencil, but the inputs have none.
    #[error("the pass was made for a stencil: give `depth_stencil`, or make the pass with `stencil: None`")]
    StencilMissing,
    /// The inputs have a stencil, but the pass was made without.
    #[error(
        "the pass was made without a stencil: leave `depth_stencil` out, or make the pass with its format"
    )]
    StencilUnexpected,
}

/// Why a pass cannot show a debug view.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum DebugViewError {
    /// The kernel's module holds no debug views.
    #[error(
        "the kernel was compiled without debug views, so `{}` cannot be shown: compile it with \
         `Compiler::with_debug_views`",
        view.name()
    )]
    NotLinked {
        /// The view.
        view: DebugView,
    },
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
