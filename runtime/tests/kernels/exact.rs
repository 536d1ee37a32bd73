//! What a plane's irradiance diffuses to, summed in f64 over every pixel of the frame.

use subsurface_profile::RadialProfile;

/// Shares of a profile's light by pixel: its integral over the pixels of a grid about the middle of one of them.
#[derive(Debug)]
pub(crate) struct PixelShares {
    side: u32,
    /// For 0 ≤ dx, dy < side.
    shares: Vec<f64>,
}

impl PixelShares {
    /// Shares of pixels up to `side` - 1 away along either axis.
    pub(crate) fn new(profile: &dyn RadialProfile, millimetres_per_pixel: f64, side: u32) -> Self {
        let mut shares = vec![0.0; (side * side) as usize];
        for dy in 0..side {
            for dx in dy..side {
                let share = share(profile, millimetres_per_pixel, dx, dy);
                shares[(dy * side + dx) as usize] = share;
                shares[(dx * side + dy) as usize] = share;
            }
        }
        Self { side, shares }
    }

    /// Diffused irradiance at a pixel of a plane that ends with the frame; light from beyond is renormalized.
    pub(crate) fn diffused(&self, size: [u32; 2], at: [u32; 2], irradiance: impl Fn(u32, u32) -> f64) -> f64 {
        let (mut sum, mut weights) = (0.0, 0.0);
        for y in 0..size[1] {
            let row = (y.abs_diff(at[1]) * self.side) as usize;
            for x in 0..size[0] {
                let share = self.shares[row + x.abs_diff(at[0]) as usize];
                sum += share * irradiance(x, y);
                weights += share;
            }
        }
        sum / weights
    }
}

/// Integral of a profile over one pixel.
fn share(profile: &dyn RadialProfile, millimetres_per_pixel: f64, dx: u32, dy: u32) -> f64 {
    if (dx, dy) == (0, 0) {
        return own_share(profile, millimetres_per_pixel);
    }
    // Midpoints: the density falls as fast as 1/r² near its pole, so nearer pixels get more of them.
    let points = match dx.max(dy) {
        1 => 24,
        2..4 => 8,
        4..12 => 3,
        _ => 1,
    };
    let place =
        |whole: u32, index: u32| f64::from(whole) + (f64::from(index) + 0.5) / f64::from(points) - 0.5;
    let sum: f64 = (0..points * points)
        .map(|index| {
            let radius_pixels = place(dx, index % points).hypot(place(dy, index / points));
            profile.area_pdf(millimetres_per_pixel * radius_pixels)
        })
        .sum();
    sum * (millimetres_per_pixel / f64::from(points)).powi(2)
}

/// Share of the pixel in the middle: over angles, since the density diverges there.
pub(crate) fn own_share(profile: &dyn RadialProfile, millimetres_per_pixel: f64) -> f64 {
    const ANGLES: u32 = 200;
    let sum: f64 = (0..ANGLES)
        .map(|index| {
            let angle = std::f64::consts::FRAC_PI_4 * (f64::from(index) + 0.5) / f64::from(ANGLES);
            profile.radial_cdf(0.5 * millimetres_per_pixel / angle.cos())
        })
        .sum();
    sum / f64::from(ANGLES)
}
