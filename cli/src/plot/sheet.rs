//! The sheet that title, panels and legend are drawn on, and its text.

use super::canvas::{Canvas, TENTHS};
use plotters::coord::Shift;
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{IntoFont as _, TextStyle};
use std::convert::Infallible;

/// Size of labels, tenths of a pixel.
pub(super) const FONT_SIZE: i32 = 12 * TENTHS;

/// Space at the sides and below, pixels.
pub(super) const MARGIN: i32 = 12;

pub(super) type Area<'a> = DrawingArea<Canvas<'a>, Shift>;
pub(super) type Outcome = Result<(), DrawingAreaErrorKind<Infallible>>;

/// A style of text whose place is its middle, vertically.
pub(super) fn text(size: i32, horizontal: HPos) -> TextStyle<'static> {
    TextStyle::from(("sans-serif", size).into_font()).pos(Pos::new(horizontal, VPos::Center))
}
