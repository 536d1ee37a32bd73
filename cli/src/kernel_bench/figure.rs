//! Reports as a figure: error over time.

use super::report::Report;
use crate::plot::{Axis, Colour, Dash, Figure, Mark, Panel, Series};

/// Room around the points: a factor on the time, and dB.
const ROOM: (f64, f64) = (1.15, 1.5);

/// PSNR over time, a panel per report and a line per family: what lies up and to the left is better. `None` where
/// nothing was timed.
pub fn pareto(title: &str, reports: &[&Report]) -> Option<Figure> {
    let mut families: Vec<&str> = Vec::new();
    for line in reports.iter().flat_map(|report| &report.lines) {
        if !families.contains(&line.family.as_str()) {
            families.push(&line.family);
        }
    }
    let all: Vec<(f64, f64)> = reports.iter().flat_map(|report| points(report, None)).collect();
    let range = |values: &dyn Fn(&(f64, f64)) -> f64| {
        let values = || all.iter().map(values);
        (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max))
    };
    if all.is_empty() {
        return None;
    }
    let (fastest, slowest) = range(&|point| point.0);
    let (worst, best) = range(&|point| point.1);
    let panel = |report: &&Report| Panel {
        title: report.case.clone(),
        x: Axis::log("time (importance-sampled 17 = 1)", fastest / ROOM.0, slowest * ROOM.0),
        y: Axis::linear("PSNR against dense (dB)", worst - ROOM.1, best + ROOM.1),
        series: families
            .iter()
            .enumerate()
            .flat_map(|(index, family)| lines(report, family, index))
            .collect(),
    };
    Some(Figure { title: title.to_owned(), panels: reports.iter().map(panel).collect() })
}

/// A line through the family's points, and the points.
fn lines(report: &Report, family: &str, index: usize) -> [Series; 2] {
    let colour = Colour::unordered(index);
    let mut points = points(report, Some(family));
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mark = Mark::Line(Dash::nth(index));
    [
        Series { label: family.to_owned(), colour, mark, points: points.clone() },
        Series { label: String::new(), colour, mark: Mark::Dots, points },
    ]
}

/// Time ratio and PSNR of a family, or of all.
fn points(report: &Report, family: Option<&str>) -> Vec<(f64, f64)> {
    let own = report.lines.iter().filter(|line| family.is_none_or(|family| line.family == family));
    own.filter_map(|line| Some((line.time?.ratio, line.score.psnr_db)))
        .filter(|(ratio, psnr)| ratio.is_finite() && *ratio > 0.0 && psnr.is_finite())
        .collect()
}
