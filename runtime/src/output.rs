//! Calls for one frame that cannot be recorded, and the views that passes write to.

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
    /// More lights than a frame can hold.
    #[error("a frame holds {capacity} lights at most, not {found}: leave the weakest out")]
    Lights {
        /// Lights that were given.
        found: usize,
        /// Lights that a frame holds.
        capacity: usize,
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

/// What a pass needs of its output.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Output {
    pub(crate) pass: &'static str,
    pub(crate) size: Extent,
    pub(crate) format: wgpu::TextureFormat,
    pub(crate) usage: wgpu::TextureUsages,
}

impl Output {
    pub(crate) fn check(self, view: &wgpu::TextureView) -> Result<(), FrameError> {
        let Self { pass, size: expected, format, usage } = self;
        let texture = view.texture();
        // A view does not tell its level. One of several may be any of them, which wgpu checks.
        let found = Extent::of(texture);
        if found != expected && texture.mip_level_count() == 1 {
            return Err(FrameError::OutputSize { pass, found, expected });
        }
        // Views of an sRGB texture may leave the encoding out, and the reverse.
        let found = texture.format();
        if found.remove_srgb_suffix() != format.remove_srgb_suffix() {
            return Err(FrameError::OutputFormat { pass, found, expected: format });
        }
        if !texture.usage().contains(usage) {
            return Err(FrameError::OutputUsage { pass, found: texture.usage(), expected: usage });
        }
        Ok(())
    }
}

/// How far a pass is on its way to a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Progress {
    #[default]
    Made,
    Bound,
    Prepared,
}

impl Progress {
    /// Whether a frame can be uploaded.
    pub(crate) fn is_bound(self, pass: &'static str) -> Result<(), FrameError> {
        if self == Self::Made { Err(FrameError::NotBound { pass }) } else { Ok(()) }
    }

    /// Whether a frame can be recorded.
    pub(crate) fn is_prepared(self, pass: &'static str) -> Result<(), FrameError> {
        self.is_bound(pass)?;
        if self == Self::Bound { Err(FrameError::NotPrepared { pass }) } else { Ok(()) }
    }
}
