//! The views that passes write to, and how far a pass is.

use crate::extent::Extent;
use crate::frame_error::FrameError;
use crate::wgpu;

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
