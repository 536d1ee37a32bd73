//! How far a picture is from the truth.

use super::exr::Channels;
use super::{DisplayPicture, LinearPicture, PictureError};
use crate::scene::camera::Size;
use nv_flip::{DEFAULT_PIXELS_PER_DEGREE, FlipImageRgb8};
use std::path::Path;

/// Share of the brightest pixel's light that a lit one has at least.
const LIT: f32 = 0.01;

/// Coverage above which no ray of a pixel missed.
const COVERED: f32 = 0.999;

/// Steps of colour on either side of a map.
const MAP_STEPS: f32 = 8.0;

/// Error relative to the mean of the truth whose colour on the map is full.
const FULL_COLOUR: f32 = 0.25;

/// A picture that others are held against.
#[derive(Clone, Debug)]
pub struct Truth {
    /// Radiance.
    pub picture: LinearPicture,
    /// Standard error of each pixel; `None` where the file has none and its noise counts as error.
    pub standard_error: Option<Vec<[f32; 3]>>,
    /// The pixels that count.
    pub counts: Vec<bool>,
}

impl Truth {
    /// Reads `R`, `G`, `B`, where the file has them the standard errors `stderr.R`, `stderr.G`, `stderr.B`, and the
    /// coverage `A`.
    ///
    /// Lit pixels count: those that are covered and have a hundredth of the brightest one's light.
    pub fn read(path: &Path) -> Result<Self, PictureError> {
        let channels = Channels::read(path)?;
        let picture = read_picture(path, &channels)?;
        let size = picture.size;
        let has_error = channels.has("stderr.R");
        let standard_error = if has_error { Some(channels.colours("stderr", size)?) } else { None };
        let covered = if channels.has("A") {
            channels.samples("A", size)?.into_iter().map(|coverage| coverage >= COVERED).collect()
        } else {
            vec![true; size.pixels()]
        };
        let light = |pixel: &[f32; 3]| pixel.iter().sum::<f32>();
        let covered_pixels = picture.pixels.iter().zip(&covered).filter(|(_, covered)| **covered);
        let brightest = covered_pixels.map(|(pixel, _)| light(pixel)).fold(0.0, f32::max);
        let is_lit = |(pixel, covered): (&[f32; 3], bool)| {
            covered && brightest > 0.0 && light(pixel) >= LIT * brightest
        };
        let counts = picture.pixels.iter().zip(covered).map(is_lit).collect();
        Ok(Self { picture, standard_error, counts })
    }

    /// Lets the pixels count where a file's `Y`, or `R`, is above a half.
    pub fn mask(&mut self, path: &Path) -> Result<(), PictureError> {
        let channels = Channels::read(path)?;
        let name = if channels.has("Y") { "Y" } else { "R" };
        let mask = channels.samples(name, self.picture.size)?;
        self.counts = mask.into_iter().map(|value| value > 0.5).collect();
        Ok(())
    }
}

/// Reads `R`, `G` and `B`; every value must be finite.
pub fn read_picture(path: &Path, channels: &Channels) -> Result<LinearPicture, PictureError> {
    let size = channels.size("R")?;
    let [r, g, b] = ["R", "G", "B"].map(|name| channels.samples(name, size));
    let (r, g, b) = (r?, g?, b?);
    let pixels: Vec<[f32; 3]> = r.into_iter().zip(g).zip(b).map(|((r, g), b)| [r, g, b]).collect();
    let wrong = pixels.iter().position(|pixel| !pixel.iter().all(|value| value.is_finite()));
    if let Some(pixel) = wrong {
        let width = size.width as usize;
        return Err(PictureError::BadPixel {
            file: path.to_owned(),
            what: format!("{:?}", pixels[pixel]),
            x: pixel % width,
            y: pixel / width,
        });
    }
    Ok(LinearPicture { size, pixels })
}

/// Figures of one channel, over the pixels that count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChannelFigures {
    /// Root of the mean squared error, radiance.
    pub rmse: f64,
    /// The same of the truth's standard errors.
    pub noise: f64,
    /// The error without the noise, over the mean of the truth; NaN where that is 0.
    pub relative: f64,
    /// Peak signal to noise in dB, white (1) being the peak; infinite for equal pictures.
    pub psnr: f64,
    /// Mean of the picture over the mean of the truth; NaN where that is 0.
    pub mean_ratio: f64,
}

/// How far a picture is from a truth.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Red, green, blue.
    pub channels: [ChannelFigures; 3],
    /// Mean of FLIP (Andersson et al. 2020) over the pixels that count, at 67 pixels per degree, of both pictures
    /// clamped to [0, 1] and encoded as sRGB, with all other pixels black.
    pub flip: f64,
    /// How many pixels count.
    pub pixels: usize,
}

