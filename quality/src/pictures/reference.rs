//! The exact result: the profile integrated over every lit pixel.

mod ball;
mod crease;
mod disc;
mod share;

use crate::gather::gathered::{Gathered, Rgb};
use crate::gather::point::Point;
use crate::optics::line_spread::edge_spread;
use crate::pictures::patch::Patch;
use crate::pictures::scene::{Scene, Surface};
use crease::Crease;

/// Points and weights of Gauss–Legendre quadrature over [-1/2, 1/2], Abramowitz and Stegun, table 25.4.
const GAUSS: [(f64, f64); 4] = [
    (-0.430_568_155_797_026_3, 0.173_927_422_568_727),
    (-0.169_990_521_792_428_1, 0.326_072_577_431_273),
    (0.169_990_521_792_428_1, 0.326_072_577_431_273),
    (0.430_568_155_797_026_3, 0.173_927_422_568_727),
];

/// What the pixels of some patches would have with endless taps; `None` for those that show no surface.
pub(crate) fn expected(point: &Point<'_>, scene: Scene, patches: &[Patch]) -> Vec<Option<Rgb>> {
    let pixels: Vec<[i32; 2]> =
        patches.iter().flat_map(|patch| patch.pixels().map(|pixel| patch.in_scene(pixel))).collect();
    if scene == Scene::Pan {
        // It is held against what it was before.
        return vec![None; pixels.len()];
    }
    let shown: Vec<[i32; 2]> = pixels.iter().copied().filter(|[x, y]| scene.covers(*x, *y)).collect();
    let found = if let Some(radius) = scene.lit_disc() {
        disc::expected(point, radius, &shown)
    } else if let Scene::Ball { radius, .. } = scene {
        ball::expected(point, scene, radius, &shown)
    } else {
        in_columns(point, scene, &shown)
    };
    let mut found = found.into_iter();
    pixels.iter().map(|[x, y]| if scene.covers(*x, *y) { found.next() } else { None }).collect()
}

/// Pixels of a scene whose rows are alike: columns are integrated once.
fn in_columns(point: &Point<'_>, scene: Scene, pixels: &[[i32; 2]]) -> Vec<Rgb> {
    let first = pixels.iter().map(|[x, _]| *x).min().unwrap_or_default();
    let last = pixels.iter().map(|[x, _]| *x).max().unwrap_or_default();
    // Each pixel spreads light as its own surface does.
    let columns = columns_of(point, scene, first, last);
    let other = match scene {
        Scene::AlbedoEdge => columns_of(&point.on(Surface::Other), scene, first, last),
        _ => Vec::new(),
    };
    let column = |x: i32| {
        let place = (x - first) as usize;
        if scene.surface(x, x) == Surface::Other { other[place] } else { columns[place] }
    };
    pixels.iter().map(|[x, _]| column(*x)).collect()
}

/// The columns from `first` to `last` in a scene whose rows are alike.
fn columns_of(point: &Point<'_>, scene: Scene, first: i32, last: i32) -> Vec<Rgb> {
    let by_channel = [0, 1, 2].map(|channel: usize| {
        let profile = &*point.optics.channels[channel].profile;
        // Light from column `from` on arrives in column x.
        let from = |x: i32, from: i32| edge_spread(profile, (f64::from(x - from) + 0.5) * point.pixel);
        let columns = first..=last;
        match scene {
            Scene::Line => columns.map(|x| from(x, 0) - from(x, 1)).collect(),
            Scene::Crease if point.in_depth => Crease::new(point, channel).columns(first, last),
            Scene::Frame { half } => columns
                .map(|x| {
                    let is_lit = f64::from(u8::from(x >= 0));
                    let [lit, all] = [0, -half].map(|start| from(x, start) - from(x, half));
                    let mut gathered = Gathered::default();
                    gathered.add([lit; 3], [1.0; 3]);
                    gathered.add([all - lit; 3], [0.0; 3]);
                    gathered.diffused([is_lit; 3], point.returned)[0]
                })
                .collect(),
            _ => columns.map(|x| from(x, 0)).collect::<Vec<f64>>(),
        }
    });
    (0..by_channel[0].len())
        .map(|column| [0, 1, 2].map(|channel: usize| by_channel[channel][column]))
        .collect()
}
