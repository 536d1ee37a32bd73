//! SVG text as plotters draws on it.
//!
//! plotters' own SVG backend rounds to whole pixels and writes a dashed line dash by dash. This one counts in tenths of
//! a pixel, writes paths with relative coordinates, and knows dash patterns, dots and clipping.

use super::ink::{Colour, Dash};
use super::lettering::text_width;
use plotters_backend::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind,
    FontTransform,
};
use std::convert::Infallible;
use std::fmt::Write as _;

/// Tenths of a pixel per pixel: coordinates of this canvas are in tenths.
pub(super) const TENTHS: i32 = 10;

/// Colours, strokes and shapes as SVG text.
#[derive(Debug)]
pub(super) struct Canvas<'a> {
    /// Width and height in tenths of a pixel.
    size: (u32, u32),
    text: &'a mut String,
}

impl<'a> Canvas<'a> {
    /// Begins an SVG of `width`×`height` pixels; [`finish`](Self::finish) ends it.
    pub(super) fn begin(text: &'a mut String, width: i32, height: i32) -> Self {
        let size = (width * TENTHS, height * TENTHS);
        let _ = write!(
            text,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {} {}\" font-family=\"DejaVu Sans,Verdana,sans-serif\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
            size.0, size.1
        );
        Self { size: (size.0.unsigned_abs(), size.1.unsigned_abs()), text }
    }

    /// Ends an SVG text.
    pub(super) fn finish(text: &mut String) {
        text.push_str("</svg>\n");
    }

    /// A line through `points`, clipped to the rectangle `clip` if that is not empty.
    pub(super) fn curve(&mut self, points: &[(i32, i32)], colour: Colour, dash: Dash, clip: &str) {
        self.begin_path(clip);
        let _ = write!(self.text, "fill=\"none\" stroke=\"{}\" stroke-width=\"17\"", hex(colour));
        if !dash.lengths().is_empty() {
            let lengths: Vec<String> = dash.lengths().iter().map(u32::to_string).collect();
            let _ = write!(self.text, " stroke-dasharray=\"{}\"", lengths.join(" "));
        }
        let _ = writeln!(self.text, " stroke-linejoin=\"round\" d=\"{}\"/>", path(points));
    }

    /// Dots at `points`: strokes of almost no length with round ends, the shortest way to write a circle.
    pub(super) fn dots(&mut self, points: &[(i32, i32)], colour: Colour, clip: &str) {
        if points.is_empty() {
            return;
        }
        self.begin_path(clip);
        let _ = write!(
            self.text,
            "fill=\"none\" stroke=\"{}\" stroke-width=\"42\" stroke-linecap=\"round\" d=\"",
            hex(colour)
        );
        for (x, y) in points {
            let _ = write!(self.text, "M{x} {y}h.1");
        }
        self.text.push_str("\"/>\n");
    }

    /// A pale area inside of `outline`.
    pub(super) fn area(&mut self, outline: &[(i32, i32)], colour: Colour, clip: &str) {
        let fill = hex(colour);
        self.begin_path(clip);
        let _ = writeln!(self.text, "fill=\"{fill}\" fill-opacity=\".3\" d=\"{}z\"/>", path(outline));
    }

    /// Declares a rectangle that shapes can be clipped to by its name.
    pub(super) fn declare_clip(&mut self, name: &str, (left, top): (i32, i32), (right, bottom): (i32, i32)) {
        let (width, height) = (right - left, bottom - top);
        let _ = writeln!(
            self.text,
            "<clipPath id=\"{name}\"><rect x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\"/></clipPath>"
        );
    }

    /// Begins a path, clipped to the rectangle `clip` if that is not empty.
    fn begin_path(&mut self, clip: &str) {
        self.text.push_str("<path ");
        if !clip.is_empty() {
            let _ = write!(self.text, "clip-path=\"url(#{clip})\" ");
        }
    }
}

/// A path with relative coordinates: those are short.
fn path(points: &[(i32, i32)]) -> String {
    let mut path = String::new();
    let mut last = (0, 0);
    for (index, (x, y)) in points.iter().enumerate() {
        let (dx, dy) = (x - last.0, y - last.1);
        match index {
            0 => path.push('m'),
            1 => path.push('l'),
            _ if dx >= 0 => path.push(' '),
            _ => {}
        }
        let _ = write!(path, "{dx}");
        if dy >= 0 {
            path.push(' ');
        }
        let _ = write!(path, "{dy}");
        last = (*x, *y);
    }
    path
}

