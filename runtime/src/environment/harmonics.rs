//! Irradiance by its normal.

use std::f64::consts::PI;

use super::Image;

/// Rows over which the sums go at least: a pixel of a small image stands for many directions.
const LEAST_ROWS: u32 = 64;

/// Nine coefficients of the irradiance: Ramamoorthi and Hanrahan 2001, "An Efficient Representation for Irradiance
/// Environment Maps", with all constants multiplied out. The terms are those of `shaders/light/environment.wgsl`.
pub(super) fn irradiance(image: Image<'_>) -> [[f32; 4]; 9] {
    let mut sums = [[0.0_f64; 3]; 9];
    let mut total = 0.0;
    let parts = LEAST_ROWS.div_ceil(image.height);
    let [rows, columns] = [image.height * parts, image.width * parts];
    for row in 0..rows {
        let [low, high] = [row, row + 1].map(|row| PI * f64::from(row) / f64::from(rows));
        let latitude = 0.5 * (low + high);
        // The solid angle of a part.
        let weight = 2.0 * PI / f64::from(columns) * (low.cos() - high.cos());
        for column in 0..columns {
            let longitude = 2.0 * PI * ((f64::from(column) + 0.5) / f64::from(columns) - 0.5);
            let (sin, cos) = latitude.sin_cos();
            let terms = terms([sin * longitude.sin(), cos, -sin * longitude.cos()]);
            let pixel = image.pixels[(row / parts * image.width + column / parts) as usize];
            for (sum, term) in sums.iter_mut().zip(terms) {
                for (sum, value) in sum.iter_mut().zip(pixel) {
                    *sum += weight * term * f64::from(value);
                }
            }
            total += weight;
        }
    }
    let mut coefficients = [[0.0; 3]; 9];
    for (index, (coefficient, sum)) in coefficients.iter_mut().zip(sums).enumerate() {
        // Constants of the harmonic, twice: of the projection and of the sum; and of the cosine, by its order.
        let (square, cosine) = match index {
            0 => (1.0 / (4.0 * PI), PI),
            1..=3 => (3.0 / (4.0 * PI), 2.0 * PI / 3.0),
            6 => (5.0 / (16.0 * PI), PI / 4.0),
            8 => (15.0 / (16.0 * PI), PI / 4.0),
            _ => (15.0 / (4.0 * PI), PI / 4.0),
        };
        *coefficient = sum.map(|sum| square * cosine * sum * 4.0 * PI / total);
    }
    let window = window(&coefficients);
    let mut windowed = [[0.0; 4]; 9];
    for (index, (windowed, coefficient)) in windowed.iter_mut().zip(coefficients).enumerate() {
        for (windowed, value) in windowed.iter_mut().zip(coefficient) {
            *windowed = (value * share(window, index)) as f32;
        }
    }
    windowed
}

/// What a window leaves of a coefficient: 1/(1 + λ l²(l + 1)²) of order l.
fn share(window: f64, index: usize) -> f64 {
    let order = [0.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 2.0, 2.0][index];
    1.0 / (1.0 + window * (order * (order + 1.0_f64)).powi(2))
}

/// The narrowest window λ under which no channel is negative anywhere: nine coefficients of a small bright light ring,
/// and would darken what faces away (Sloan 2017, "Deringing Spherical Harmonics").
fn window(coefficients: &[[f64; 3]; 9]) -> f64 {
    let directions: Vec<[f64; 9]> = (0..32 * 64)
        .map(|at| {
            let (latitude, longitude) =
                (PI * (f64::from(at / 64) + 0.5) / 32.0, 2.0 * PI * f64::from(at % 64) / 64.0);
            let (sin, cos) = latitude.sin_cos();
            terms([sin * longitude.sin(), cos, -sin * longitude.cos()])
        })
        .collect();
    let is_light = |window: f64| {
        directions.iter().all(|terms| {
            (0..3).all(|channel: usize| {
                let parts = terms.iter().enumerate();
                let sum: f64 = parts
                    .map(|(index, term)| term * coefficients[index][channel] * share(window, index))
                    .sum();
                sum >= -1e-9 * coefficients[0][channel]
            })
        })
    };
    if is_light(0.0) {
        return 0.0;
    }
    // At the widest nothing but the mean is left, which is light.
    let (mut narrow, mut wide) = (0.0, 1e3);
    for _ in 0..40 {
        let middle = 0.5 * (narrow + wide);
        if is_light(middle) { wide = middle } else { narrow = middle }
    }
    wide
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
    fn a_small_bright_light_darkens_nothing() {
        let pixels = image(|[x, y, _]| if x * 0.6 + y * 0.8 > 0.995 { 100.0 } else { 0.05 });
        let found = irradiance(Image { width: 128, height: 64, pixels: &pixels });
        for step in 0..64 {
            let angle = 2.0 * PI * f64::from(step) / 64.0;
            for normal in [[angle.cos(), angle.sin(), 0.0], [0.0, angle.sin(), angle.cos()]] {
                assert!(at(&found, normal) > -1e-6, "{} at {normal:?}", at(&found, normal));
            }
        }
        assert!(at(&found, [0.6, 0.8, 0.0]) > 3.0 * at(&found, [-0.6, -0.8, 0.0]), "it still has a side");
    }

    #[test]
    fn two_pixels_are_a_sky_too() {
        for (width, height) in [(2, 1), (4, 2), (10, 5)] {
            let pixels = vec![[0.5; 3]; (width * height) as usize];
            let found = irradiance(Image { width, height, pixels: &pixels });
            for normal in [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.6, 0.0, 0.8]] {
                // Sums over the parts of pixels.
                assert!((at(&found, normal) - 0.5 * PI).abs() < 2e-3, "{width}: {}", at(&found, normal));
            }
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
            assert!(at(&found, towards) > 2.0 * at(&found, [0.0, 1.0, 0.0]));
        }
    }
}
