//! Irradiance by its normal.

use std::f64::consts::PI;

use super::Image;

/// Nine coefficients of the irradiance: Ramamoorthi and Hanrahan 2001, "An Efficient Representation for Irradiance
/// Environment Maps", with all constants multiplied out. The terms are those of `shaders/light/environment.wgsl`.
pub(super) fn irradiance(image: Image<'_>) -> [[f32; 4]; 9] {
    let mut sums = [[0.0_f64; 3]; 9];
    let mut total = 0.0;
    for y in 0..image.height {
        let (low, high) = [y, y + 1].map(|row| PI * f64::from(row) / f64::from(image.height)).into();
        let latitude = 0.5 * (low + high);
        // The solid angle of a pixel.
        let weight = 2.0 * PI / f64::from(image.width) * (f64::cos(low) - f64::cos(high));
        for x in 0..image.width {
            let longitude = 2.0 * PI * ((f64::from(x) + 0.5) / f64::from(image.width) - 0.5);
            let (sin, cos) = latitude.sin_cos();
            let terms = terms([sin * longitude.sin(), cos, -sin * longitude.cos()]);
            let pixel = image.pixels[(y * image.width + x) as usize];
            for (sum, term) in sums.iter_mut().zip(terms) {
                for (sum, value) in sum.iter_mut().zip(pixel) {
                    *sum += weight * term * f64::from(value);
                }
            }
            total += weight;
        }
    }
    let mut coefficients = [[0.0; 4]; 9];
    for (index, (coefficient, sum)) in coefficients.iter_mut().zip(sums).enumerate() {
        // Constants of the harmonic, twice: of the projection and of the sum; and of the cosine, by its order.
        let (square, cosine) = match index {
            0 => (1.0 / (4.0 * PI), PI),
            1..=3 => (3.0 / (4.0 * PI), 2.0 * PI / 3.0),
            6 => (5.0 / (16.0 * PI), PI / 4.0),
            8 => (15.0 / (16.0 * PI), PI / 4.0),
            _ => (15.0 / (4.0 * PI), PI / 4.0),
        };
        for (value, sum) in coefficient.iter_mut().zip(sum) {
            *value = (square * cosine * sum * 4.0 * PI / total) as f32;
        }
    }
    coefficients
}

/// The harmonics without their constants.
fn terms([x, y, z]: [f64; 3]) -> [f64; 9] {
    [1.0, y, z, x, x * y, y * z, 3.0 * z * z - 1.0, x * z, x * x - y * y]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(coefficients: &[[f32; 4]; 9], normal: [f64; 3]) -> f64 {
        coefficients.iter().zip(terms(normal)).map(|(c, term)| f64::from(c[0]) * term).sum()
    }

    /// The image of a function of the direction.
    fn image(of: impl Fn([f64; 3]) -> f32) -> Vec<[f32; 3]> {
        let pixel = |index: usize| {
            let (x, y) = (index % 128, index / 128);
            let longitude = 2.0 * PI * ((x as f64 + 0.5) / 128.0 - 0.5);
            let latitude = PI * (y as f64 + 0.5) / 64.0;
            let (sin, cos) = latitude.sin_cos();
            [of([sin * longitude.sin(), cos, -sin * longitude.cos()]); 3]
        };
        (0..128 * 64).map(pixel).collect()
    }

    #[test]
    fn light_from_everywhere_is_irradiance_pi() {
        let pixels = image(|_| 0.5);
        let found = irradiance(Image { width: 128, height: 64, pixels: &pixels });
        for normal in [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.6, 0.0, 0.8]] {
            // Sums over the pixels.
            assert!((at(&found, normal) - 0.5 * PI).abs() < 1e-3, "{}", at(&found, normal));
        }
    }

    #[test]
    fn a_sky_lights_what_faces_it() {
        // Radiance (1 + d·y)/2 has irradiance π/2 + π/3 n·y.
        let pixels = image(|[_, y, _]| (0.5 + 0.5 * y) as f32);
        let found = irradiance(Image { width: 128, height: 64, pixels: &pixels });
        for y in [-1.0_f64, -0.3, 0.0, 0.5, 1.0] {
            let expected = PI / 2.0 + PI / 3.0 * y;
            let found = at(&found, [(1.0 - y * y).sqrt(), y, 0.0]);
            assert!((found - expected).abs() < 2e-3, "{y}: {found}, not {expected}");
        }
        // A light on the right lights the right, one ahead what looks to −z.
        for (axis, towards) in [(0, [1.0, 0.0, 0.0]), (2, [0.0, 0.0, -1.0])] {
            let pixels = image(|d| if d[axis] * towards[axis] > 0.9 { 1.0 } else { 0.0 });
            let found = irradiance(Image { width: 128, height: 64, pixels: &pixels });
            assert!(at(&found, towards) > 4.0 * at(&found, [0.0, 1.0, 0.0]).abs());
        }
    }
}
