//! Inputs that a pass refuses.

use crate::extent::{Extent, SizeError};
use crate::wgpu;

/// Why a pass cannot read its inputs. The pass keeps those that it had.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum BindError {
    /// The size.
    #[error(transparent)]
    Size(#[from] SizeError),
    /// An input has another size than the first.
    #[error(
        "`{input}` is a texture of {found} pixels, and `{first}` one of {expected}: all inputs except the scale of the \
         mean free path have one size"
    )]
    OtherSize {
        /// The input.
        input: &'static str,
        /// Its size.
        found: Extent,
        /// The input that says which size is right.
        first: &'static str,
        /// Its size.
        expected: Extent,
    },
    /// An input has a format that does not hold what the pass reads.
    #[error("`{input}` is a texture of the format {found:?}, and the pass needs {expected}")]
    Format {
        /// The input.
        input: &'static str,
        /// Its format.
        found: wgpu::TextureFormat,
        /// What would do.
        expected: &'static str,
    },
    /// An input is no 2-D texture.
    #[error(
        "`{input}` is a texture of the dimension {found:?}, and the pass reads one layer of a 2-D texture: make the \
         view with `dimension: Some(D2)` of a texture of two dimensions"
    )]
    Dimension {
        /// The input.
        input: &'static str,
        /// Its dimension.
        found: wgpu::TextureDimension,
    },
    /// An input has several samples per pixel.
    #[error("`{input}` has {found} samples per pixel, and the pass reads 1: resolve it first")]
    Multisampled {
        /// The input.
        input: &'static str,
        /// Its samples per pixel.
        found: u32,
    },
    /// An input that may not be used as the pass uses it.
    #[error(
        "`{input}` is a texture of the usages {found:?}, and the pass needs {expected:?}: make it with both"
    )]
    Usage {
        /// The input.
        input: &'static str,
        /// Its usages.
        found: wgpu::TextureUsages,
        /// What is missing.
        expected: wgpu::TextureUsages,
    },
    /// A part of the inputs that is empty or reaches beyond them.
    #[error("the viewport {viewport} is empty or reaches beyond the inputs' {size}: give one within them")]
    Viewport {
        /// The viewport.
        viewport: crate::Viewport,
        /// Size of the inputs.
        size: Extent,
    },
    /// The pass was made for a stencil, but the inputs have none.
    #[error("the pass was made for a stencil: give `depth_stencil`, or make the pass with `stencil: None`")]
    StencilMissing,
    /// The inputs have a stencil, but the pass was made without.
    #[error(
        "the pass was made without a stencil: leave `depth_stencil` out, or make the pass with \
         `stencil: Some({found:?})`"
    )]
    StencilUnexpected {
        /// Format of the stencil.
        found: wgpu::TextureFormat,
    },
    /// The stencil has another format than the pass was made for.
    #[error("the pass was made for a stencil of the format {expected:?}, and `depth_stencil` has {found:?}")]
    StencilFormat {
        /// What the pass was made for.
        expected: wgpu::TextureFormat,
        /// Format of the input.
        found: wgpu::TextureFormat,
    },
    /// The inputs have material numbers of their own, but the pass was made without.
    #[error("the pass was made without `material_ids`: set it in the descriptor, or leave the input out")]
    MaterialIdsUnexpected,
    /// The pass was made for material numbers of their own, but the inputs have none.
    #[error("the pass was made with `material_ids: true`: give the input, or make the pass without")]
    MaterialIdsMissing,
}