/// Compares two pictures of one size; `exposure` is a factor on both before they are shown to FLIP.
///
/// `None` where no pixel counts.
pub fn compare(picture: &LinearPicture, truth: &Truth, exposure: f32) -> Option<Comparison> {
    let counted: Vec<usize> = (0..truth.counts.len()).filter(|&pixel| truth.counts[pixel]).collect();
    if counted.is_empty() {
        return None;
    }
    let count = counted.len() as f64;
    let channels = [0, 1, 2].map(|channel: usize| {
        let mean =
            |value: &dyn Fn(usize) -> f64| counted.iter().map(|&pixel| value(pixel)).sum::<f64>() / count;
        let found = |pixel: usize| f64::from(picture.pixels[pixel][channel]);
        let right = |pixel: usize| f64::from(truth.picture.pixels[pixel][channel]);
        let square = mean(&|pixel| (found(pixel) - right(pixel)).powi(2));
        let noise = truth
            .standard_error
            .as_ref()
            .map_or(0.0, |error| mean(&|pixel| f64::from(error[pixel][channel]).powi(2)));
        let level = mean(&right);
        ChannelFigures {
            rmse: square.sqrt(),
            noise: noise.sqrt(),
            relative: (square - noise).max(0.0).sqrt() / level,
            psnr: -10.0 * square.log10(),
            mean_ratio: mean(&found) / level,
        }
    });
    let shown = |picture: &LinearPicture| {
        let mut shown = picture.clone();
        for (pixel, counts) in shown.pixels.iter_mut().zip(&truth.counts) {
            *pixel = if *counts { pixel.map(|value| value * exposure) } else { [0.0; 3] };
        }
        let DisplayPicture { size: Size { width, height }, pixels } = shown.to_display();
        FlipImageRgb8::with_data(width, height, pixels.as_flattened())
    };
    let flip = nv_flip::flip(shown(&truth.picture), shown(picture), DEFAULT_PIXELS_PER_DEGREE).to_vec();
    let flip = counted.iter().map(|&pixel| f64::from(flip[pixel])).sum::<f64>() / count;
    Some(Comparison { channels, flip, pixels: counted.len() })
}

/// The error as a picture: white where both are equal, red where `picture` is too bright and blue where it is too dark,
/// in full colour from a quarter of the truth's mean on; pixels that do not count are black.
pub fn map(picture: &LinearPicture, truth: &Truth) -> DisplayPicture {
    let light = |pixel: &[f32; 3]| pixel.iter().sum::<f32>() / 3.0;
    let counted = || truth.picture.pixels.iter().zip(&truth.counts).filter(|(_, counts)| **counts);
    let mean = counted().map(|(pixel, _)| light(pixel)).sum::<f32>() / counted().count().max(1) as f32;
    let colour = |index: usize| {
        if !truth.counts[index] {
            return [0; 3];
        }
        let error = light(&picture.pixels[index]) - light(&truth.picture.pixels[index]);
        let part = (error / (FULL_COLOUR * mean.max(f32::MIN_POSITIVE))).clamp(-1.0, 1.0);
        // In steps: what is finer is the truth's noise, and makes files large.
        let rest = (255.0 * (1.0 - (MAP_STEPS * part.abs()).round() / MAP_STEPS) + 0.5) as u8;
        if part > 0.0 { [255, rest, rest] } else { [rest, rest, 255] }
    };
    DisplayPicture { size: picture.size, pixels: (0..picture.pixels.len()).map(colour).collect() }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;

    const SIZE: Size = Size { width: 16, height: 16 };

    fn truth(standard_error: f32) -> Truth {
        let pixels = (0..256).map(|pixel| [0.2 + pixel as f32 / 1024.0, 0.3, 0.4]).collect();
        Truth {
            picture: LinearPicture { size: SIZE, pixels },
            standard_error: Some(vec![[standard_error; 3]; 256]),
            counts: (0..256).map(|pixel| pixel >= 128).collect(),
        }
    }

    #[test]
    fn equal_pictures_have_no_error() {
        let truth = truth(0.0);
        let same = compare(&truth.picture, &truth, 1.0).unwrap();
        assert_eq!((same.flip, same.pixels), (0.0, 128));
        for channel in same.channels {
            assert_eq!((channel.rmse, channel.relative, channel.psnr), (0.0, 0.0, f64::INFINITY));
            // Rounding of sums.
            assert!((channel.mean_ratio - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn an_error_of_the_noise_s_size_is_none() {
        let truth = truth(0.03);
        let mut picture = truth.picture.clone();
        for (index, pixel) in picture.pixels.iter_mut().enumerate() {
            pixel[1] += if index % 2 == 0 { 0.03 } else { -0.03 };
            pixel[2] += 0.05;
        }
        let [red, green, blue] = compare(&picture, &truth, 1.0).unwrap().channels;
        // f32 has seven digits.
        assert!((green.rmse - 0.03).abs() < 1e-6 && green.relative < 1e-3 && red.rmse == 0.0);
        assert!((blue.relative - 0.04 / 0.4).abs() < 1e-6, "√(0.05² - 0.03²) over 0.4: {}", blue.relative);
        assert!((blue.mean_ratio - 1.125).abs() < 1e-6);
    }

    #[test]
    fn what_does_not_count_changes_nothing() {
        let truth = truth(0.0);
        let mut picture = truth.picture.clone();
        picture.pixels[..128].fill([9.0; 3]);
        let found = compare(&picture, &truth, 1.0).unwrap();
        assert_eq!((found.flip, found.channels[0].rmse), (0.0, 0.0));
        assert_eq!(map(&picture, &truth).pixels[0], [0; 3]);
        let nothing = Truth { counts: vec![false; 256], ..truth };
        assert_eq!(compare(&picture, &nothing, 1.0), None);
    }

    #[test]
    fn the_map_is_red_where_there_is_too_much_light() {
        let truth = truth(0.0);
        let mut picture = truth.picture.clone();
        picture.pixels[200] = [9.0; 3];
        picture.pixels[201] = [0.0; 3];
        let map = map(&picture, &truth);
        assert_eq!(map.pixels[199..202], [[255; 3], [255, 0, 0], [0, 0, 255]]);
    }
}
