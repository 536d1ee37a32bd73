//! Calls for one frame that cannot be recorded.

use crate::extent::Extent;
use crate::wgpu;

/// Why a frame cannot be uploaded or recorded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FrameError {
    /// The pass has no inputs.
    #[error("{pass} has nothing to read: call `bind` before `prepare` and `encode`")]
    NotBound {
        /// The pass.
        pass: &'static str,
    },
    /// The renderer has no targets.
    #[error("Renderer has nothing to draw into: call `resize` before `prepare` and `encode`")]
    NotResized,
    /// The pass has no parameters of a frame since it was made or bound.
    #[error("{pass} does not know the frame: call `prepare` after `bind` and before `encode`")]
    NotPrepared {
        /// The pass.
        pass: &'static str,
    },
    /// The output has another size than the inputs.
    #[error(
        "{pass} writes to a texture of {found} pixels, and its inputs have {expected}: give one of that size"
    )]
    OutputSize {
        /// The pass.
        pass: &'static str,
        /// Size of the output.
        found: Extent,
        /// Size of the inputs.
        expected: Extent,
    },
    /// The output has another format than the pass was made for.
    #[error("{pass} was made for an output of the format {expected:?}, and is given {found:?}")]
    OutputFormat {
        /// The pass.
        pass: &'static str,
        /// Format of the output.
        found: wgpu::TextureFormat,
        /// What the pass was made for.
        expected: wgpu::TextureFormat,
    },
    /// An object scales the mean free path, and the pass has nowhere to write that to.
    #[error(
        "an object scales the mean free path, and {pass} was made without a target for it: set \
         `mean_free_path_scale` of its descriptor"
    )]
    NoMeanFreePathScale {
        /// The pass.
        pass: &'static str,
    },
    /// The pass writes scales of the mean free path, and the targets have none.
    #[error(
        "{pass} writes scales of the mean free path, and the targets have none: make them with \
         `GBuffer::with_mean_free_path_scale`"
    )]
    NoScaleTarget {
        /// The pass.
        pass: &'static str,
    },
    /// An object is clear, and the renderer draws none.
    #[error("an object is clear, and Renderer was made without a pass for it: set `clear` of its descriptor")]
    NoClearPass,
    /// The output may not be written as the pass writes.
    #[error(
        "{pass} writes to a texture of the usages {found:?}, and needs {expected:?}: make it with both, or let \
         `create_output` make it"
    )]
    OutputUsage {
        /// The pass.
        pass: &'static str,
        /// Usages of the output.
        found: wgpu::TextureUsages,
        /// What is missing.
        expected: wgpu::TextureUsages,
    },
}
