//! Text in pictures: a fixed-width font, enlarged by whole numbers to stay crisp.

use super::DisplayPicture;
use crate::scene::camera::Size;
use embedded_graphics::mono_font::MonoTextStyle;
use embedded_graphics::mono_font::ascii::FONT_10X20;
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use embedded_graphics::text::{Baseline, Text};
use std::convert::Infallible;

/// Width of a character at scale 1 (pixels).
pub const CHARACTER_WIDTH: u32 = 10;
/// Height of a line at scale 1 (pixels).
pub const LINE_HEIGHT: u32 = 20;

/// Width of a text at scale 1 (pixels).
pub fn width(text: &str) -> u32 {
    CHARACTER_WIDTH * text.chars().count() as u32
}

/// Writes one line, its upper left corner at (`left`, `top`); what reaches beyond the edge is cut off.
pub fn draw(picture: &mut DisplayPicture, text: &str, left: u32, top: u32, scale: u32, colour: [u8; 3]) {
    let [r, g, b] = colour;
    let style = MonoTextStyle::new(&FONT_10X20, Rgb888::new(r, g, b));
    let mut target = Enlarged { picture, left, top, scale };
    let drawn: Result<_, Infallible> =
        Text::with_baseline(text, Point::zero(), style, Baseline::Top).draw(&mut target);
    match drawn {
        Ok(_) => (),
        Err(never) => match never {},
    }
}

/// A picture whose pixels are squares of `scale` pixels.
struct Enlarged<'a> {
    picture: &'a mut DisplayPicture,
    left: u32,
    top: u32,
    scale: u32,
}

impl OriginDimensions for Enlarged<'_> {
    fn size(&self) -> embedded_graphics::geometry::Size {
        let Size { width, height } = self.picture.size;
        let edge = |edge: u32, offset: u32| edge.saturating_sub(offset).div_ceil(self.scale);
        embedded_graphics::geometry::Size::new(edge(width, self.left), edge(height, self.top))
    }
}

impl DrawTarget for Enlarged<'_> {
    type Color = Rgb888;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb888>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for Pixel(point, colour) in pixels {
            let (Ok(x), Ok(y)) = (u32::try_from(point.x), u32::try_from(point.y)) else { continue };
            let square = DisplayPicture::filled(
                Size { width: self.scale, height: self.scale },
                [colour.r(), colour.g(), colour.b()],
            );
            self.picture.paste(&square, self.left + x * self.scale, self.top + y * self.scale);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_marks_its_box_and_nothing_outside() {
        let mut picture = DisplayPicture::filled(Size { width: 60, height: 50 }, [0; 3]);
        draw(&mut picture, "MM", 4, 3, 2, [255; 3]);
        let marked: Vec<usize> = (0..picture.pixels.len()).filter(|i| picture.pixels[*i] != [0; 3]).collect();
        assert!(!marked.is_empty());
        for index in marked {
            let (x, y) = (index as u32 % 60, index as u32 / 60);
            assert!((4..4 + 2 * width("MM")).contains(&x) && (3..3 + 2 * LINE_HEIGHT).contains(&y));
        }
    }

    #[test]
    fn text_over_the_edge_is_cut_off() {
        let mut picture = DisplayPicture::filled(Size { width: 5, height: 5 }, [0; 3]);
        draw(&mut picture, "a long text", 3, 3, 3, [255; 3]);
        draw(&mut picture, "outside", 100, 100, 1, [255; 3]);
    }
}
