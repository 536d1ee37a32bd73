//! A ball, pixel by pixel.

use super::share::share;
use crate::gather::gathered::{Gathered, Rgb};
use crate::gather::point::Point;
use crate::pictures::scene::Scene;

/// Pixels of a ball of that radius about (0, 0).
pub(crate) fn expected(point: &Point<'_>, scene: Scene, radius: f64, pixels: &[[i32; 2]]) -> Vec<Rgb> {
    let reach = radius.ceil() as i32;
    let places = || (-reach..=reach).flat_map(|y| (-reach..=reach).map(move |x| [x, y]));
    let shown: Vec<[i32; 2]> = places().filter(|[x, y]| scene.covers(*x, *y)).collect();
    let pixel = |[x, y]: &[i32; 2]| {
        let mut gathered = Gathered::default();
        for [at_x, at_y] in &shown {
            let (across, down) = ((at_x - x).abs(), (at_y - y).abs());
            let depth = point.depth_pixels(scene.depth(*at_x, *at_y) - scene.depth(*x, *y));
            let share = share(point, [across.max(down), across.min(down)], depth);
            gathered.add(share, [scene.light(*at_x, *at_y); 3]);
        }
        gathered.diffused([scene.light(*x, *y); 3], point.returned)
    };
    pixels.iter().map(pixel).collect()
}
