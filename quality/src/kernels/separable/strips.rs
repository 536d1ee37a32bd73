//! Strips of the picture beside a pixel: the twin of `shaders/kernels/separable/strips.wgsl`.

use subsurface_kernel::constants::LARGEST_TAP_DISTANCE;

use crate::gather::point::Point;

/// A strip beside the centre: lines at distances from `start` to `end`, pixels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Strip {
    pub(crate) start: f64,
    pub(crate) end: f64,
    /// Whole distances of the two lines that stand for it, one for each half; the same if the strip has only one.
    pub(crate) lines: [f64; 2],
}

/// Strips of equal shares of the widest channel, of which `beyond_centre` lands beside the centre, from the centre on.
pub(crate) fn beside_centre(
    point: &Point<'_>,
    beyond_centre: f64,
    strips: u32,
) -> impl Iterator<Item = Strip> {
    let curve = &point.optics.channels[point.optics.widest].edge_curve;
    let reach = move |inside: f64| (curve.line_reach(inside) / point.pixel).min(LARGEST_TAP_DISTANCE);
    let mut start = 0.5;
    (1..=strips).map(move |strip| {
        // The last one has no end: its middle halves its light.
        let is_last = strip == strips;
        let place = f64::from(strip) - if is_last { 0.5 } else { 0.0 };
        let reach = reach(1.0 - beyond_centre * (1.0 - place / f64::from(strips)));
        let end = if is_last { 2.0 * reach - start } else { reach.floor() + 0.5 };
        let end = end.max(start + 1.0);
        let width = end - start;
        let quarter = if width >= 2.0 { 0.25 * width } else { 0.0 };
        let middle = 0.5 * (start + end);
        let lines = [(middle - quarter - 0.5).ceil(), (middle + quarter + 0.5).floor()];
        let strip = Strip { start, end, lines };
        start = end;
        strip
    })
}
