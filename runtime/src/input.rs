//! Views that passes read, checked against what the passes need.

use crate::bind_error::BindError;
use crate::extent::Extent;
use crate::wgpu;

/// An input by its name.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Input<'a> {
    pub(crate) name: &'static str,
    pub(crate) texture: &'a wgpu::Texture,
}

/// What a texture must hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Holds {
    /// Colours: any float format with red, green and blue.
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
