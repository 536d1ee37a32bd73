//! What the first stage of a kernel leaves for the second.

use crate::error::SizeError;
use crate::target::{Extent, Target};
use subsurface_kernel::Estimator;
use subsurface_kernel::constants::BLOCK_SIDE;

/// A texture between two stages.
#[derive(Clone, Copy, Debug)]
pub(super) struct Intermediate {
    pub(super) format: wgpu::TextureFormat,
    /// Pixels of the frame along each side of a texel; 0 for a texture of one texel.
    side: u32,
    label: &'static str,
}

impl Intermediate {
    /// A texture of one texel.
    pub(super) const fn single(format: wgpu::TextureFormat, label: &'static str) -> Self {
        Self { format, side: 0, label }
    }

    /// The texture for frames of `size`.
    pub(super) fn target(
        &self,
        device: &wgpu::Device,
        size: Extent,
        filled: wgpu::TextureUsages,
    ) -> Result<Target, SizeError> {
        let size = match self.side {
            0 => Extent::new(1, 1),
            side => Extent::new(size.width.div_ceil(side), size.height.div_ceil(side)),
        };
        Target::filled_by(device, size, self.format, filled, self.label)
    }
}

/// The textures of a kernel, in the order in which shaders name them.
///
/// Per pixel of the frame `Interleaved` takes (16 + 8)/4 bytes, and 8 for packed pixels; `Separable` takes 8.
pub(super) fn intermediates(kind: Estimator) -> &'static [Intermediate] {
    match kind {
        Estimator::Interleaved { .. } => &[
            Intermediate {
                format: wgpu::TextureFormat::Rgba32Uint,
                side: BLOCK_SIDE as u32,
                label: "SubsurfacePass far field of blocks",
            },
            Intermediate {
                format: wgpu::TextureFormat::Rg32Uint,
                side: BLOCK_SIDE as u32,
                label: "SubsurfacePass rings of blocks",
            },
        ],
        Estimator::Separable { .. } => &[Intermediate {
            format: wgpu::TextureFormat::Rg32Uint,
            side: 1,
            label: "SubsurfacePass first axis",
        }],
        Estimator::ImportanceSampled { .. } | Estimator::Dense => &[],
    }
}

/// The pixels of the inputs as `Interleaved` packs them for its stages; one texel for the others.
pub(super) fn packed_pixels(kind: Estimator) -> Intermediate {
    let side = if kind.packs_pixels() { 1 } else { 0 };
    Intermediate { format: wgpu::TextureFormat::Rg32Uint, side, label: "SubsurfacePass packed pixels" }
}
