//! What the stages of a kernel leave for those that follow.

use crate::extent::Extent;
use crate::label::Label;
use crate::target::Target;
use crate::viewport::Viewport;
use crate::wgpu;
use subsurface_kernel::Estimator;
use subsurface_kernel::constants::BLOCK_SIDE;

/// Side of a block, pixels.
const BLOCK: u32 = BLOCK_SIDE as u32;

/// A texture between two stages.
#[derive(Clone, Copy, Debug)]
pub(super) struct Intermediate {
    pub(super) format: wgpu::TextureFormat,
    /// Its size for a viewport.
    extent: fn(Extent) -> Extent,
    name: &'static str,
}

impl Intermediate {
    /// A texture of one texel.
    pub(super) const fn single(format: wgpu::TextureFormat, name: &'static str) -> Self {
        Self { format, extent: |_| Extent::new(1, 1), name }
    }

    /// A texture of two words per texel.
    const fn of_two_words(extent: fn(Extent) -> Extent, name: &'static str) -> Self {
        Self { format: wgpu::TextureFormat::Rg32Uint, extent, name }
    }

    /// The texture for viewports of `size`.
    pub(super) fn target(
        &self,
        device: &wgpu::Device,
        label: &Label,
        size: Extent,
        filled: wgpu::TextureUsages,
    ) -> Target {
        Target::of_checked_size(device, (self.extent)(size), self.format, filled, &label.of(self.name))
    }
}

/// Blocks of a viewport.
fn blocks(size: Extent) -> Extent {
    Extent::new(size.width.div_ceil(BLOCK), size.height.div_ceil(BLOCK))
}

/// What a first stage leaves for the last, if there is one: `Interleaved` 16 bytes for each block, `Separable` 8 bytes for
/// each pixel.
pub(super) fn first_stage(estimator: Estimator) -> Option<Intermediate> {
    match estimator {
        Estimator::Interleaved { .. } => Some(Intermediate {
            format: wgpu::TextureFormat::Rgba32Uint,
            extent: blocks,
            name: "far field of blocks",
        }),
        Estimator::Separable { .. } => Some(Intermediate::of_two_words(|size| size, "first axis")),
        Estimator::ImportanceSampled { .. } | Estimator::Dense => None,
    }
}

/// The pixels of the inputs as `Interleaved` packs them for its stages, 8 bytes each; one texel for the others.
pub(super) fn packed_pixels(estimator: Estimator) -> Intermediate {
    let name = "packed pixels";
    if estimator.packs_pixels() {
        Intermediate::of_two_words(|size| size, name)
    } else {
        Intermediate::single(wgpu::TextureFormat::Rg32Uint, name)
    }
}

/// Where the squares lie in the texture of `coarse_pixels` for viewports of `size`: the blocks, and below them the squares
/// of four blocks.
pub(super) fn coarse_parts(size: Extent) -> [Viewport; 2] {
    let blocks = blocks(size);
    let squares = Extent::new(blocks.width.div_ceil(2), blocks.height.div_ceil(2));
    let part = |y, size: Extent| Viewport { x: 0, y, width: size.width, height: size.height };
    [part(0, blocks), part(blocks.height, squares)]
}

/// Squares of pixels, 8 bytes each, as `Interleaved` packs them. One texel for the others.
pub(super) fn coarse_pixels(estimator: Estimator) -> Intermediate {
    let name = "coarse pixels";
    if estimator.packs_pixels() {
        let extent = |size| {
            let [blocks, squares] = coarse_parts(size);
            Extent::new(blocks.width, blocks.height + squares.height)
        };
        Intermediate::of_two_words(extent, name)
    } else {
        Intermediate::single(wgpu::TextureFormat::Rg32Uint, name)
    }
}
