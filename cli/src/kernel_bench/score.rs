//! How far a picture is from the reference.

/// Differences over the translucent pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Score {
    /// Root mean square error over pixels and channels, in the unit of the irradiance.
    pub rmse: f64,
    /// The same of red, green and blue alone.
    pub channel_rmse: [f64; 3],
    /// 20 log₁₀(white / `rmse`), dB; infinite where there is no difference.
    pub psnr_db: f64,
}

impl Score {
    /// Holds `picture` against `reference` at `pixels`; `white` is what PSNR is relative to.
    pub fn of(picture: &[[f32; 4]], reference: &[[f32; 4]], pixels: &[usize], white: f64) -> Self {
        let mean_square: [f64; 3] = std::array::from_fn(|channel| {
            let difference =
                |pixel: &usize| f64::from(picture[*pixel][channel]) - f64::from(reference[*pixel][channel]);
            pixels.iter().map(|pixel| difference(pixel).powi(2)).sum::<f64>() / pixels.len() as f64
        });
        let rmse = (mean_square.iter().sum::<f64>() / 3.0).sqrt();
        Self { rmse, channel_rmse: mean_square.map(f64::sqrt), psnr_db: 20.0 * (white / rmse).log10() }
    }
}

/// Largest value of a picture at `pixels`.
pub(super) fn largest(picture: &[[f32; 4]], pixels: &[usize]) -> f64 {
    let values = pixels.iter().flat_map(|&pixel| &picture[pixel][..3]);
    f64::from(values.copied().fold(0.0, f32::max))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_constant_difference_is_its_own_root_mean_square() {
        let reference = [[0.5, 0.5, 0.5, 1.0]; 4];
        let mut picture = [[0.6, 0.5, 0.5, 0.0]; 4];
        // Not looked at.
        picture[3] = [f32::NAN; 4];
        let score = Score::of(&picture, &reference, &[0, 1, 2], 1.0);
        // Values of f32 near 0.5 are 6e-8 apart.
        assert!((score.channel_rmse[0] - 0.1).abs() < 1e-6 && score.channel_rmse[1] == 0.0);
        assert!((score.rmse - 0.1 / 3f64.sqrt()).abs() < 1e-6);
        // 20 log₁₀(√3 · 10)
        assert!((score.psnr_db - 24.771).abs() < 1e-3, "{}", score.psnr_db);
        assert_eq!(largest(&reference, &[0, 1]), 0.5);
    }

    #[test]
    fn without_a_difference_the_ratio_is_infinite() {
        let picture = [[0.1, 0.2, 0.3, 1.0]];
        assert_eq!(Score::of(&picture, &picture, &[0], 1.0).psnr_db, f64::INFINITY);
    }
}
