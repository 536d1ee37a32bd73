//! A lit disc, pixel by pixel.

use std::f64::consts::FRAC_PI_4;

use subsurface_profile::RadialProfile;

use super::GAUSS;
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
        let eighth: Vec<Rgb> = places.map(|place| share(point, place)).collect();
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

/// Share of the pixel at a place around the centre.
fn share(point: &Point<'_>, [long, short]: [i32; 2]) -> Rgb {
    if long == 0 {
        return [0, 1, 2]
            .map(|channel: usize| centre_share(&*point.optics.channels[channel].profile, 0.5 * point.pixel));
    }
    // Profiles are steep close to the centre: the midpoint rule's error falls with the square of points × distance.
    let points = match long {
        1 => 12,
        2..=4 => 4,
        5..=16 => 2,
        _ => 1,
    };
    let mut sum = [0.0; 3];
    for place in 0..points * points {
        let within = |place: i32| (f64::from(place) + 0.5) / f64::from(points) - 0.5;
        let x = f64::from(long) + within(place % points);
        let y = f64::from(short) + within(place / points);
        let density = point.area_pdf(x.hypot(y) * point.pixel);
        for channel in 0..3 {
            sum[channel] += density[channel];
        }
    }
    let area = point.pixel * point.pixel / f64::from(points * points);
    sum.map(|density| density * area)
}

/// Share of the square around the centre, `half` its side long: (4/π) ∫ cdf(half / cos θ) dθ over θ in [0, π/4], since
/// profiles diverge at the centre and the integral over the radius is the CDF.
fn centre_share(profile: &dyn RadialProfile, half: f64) -> f64 {
    GAUSS
        .into_iter()
        .map(|(place, weight)| weight * profile.radial_cdf(half / ((place + 0.5) * FRAC_PI_4).cos()))
        .sum()
}
