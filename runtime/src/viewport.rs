//! A part of the inputs.

use std::fmt;

use crate::extent::Extent;

/// A rectangle of the inputs and of the output: what lies outside is neither read nor written.
///
/// One eye of two that share a texture, or the part of a texture that a dynamic resolution fills. The result is, to the
/// bit, that of inputs cut to the rectangle.
///
/// ```
/// use subsurface_runtime::Viewport;
///
/// let right_eye = Viewport::new(640, 0, 640, 720);
/// assert_eq!(right_eye.to_string(), "640×720 at (640, 0)");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Viewport {
    /// Column of the first pixel.
    pub x: u32,
    /// Row of the first pixel, from the top.
    pub y: u32,
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
}

impl Viewport {
    /// `width`×`height` pixels, the upper left of which is (`x`, `y`).
    pub const fn new(x: u32, y: u32, width: u32, height: u32) -> Self {
        Self { x, y, width, height }
    }

    /// All of a texture.
    pub const fn whole(size: Extent) -> Self {
        Self::new(0, 0, size.width, size.height)
    }

    /// Its size.
    pub const fn size(self) -> Extent {
        Extent::new(self.width, self.height)
    }

    /// Whether it has pixels, and none outside of a texture of `size`.
    pub(crate) fn is_within(self, size: Extent) -> bool {
        let ends_within =
            |start: u32, length, end| length > 0 && start.checked_add(length).is_some_and(|last| last <= end);
        ends_within(self.x, self.width, size.width) && ends_within(self.y, self.height, size.height)
    }
}

impl fmt::Display for Viewport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} at ({}, {})", self.size(), self.x, self.y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_viewport_lies_within_its_texture_or_does_not() {
        let size = Extent::new(64, 48);
        assert!(Viewport::whole(size).is_within(size));
        assert!(Viewport::new(63, 47, 1, 1).is_within(size));
        for outside in [
            Viewport::new(0, 0, 0, 48),
            Viewport::new(0, 0, 65, 48),
            Viewport::new(1, 0, 64, 48),
            Viewport::new(0, 40, 64, 9),
            Viewport::new(u32::MAX, 0, 2, 1),
        ] {
            assert!(!outside.is_within(size), "{outside}");
        }
    }
}