fn hex(Colour(red, green, blue): Colour) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

fn colour_of(BackendColor { rgb: (red, green, blue), .. }: BackendColor) -> Colour {
    Colour(red, green, blue)
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

type Drawn = Result<(), DrawingErrorKind<Infallible>>;

impl DrawingBackend for Canvas<'_> {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        self.size
    }

    fn ensure_prepared(&mut self) -> Drawn {
        Ok(())
    }

    fn present(&mut self) -> Drawn {
        Ok(())
    }

    fn draw_pixel(&mut self, point: BackendCoord, colour: BackendColor) -> Drawn {
        let colour = hex(colour_of(colour));
        let (x, y) = point;
        let _ = writeln!(self.text, "<rect x=\"{x}\" y=\"{y}\" width=\"1\" height=\"1\" fill=\"{colour}\"/>");
        Ok(())
    }

    fn draw_line<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S) -> Drawn {
        self.draw_path([from, to], style)
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        (left, top): BackendCoord,
        (right, bottom): BackendCoord,
        style: &S,
        fill: bool,
    ) -> Drawn {
        let outline = [(left, top), (right, top), (right, bottom), (left, bottom), (left, top)];
        if fill { self.fill_polygon(outline, style) } else { self.draw_path(outline, style) }
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        points: I,
        style: &S,
    ) -> Drawn {
        let points: Vec<_> = points.into_iter().collect();
        let colour = style.color();
        let _ = write!(self.text, "<path fill=\"none\" stroke=\"{}\"", hex(colour_of(colour)));
        if colour.alpha < 1.0 {
            let _ = write!(self.text, " stroke-opacity=\"{:.2}\"", colour.alpha);
        }
        let width = style.stroke_width();
        let _ = writeln!(self.text, " stroke-width=\"{width}\" d=\"{}\"/>", path(&points));
        Ok(())
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        points: I,
        style: &S,
    ) -> Drawn {
        let points: Vec<_> = points.into_iter().collect();
        let fill = hex(colour_of(style.color()));
        let _ = writeln!(self.text, "<path fill=\"{fill}\" d=\"{}z\"/>", path(&points));
        Ok(())
    }

    fn draw_text<S: BackendTextStyle>(&mut self, text: &str, style: &S, (x, y): BackendCoord) -> Drawn {
        let size = style.size();
        let anchor = match style.anchor().h_pos {
            HPos::Left => "",
            HPos::Center => " text-anchor=\"middle\"",
            HPos::Right => " text-anchor=\"end\"",
        };
        // From the place that is asked for down to the baseline: DejaVu's capitals are 0.73 em high.
        let down = match style.anchor().v_pos {
            VPos::Top => 0.78 * size,
            VPos::Center => 0.36 * size,
            VPos::Bottom => -0.22 * size,
        }
        .round();
        let _ = write!(self.text, "<text font-size=\"{size}\"{anchor}");
        let colour = colour_of(style.color());
        if colour != Colour::BLACK {
            let _ = write!(self.text, " fill=\"{}\"", hex(colour));
        }
        let degrees = match style.transform() {
            FontTransform::None => 0,
            FontTransform::Rotate90 => 90,
            FontTransform::Rotate180 => 180,
            FontTransform::Rotate270 => 270,
        };
        let _ = match degrees {
            0 => write!(self.text, " x=\"{x}\" y=\"{}\"", f64::from(y) + down),
            _ => write!(self.text, " y=\"{down}\" transform=\"translate({x} {y}) rotate({degrees})\""),
        };
        let _ = writeln!(self.text, ">{}</text>", escaped(text));
        Ok(())
    }

    fn estimate_text_size<S: BackendTextStyle>(
        &self,
        text: &str,
        style: &S,
    ) -> Result<(u32, u32), DrawingErrorKind<Infallible>> {
        Ok((text_width(text, style.size()).ceil() as u32, style.size().ceil() as u32))
    }
}
