//! What is drawn between the axes.

use super::canvas::{Canvas, TENTHS};
use super::figure::{Mark, Series};
use super::thin::thinned;
use plotters::element::{Drawable, PointCollection};
use plotters_backend::{BackendCoord, DrawingErrorKind};
use std::convert::Infallible;

/// How far, in tenths of a pixel, a point may lie from a curve that leaves it out.
const TOLERANCE: f64 = 1.2;

/// Distance in tenths of a pixel below which one of two dots is left out.
const DOT_DISTANCE: f64 = 7.5 * TENTHS as f64;

/// The rectangle between the axes, in tenths of a pixel.
#[derive(Debug)]
pub(super) struct Clip<'a> {
    /// Unique in the figure.
    pub(super) name: &'a str,
    pub(super) left: i32,
    pub(super) top: i32,
    pub(super) right: i32,
    pub(super) bottom: i32,
}

/// A series at its place; `None` interrupts a line.
#[derive(Debug)]
pub(super) struct Strokes<'a> {
    pub(super) series: &'a Series,
    pub(super) points: &'a [Option<BackendCoord>],
    pub(super) clip: &'a Clip<'a>,
    /// The first series of a panel declares the rectangle that all are clipped to.
    pub(super) is_first: bool,
}

/// The points are placed already, so none is left for plotters to place.
impl<'a> PointCollection<'a, BackendCoord> for &'a Strokes<'a> {
    type Point = BackendCoord;
    type IntoIter = std::iter::Empty<BackendCoord>;

    fn point_iter(self) -> Self::IntoIter {
        std::iter::empty()
    }
}

impl Drawable<Canvas<'_>> for Strokes<'_> {
    fn draw<I: Iterator<Item = BackendCoord>>(
        &self,
        _: I,
        canvas: &mut Canvas<'_>,
        _: (u32, u32),
    ) -> Result<(), DrawingErrorKind<Infallible>> {
        let Clip { name, left, top, right, bottom } = *self.clip;
        if self.is_first {
            canvas.declare_clip(name, (left, top), (right, bottom));
        }
        let colour = self.series.colour;
        match self.series.mark {
            Mark::Line(dash) => {
                for line in self.points.split(Option::is_none) {
                    let line: Vec<_> = line.iter().flatten().copied().collect();
                    if line.len() > 1 {
                        canvas.curve(&thinned(&line, TOLERANCE), colour, dash, name);
                    }
                }
            }
            Mark::Dots => {
                let inside = |(x, y): &BackendCoord| (left..=right).contains(x) && (top..=bottom).contains(y);
                let mut dots: Vec<BackendCoord> = Vec::new();
                for dot in self.points.iter().flatten().copied().filter(inside) {
                    let far = |last: &BackendCoord| {
                        f64::from(dot.0 - last.0).hypot(f64::from(dot.1 - last.1)) >= DOT_DISTANCE
                    };
                    if dots.last().is_none_or(far) {
                        dots.push(dot);
                    }
                }
                canvas.dots(&dots, colour, name);
            }
            Mark::Area => {
                let outline: Vec<_> = self.points.iter().flatten().copied().collect();
                if outline.is_empty() {
                    return Ok(());
                }
                canvas.area(&thinned(&outline, TOLERANCE), colour, name);
            }
        }
        Ok(())
    }
}
