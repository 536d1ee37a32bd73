//! The exact result: the profile integrated over every lit pixel.

mod crease;
mod disc;

use crate::gather::gathered::Rgb;
use crate::gather::point::Point;
use crate::optics::line_spread::edge_spread;
use crate::pictures::patch::Patch;
use crate::pictures::scene::Scene;
use crease::Crease;

/// Points and weights of Gauss–Legendre quadrature over [-1/2, 1/2], Abramowitz and Stegun, table 25.4.
const GAUSS: [(f64, f64); 4] = [
    (-0.430_568_155_797_026_3, 0.173_927_422_568_727),
    (-0.169_990_521_792_428_1, 0.326_072_577_431_273),
    (0.169_990_521_792_428_1, 0.326_072_577_431_273),
    (0.430_568_155_797_026_3, 0.173_927_422_568_727),
];

/// What the pixels of some patches would have with endless taps.
pub(crate) fn expected(point: &Point<'_>, scene: Scene, patches: &[Patch]) -> Vec<Rgb> {
    let pixels: Vec<[i32; 2]> =
        patches.iter().flat_map(|patch| patch.pixels().map(|pixel| patch.in_scene(pixel))).collect();
    if let Scene::Disc { radius } = scene {
        return disc::expected(point, radius, &pixels);
    }
    // Rows are alike: columns are integrated once.
    let first = pixels.iter().map(|[x, _]| *x).min().unwrap_or_default();
    let last = pixels.iter().map(|[x, _]| *x).max().unwrap_or_default();
    let columns = columns(point, scene, first, last);
    pixels.iter().map(|[x, _]| columns[(x - first) as usize]).collect()
}

/// The columns from `first` to `last` in a scene whose rows are alike.
fn columns(point: &Point<'_>, scene: Scene, first: i32, last: i32) -> Vec<Rgb> {
    let by_channel = [0, 1, 2].map(|channel: usize| {
        let profile = &*point.optics.channels[channel].profile;
        // The light begins half a pixel before the middle of column 0.
        let edges: Vec<f64> =
            (first - 1..=last).map(|x| edge_spread(profile, (f64::from(x) + 0.5) * point.pixel)).collect();
        match scene {
            Scene::Line => edges.windows(2).map(|ends| ends[1] - ends[0]).collect(),
            Scene::Crease if point.in_depth => Crease::new(point, channel).columns(first, last),
            _ => edges[1..].to_vec(),
        }
    });
    (0..by_channel[0].len())
        .map(|column| [0, 1, 2].map(|channel: usize| by_channel[channel][column]))
        .collect()
}
