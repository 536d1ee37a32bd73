//! Views that passes read, checked against what the passes need.

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

/// An input by its name.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Input<'a> {
    pub(crate) name: &'static str,
    pub(crate) texture: &'a wgpu::Texture,
}

/// What a texture must hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Holds {
    /// Colours: any float format.
    Colours,
    /// Colours and, in the fourth component, −1 and whole numbers.
    ColoursAndNumbers,
    /// Numbers of a float format.
    Floats,
    /// One number per pixel, of a float or depth format.
    Numbers,
    /// Depth, for comparison.
    Depth,
    /// Whole numbers of an unsigned format.
    WholeNumbers,
}

impl<'a> Input<'a> {
    pub(crate) fn new(name: &'static str, view: &'a wgpu::TextureView) -> Self {
        Self { name, texture: view.texture() }
    }

    /// Size of the first level: a view does not tell its level.
    pub(crate) fn size(self) -> Extent {
        Extent::of(self.texture)
    }

    /// Checks all but the size.
    pub(crate) fn check(self, device: &wgpu::Device, holds: Holds) -> Result<Self, BindError> {
        let Self { name: input, texture } = self;
        if texture.dimension() != wgpu::TextureDimension::D2 {
            return Err(BindError::Dimension { input, found: texture.dimension() });
        }
        if texture.sample_count() != 1 {
            return Err(BindError::Multisampled { input, found: texture.sample_count() });
        }
        self.can_be(wgpu::TextureUsages::TEXTURE_BINDING)?;
        let found = texture.format();
        if !holds.is_held_by(found, device.features()) {
            return Err(BindError::Format { input, found, expected: holds.expected() });
        }
        Ok(self)
    }

    /// Checks that the texture may be used so.
    pub(crate) fn can_be(self, expected: wgpu::TextureUsages) -> Result<(), BindError> {
        let found = self.texture.usage();
        if found.contains(expected) {
            Ok(())
        } else {
            Err(BindError::Usage { input: self.name, found, expected })
        }
    }

    /// Checks that the size is that of `first`.
    pub(crate) fn as_large_as(self, first: Input<'_>) -> Result<(), BindError> {
        let (found, expected) = (self.size(), first.size());
        if found == expected {
            Ok(())
        } else {
            Err(BindError::OtherSize { input: self.name, found, first: first.name, expected })
        }
    }
}

impl Holds {
    fn is_held_by(self, format: wgpu::TextureFormat, features: wgpu::Features) -> bool {
        let is_float =
            matches!(format.sample_type(None, Some(features)), Some(wgpu::TextureSampleType::Float { .. }));
        match self {
            Self::Colours => is_float && format.components() >= 3,
            Self::ColoursAndNumbers => {
                matches!(format, wgpu::TextureFormat::Rgba16Float | wgpu::TextureFormat::Rgba32Float)
            }
            Self::Floats => is_float,
            Self::Numbers => is_float || format.has_depth_aspect(),
            Self::Depth => format.has_depth_aspect(),
            Self::WholeNumbers => {
                format.sample_type(None, Some(features)) == Some(wgpu::TextureSampleType::Uint)
            }
        }
    }

    fn expected(self) -> &'static str {
        match self {
            Self::Colours => "red, green and blue as floats: a format such as Rgba16Float",
            Self::ColoursAndNumbers => {
                "one that holds material numbers and −1 beside the colour: Rgba16Float or Rgba32Float, or any colour \
                 format with `material_ids` beside it"
            }
            Self::Floats => "a float in the first component: a format such as R32Float",
            Self::Numbers => "one number per pixel: a depth format, or a float format such as R32Float",
            Self::Depth => "depth to compare with: a depth format",
            Self::WholeNumbers => "whole numbers without a sign: R8Uint, R16Uint or R32Uint",
        }
    }
}
