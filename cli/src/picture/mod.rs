//! Pictures in memory and as files.

pub mod contact_sheet;
mod error;
pub mod exr;
pub mod file;
pub mod label;
mod png;

pub use error::PictureError;
pub use png::write_png;

use crate::scene::camera::Size;

/// Pixels in linear light, rows from the top: RGB as `f32`, without limit above.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearPicture {
    /// Size in pixels.
    pub size: Size,
    /// `size.pixels()` pixels.
    pub pixels: Vec<[f32; 3]>,
}

/// Pixels as a screen shows them, rows from the top: 8-bit sRGB.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DisplayPicture {
    /// Size in pixels.
    pub size: Size,
    /// `size.pixels()` pixels.
    pub pixels: Vec<[u8; 3]>,
}

impl DisplayPicture {
    /// A picture of one colour.
    pub fn filled(size: Size, colour: [u8; 3]) -> Self {
        Self { size, pixels: vec![colour; size.pixels()] }
    }

    /// Copies `other` in, its upper left corner at (`left`, `top`); what reaches beyond the edge is cut off.
    pub fn paste(&mut self, other: &DisplayPicture, left: u32, top: u32) {
        let columns = other.size.width.min(self.size.width.saturating_sub(left)) as usize;
        for row in 0..other.size.height.min(self.size.height.saturating_sub(top)) {
            let to = (top + row) as usize * self.size.width as usize + left as usize;
            let from = row as usize * other.size.width as usize;
            self.pixels[to..to + columns].copy_from_slice(&other.pixels[from..from + columns]);
        }
    }
}
