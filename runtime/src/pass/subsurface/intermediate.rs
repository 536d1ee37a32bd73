//! What the first stage of a kernel leaves for the second.

use crate::extent::Extent;
use crate::label::Label;
use crate::target::Target;
use crate::wgpu;
use subsurface_kernel::Estimator;
use subsurface_kernel::constants::BLOCK_SIDE;

/// A texture between two stages.
#[derive(Clone, Copy, Debug)]
pub(super) struct Intermediate {
    pub(super) format: wgpu::TextureFormat,
    /// Pixels of the frame along each side of a texel; 0 for a texture of one texel.
    side: u32,
    name: &'static str,
}

impl Intermediate {
    /// A texture of one texel.
    pub(super) const fn single(format: wgpu::TextureFormat, name: &'static str) -> Self {
        Self { format, side: 0, name }
    }

    /// The texture for viewports of `size`.
    pub(super) fn target(
        &self,
        device: &wgpu::Device,
        label: &Label,
        size: Extent,
        filled: wgpu::TextureUsages,
    ) -> Target {
        let size = match self.side {
            0 => Extent::new(1, 1),
            side => Extent::new(size.width.div_ceil(side), size.height.div_ceil(side)),
        };
        Target::of_checked_size(device, size, self.format, filled, &label.of(self.name))
    }
}

/// The textures of a kernel, in the order in which shaders name them.
///
/// Per pixel of the frame `Interleaved` takes (16 + 8)/4 bytes, and 8 for packed pixels; `Separable` takes 8.
pub(super) fn intermediates(estimator: Estimator) -> &'static [Intermediate] {
    match estimator {
        Estimator::Interleaved { .. } => &[
            Intermediate {
                format: wgpu::TextureFormat::Rgba32Uint,
                side: BLOCK_SIDE as u32,
                name: "far field of blocks",
            },
            Intermediate {
                format: wgpu::TextureFormat::Rg32Uint,
                side: BLOCK_SIDE as u32,
                name: "rings of blocks",
            },
        ],
        Estimator::Separable { .. } => {
            &[Intermediate { format: wgpu::TextureFormat::Rg32Uint, side: 1, name: "first axis" }]
        }
        Estimator::ImportanceSampled { .. } | Estimator::Dense => &[],
    }
}

/// The pixels of the inputs as `Interleaved` packs them for its stages; one texel for the others.
pub(super) fn packed_pixels(estimator: Estimator) -> Intermediate {
    let side = if estimator.packs_pixels() { 1 } else { 0 };
    Intermediate { format: wgpu::TextureFormat::Rg32Uint, side, name: "packed pixels" }
}
