//! The share of a profile's light that a pixel has.

use std::f64::consts::FRAC_PI_4;

use subsurface_profile::RadialProfile;

use super::GAUSS;
use crate::gather::gathered::Rgb;
use crate::gather::point::Point;

/// Share of the pixel at a place around the centre, the longer side of it first, that lies `depth` pixels deeper.
pub(super) fn share(point: &Point<'_>, [long, short]: [i32; 2], depth: f64) -> Rgb {
    if long == 0 {
        return [0, 1, 2]
            .map(|channel: usize| centre_share(&*point.optics.channels[channel].profile, 0.5 * point.pixel));
    }
    // Profiles are steep close to the centre: the midpoint rule's error falls with the square of points × distance, and is
    // (n / 8)²/24 of a density that falls as r⁻ⁿ: 0.3 % for n = 2, of pixels that have a part of the light each.
    let points = (8 + long - 1) / long;
    let squared_pixel = point.pixel * point.pixel;
    let mut sum = [0.0; 3];
    for place in 0..points * points {
        let within = |place: i32| (f64::from(place) + 0.5) / f64::from(points) - 0.5;
        let x = f64::from(long) + within(place % points);
        let y = f64::from(short) + within(place / points);
        let density = point.area_pdf_at_squared((x * x + y * y + depth * depth) * squared_pixel);
        for channel in 0..3 {
            sum[channel] += density[channel];
        }
    }
    let area = squared_pixel / f64::from(points * points);
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
