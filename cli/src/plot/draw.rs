//! The layout of a figure: title, panels, legend.

use super::canvas::{Canvas, TENTHS};
use super::figure::{Figure, Panel};
use super::legend::Legend;
use super::sheet::{Area, FONT_SIZE, MARGIN, Outcome, text};
use super::strokes::{Clip, Strokes};
use plotters::chart::ChartBuilder;
use plotters::coord::ranged1d::ValueFormatter as _;
use plotters::drawing::IntoDrawingArea as _;
use plotters::style::text_anchor::HPos;
use plotters::style::{Color as _, RGBColor};

/// Sizes in tenths of a pixel.
const TITLE_SIZE: i32 = 13 * TENTHS;
const TICK_SIZE: i32 = 11 * TENTHS;

/// Sizes in pixels.
const PANEL_HEIGHT: i32 = 360;
const TITLE_HEIGHT: i32 = 26;

/// The figure as SVG.
pub(super) fn draw(figure: &Figure) -> String {
    let width = match figure.panels.len() {
        0 | 1 => 640,
        2 => 860,
        count => 340 * count as i32,
    };
    let legend = Legend::of(figure, width * TENTHS - 2 * MARGIN * TENTHS);
    let height = TITLE_HEIGHT + PANEL_HEIGHT + legend.height() / TENTHS + MARGIN;
    let mut svg = String::new();
    let canvas = Canvas::begin(&mut svg, width, height);
    let root = canvas.into_drawing_area();
    let drawn = (|| {
        root.draw_text(&figure.title, &text(TITLE_SIZE, HPos::Center), (width * TENTHS / 2, 13 * TENTHS))?;
        let (_, below) = root.split_vertically(TITLE_HEIGHT * TENTHS);
        let (panels, below) = below.split_vertically(PANEL_HEIGHT * TENTHS);
        for (index, (area, panel)) in
            panels.split_evenly((1, figure.panels.len().max(1))).iter().zip(&figure.panels).enumerate()
        {
            draw_panel(area, panel, index)?;
        }
        legend.draw(&below)
    })();
    // Strings take all that is written to them, and every size above is positive.
    debug_assert!(drawn.is_ok(), "{drawn:?}");
    drop(root);
    Canvas::finish(&mut svg);
    svg
}

fn draw_panel(area: &Area<'_>, panel: &Panel, index: usize) -> Outcome {
    let mut builder = ChartBuilder::on(area);
    builder
        .margin_top(if panel.title.is_empty() { 4 } else { 24 } * TENTHS)
        .margin_right(16 * TENTHS)
        .margin_left(6 * TENTHS)
        .x_label_area_size(42 * TENTHS)
        .y_label_area_size(64 * TENTHS);
    let mut chart = builder.build_cartesian_2d(panel.x.clone(), panel.y.clone())?;
    let line = |grey: u8, width: u32| RGBColor(grey, grey, grey).stroke_width(width);
    chart
        .configure_mesh()
        .axis_style(line(0, 9))
        .bold_line_style(line(218, 6))
        .light_line_style(line(238, 5))
        .set_all_tick_mark_size(4 * TENTHS)
        .label_style(("sans-serif", TICK_SIZE))
        .axis_desc_style(("sans-serif", FONT_SIZE))
        .x_desc(&panel.x.label)
        .y_desc(&panel.y.label)
        .x_label_formatter(&|value| panel.x.format_ext(value))
        .y_label_formatter(&|value| panel.y.format_ext(value))
        .draw()?;
    let plotting = chart.plotting_area();
    let (columns, rows) = plotting.get_pixel_range();
    let clip_name = format!("p{index}");
    let clip =
        Clip { name: &clip_name, left: columns.start, top: rows.start, right: columns.end, bottom: rows.end };
    for (order, series) in panel.series.iter().enumerate() {
        let place = |point: &(f64, f64)| {
            (point.0.is_finite() && point.1.is_finite()).then(|| plotting.map_coordinate(point))
        };
        let points: Vec<_> = series.points.iter().map(place).collect();
        plotting.strip_coord_spec().draw(&Strokes {
            series,
            points: &points,
            clip: &clip,
            is_first: order == 0,
        })?;
    }
    let (width, _) = area.dim_in_pixel();
    if !panel.title.is_empty() {
        // Above the middle of the plot, not of the panel with its labels.
        let middle = (width as i32 + 54 * TENTHS) / 2;
        area.draw_text(&panel.title, &text(FONT_SIZE, HPos::Center), (middle, 12 * TENTHS))?;
    }
    Ok(())
}
