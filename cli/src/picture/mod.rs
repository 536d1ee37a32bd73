//! Pictures in memory and as files.

#[cfg(feature = "analysis")]
pub mod comparison;
pub mod contact_sheet;
mod error;
pub mod exr;
pub mod file;
pub mod label;
mod png;

pub use error::PictureError;
pub use png::write_png;
#[cfg(feature = "analysis")]
pub use png::write_small_png;

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

impl LinearPicture {
    /// The picture with `factor`×`factor` pixels averaged into one; the size must divide.
    pub fn shrunk(&self, factor: u32) -> Self {
        let (size, pixels) = shrunk(self.size, &self.pixels, factor);
        Self { size, pixels }
    }

    /// The picture as a screen shows it: clamped to [0, 1] and encoded, without tone mapping.
    pub fn to_display(&self) -> DisplayPicture {
        let code = |linear: f32| srgb_from_linear(linear.clamp(0.0, 1.0));
        DisplayPicture { size: self.size, pixels: self.pixels.iter().map(|pixel| pixel.map(code)).collect() }
    }
}

/// Means of `factor`×`factor` pixels.
fn shrunk(size: Size, pixels: &[[f32; 3]], factor: u32) -> (Size, Vec<[f32; 3]>) {
    if factor <= 1 {
        return (size, pixels.to_vec());
    }
    let small = Size { width: size.width / factor, height: size.height / factor };
    let weight = 1.0 / (factor * factor) as f32;
    let mean = |x: u32, y: u32| {
        let mut sum = [0.0; 3];
        for row in y * factor..(y + 1) * factor {
            let start = row as usize * size.width as usize + (x * factor) as usize;
            for pixel in &pixels[start..start + factor as usize] {
                sum = std::array::from_fn(|channel| sum[channel] + weight * pixel[channel]);
            }
        }
        sum
    };
    let pixels =
        (0..small.height).flat_map(|y| (0..small.width).map(move |x| (x, y))).map(|(x, y)| mean(x, y));
    (small, pixels.collect())
}

/// Linear light of an sRGB code value, IEC 61966-2-1.
pub(crate) fn linear_from_srgb(code: u8) -> f32 {
    let value = f32::from(code) / 255.0;
    if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
}

/// sRGB code value of linear light, IEC 61966-2-1.
fn srgb_from_linear(linear: f32) -> u8 {
    let value = if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
    (255.0 * value + 0.5) as u8
}

impl DisplayPicture {
    /// The picture with `factor`×`factor` pixels averaged into one, in linear light; the size must divide.
    pub fn shrunk(&self, factor: u32) -> Self {
        if factor <= 1 {
            return self.clone();
        }
        let linear: Vec<_> = self.pixels.iter().map(|pixel| pixel.map(linear_from_srgb)).collect();
        let (size, pixels) = shrunk(self.size, &linear, factor);
        Self { size, pixels: pixels.into_iter().map(|pixel| pixel.map(srgb_from_linear)).collect() }
    }

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
