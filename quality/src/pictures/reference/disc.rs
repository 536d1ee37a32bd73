//! A lit disc, pixel by pixel.

use super::share::share;
use crate::gather::gathered::Rgb;
use crate::gather::point::Point;

/// Pixels of a plane with a lit disc about (0, 0).
pub(crate) fn expected(point: &Point<'_>, radius: f64, pixels: &[[i32; 2]]) -> Vec<Rgb> {
    let lit = radius.floor() as i32;
    let reach = pixels.iter().flatten().map(|place| place.abs()).max().unwrap_or_default() + lit;
    let shares = PixelShares::new(point, reach);
    let rows: Vec<(i32, i32)> = (-lit..=lit)
        .map(|y| (y, (radius * radius - f64::from(y * y)).max(0.0).sqrt().floor() as i32))
        .collect();
    let pixel = |[x, y]: &[i32; 2]| {
        let mut sum = [0.0; 3];
        for (row, half) in &rows {
            let run = shares.run(row - y, -half - x, half - x);
            for channel in 0..3 {
                sum[channel] += run[channel];
            }
        }
        sum
    };
    pixels.iter().map(pixel).collect()
}

/// Shares of a profile's light that the pixels around one have, as sums along rows.
struct PixelShares {
    reach: i32,
    /// Row by row from the pixel's own on: the share of all pixels of the row before each, from -reach on.
    before: Vec<Rgb>,
}

impl PixelShares {
    fn new(point: &Point<'_>, reach: i32) -> Self {
        // An eighth of the plane; the rest are mirror images.
        let places = (0..=reach).flat_map(|long| (0..=long).map(move |short| [long, short]));
        let eighth: Vec<Rgb> = places.map(|place| share(point, place, 0.0)).collect();
        let mut before = Vec::new();
        for y in 0..=reach {
            let mut sum = [0.0; 3];
            before.push(sum);
            for x in -reach..=reach {
                let (long, short) = (x.abs().max(y) as usize, x.abs().min(y) as usize);
                let share = eighth[long * (long + 1) / 2 + short];
                for channel in 0..3 {
                    sum[channel] += share[channel];
                }
                before.push(sum);
            }
        }
        Self { reach, before }
    }

    /// Share of the pixels of a row from `first` to `last`.
    fn run(&self, row: i32, first: i32, last: i32) -> Rgb {
        let start = row.abs() * (2 * self.reach + 2) + self.reach;
        let [from, to] = [first, last + 1].map(|x| self.before[(start + x) as usize]);
        std::array::from_fn(|channel| to[channel] - from[channel])
    }
}
