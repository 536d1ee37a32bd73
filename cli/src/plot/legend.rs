//! Which line is what: columns below the panels.

use super::canvas::{Canvas, TENTHS};
use super::figure::{Figure, Mark, Series};
use super::lettering::text_width;
use super::sheet::{Area, FONT_SIZE, MARGIN, Outcome, text};
use plotters::element::{Drawable, PointCollection};
use plotters::style::text_anchor::HPos;
use plotters_backend::{BackendCoord, DrawingErrorKind};
use std::convert::Infallible;

/// Sizes in tenths of a pixel.
const ROW: i32 = 18 * TENTHS;
const TOP: i32 = 6 * TENTHS;
const SAMPLE: i32 = 36 * TENTHS;
const GAP: i32 = 8 * TENTHS;
const COLUMN_GAP: i32 = 22 * TENTHS;

/// One entry for each label of a figure.
pub(super) struct Legend<'a> {
    entries: Vec<&'a Series>,
    columns: usize,
    column_width: i32,
    width: i32,
}

impl<'a> Legend<'a> {
    /// The labels of all panels, each once, in columns within `width` tenths of a pixel.
    pub(super) fn of(figure: &'a Figure, width: i32) -> Self {
        let mut entries: Vec<&Series> = Vec::new();
        for series in figure.panels.iter().flat_map(|panel| &panel.series) {
            if !series.label.is_empty() && entries.iter().all(|entry| entry.label != series.label) {
                entries.push(series);
            }
        }
        let widest = entries.iter().map(|entry| text_width(&entry.label, f64::from(FONT_SIZE)));
        let column_width = SAMPLE + GAP + COLUMN_GAP + widest.fold(0.0, f64::max).ceil() as i32;
        let fitting = usize::try_from(((width + COLUMN_GAP) / column_width).max(1)).unwrap_or(1);
        // As many rows as it takes, then only as many columns as those rows need.
        let rows = entries.len().div_ceil(fitting).max(1);
        let columns = entries.len().div_ceil(rows).max(1);
        Self { entries, columns, column_width, width }
    }

    /// Height in tenths of a pixel.
    pub(super) fn height(&self) -> i32 {
        TOP + ROW * self.entries.len().div_ceil(self.columns) as i32
    }

    /// Draws the entries, column by column, centred.
    pub(super) fn draw(&self, area: &Area<'_>) -> Outcome {
        let rows = self.entries.len().div_ceil(self.columns).max(1);
        let left =
            MARGIN * TENTHS + (self.width - self.columns as i32 * self.column_width + COLUMN_GAP).max(0) / 2;
        for (index, series) in self.entries.iter().enumerate() {
            let x = left + (index / rows) as i32 * self.column_width;
            let y = TOP + (index % rows) as i32 * ROW + ROW / 2;
            area.draw(&Sample { series, ends: [(x, y), (x + SAMPLE, y)] })?;
            area.draw_text(&series.label, &text(FONT_SIZE, HPos::Left), (x + SAMPLE + GAP, y))?;
        }
        Ok(())
    }
}

/// A short piece of a series.
struct Sample<'a> {
    series: &'a Series,
    ends: [BackendCoord; 2],
}

impl<'a> PointCollection<'a, BackendCoord> for &'a Sample<'a> {
    type Point = &'a BackendCoord;
    type IntoIter = std::slice::Iter<'a, BackendCoord>;

    fn point_iter(self) -> Self::IntoIter {
        self.ends.iter()
    }
}

impl Drawable<Canvas<'_>> for Sample<'_> {
    fn draw<I: Iterator<Item = BackendCoord>>(
        &self,
        points: I,
        canvas: &mut Canvas<'_>,
        _: (u32, u32),
    ) -> Result<(), DrawingErrorKind<Infallible>> {
        let ends: Vec<BackendCoord> = points.collect();
        let [from, to] = ends[..] else { return Ok(()) };
        let colour = self.series.colour;
        match self.series.mark {
            Mark::Line(dash) => canvas.curve(&ends, colour, dash, ""),
            Mark::Dots => {
                let between = |share: i32| (from.0 + (to.0 - from.0) * share / 4, from.1);
                canvas.dots(&[1, 2, 3].map(between), colour, "");
            }
            Mark::Area => {
                let half = 5 * TENTHS;
                let corners = [
                    (from.0, from.1 - half),
                    (to.0, to.1 - half),
                    (to.0, to.1 + half),
                    (from.0, from.1 + half),
                ];
                canvas.area(&corners, colour, "");
            }
        }
        Ok(())
    }
}
