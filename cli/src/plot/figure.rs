//! What a figure consists of.

use super::axis::Axis;
use super::ink::{Colour, Dash};

/// Panels side by side over one legend.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// What the figure shows, above the panels.
    pub title: String,
    /// From left to right; one at least.
    pub panels: Vec<Panel>,
}

/// A pair of axes and what is drawn between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// What sets this panel apart; empty where it is the only one.
    pub title: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// Drawn in this order: the last lies on top.
    pub series: Vec<Series>,
}

/// Points of one kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Its line in the legend. Series of the same label share that line; an empty label has none.
    pub label: String,
    /// Colour of the line, the dots or the area.
    pub colour: Colour,
    /// How the points are drawn.
    pub mark: Mark,
    /// In the units of the axes. What is not finite interrupts a line.
    pub points: Vec<(f64, f64)>,
}

/// How points are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// Joined by a line.
    Line(Dash),
    /// As dots; those that would overlap are left out.
    Dots,
    /// As the outline of a pale area.
    Area,
}
