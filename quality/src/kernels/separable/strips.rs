//! Strips of the picture beside a pixel: the twin of `shaders/kernels/separable/strips.wgsl`.

use subsurface_kernel::constants::{EVEN_LINES, LARGEST_TAP_DISTANCE, OPEN_LINES};

use crate::gather::point::Point;

/// A strip beside the centre: lines at distances from `start` to `end`, pixels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Strip {
    pub(crate) start: f64,
    pub(crate) end: f64,
    /// Whole distances of the two lines that stand for it, one for each half; the same if the strip has only one.
    pub(crate) lines: [f64; 2],
}

/// Strips by their shares of the widest channel, of which `beyond_centre` lands beside the centre, from the centre on.
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
        let part = |left: u32| (f64::from(left) / f64::from(strips)).powf(1.5);
        let beyond = if is_last { 0.5 * part(1) } else { part(strips - strip) };
        let reach = reach(1.0 - beyond_centre * beyond);
        let end = if is_last { 2.0 * reach - start } else { reach.floor() + 0.5 };
        let end = end.max(start + 1.0);
        let width = end - start;
        let places = if is_last { OPEN_LINES } else { EVEN_LINES };
        let [near, far] = if width < 2.0 { [0.5; 2] } else { places }.map(|place| start + place * width);
        let lines = [(near - 0.5).ceil(), (far + 0.5).floor()];
        let strip = Strip { start, end, lines };
        start = end;
        strip
    })
}
