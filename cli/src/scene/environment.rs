//! Light from all around, from an image.

use crate::failure::Explain;
use crate::picture::exr::Channels;
use crate::picture::{LinearPicture, PictureError};
use crate::scene::camera::Size;
use std::fmt;
use std::path::{Path, PathBuf};

/// Largest radiance that is kept: that of half floats, which environments are often written in.
const BRIGHTEST: f32 = 65504.0;

/// Light from all around.
#[derive(Clone, Debug, PartialEq)]
pub struct Environment {
    /// Where it was read from.
    pub file: PathBuf,
    /// Equirectangular image of radiance: its middle towards −z, its right half towards +x.
    pub radiance: LinearPicture,
    /// Factor on it.
    pub intensity: f32,
    /// Turn about the y axis, in radians.
    pub turn_radians: f32,
}

/// That pixels were too bright.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Clamped {
    file: PathBuf,
    pixels: usize,
}

impl fmt::Display for Clamped {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { file, pixels } = self;
        write!(f, "{}: pixels brighter than {BRIGHTEST} count as that; there are {pixels}", file.display())
    }
}

impl Explain for Clamped {
    fn help(&self) -> Option<String> {
        Some("take the sun out of the image, and give it as a --light".into())
    }
}

impl Environment {
    /// Reads an EXR or HDR file.
    ///
    /// # Errors
    /// A file that cannot be read, whose width is not twice its height, or that has a pixel which is negative or no number.
    pub fn read(path: &Path) -> Result<(Self, Option<Clamped>), PictureError> {
        let mut radiance = read(path)?;
        let Size { width, height } = radiance.size;
        if width != 2 * height {
            let reason =
                format!("{width}x{height} pixels; an equirectangular image is twice as wide as it is high");
            return Err(PictureError::NoEnvironment { file: path.to_owned(), reason });
        }
        let is_light = |pixel: &[f32; 3]| pixel.iter().all(|value| *value >= 0.0);
        if let Some(pixel) = radiance.pixels.iter().position(|pixel| !is_light(pixel)) {
            let (x, y) = (pixel % width as usize, pixel / width as usize);
            let reason = format!("pixel ({x}, {y}) is {:?}, which is no light", radiance.pixels[pixel]);
            return Err(PictureError::NoEnvironment { file: path.to_owned(), reason });
        }
        let mut pixels = 0;
        for pixel in &mut radiance.pixels {
            if pixel.iter().any(|value| *value > BRIGHTEST) {
                *pixel = pixel.map(|value| value.min(BRIGHTEST));
                pixels += 1;
            }
        }
        let clamped = (pixels > 0).then(|| Clamped { file: path.to_owned(), pixels });
        Ok((Self { file: path.to_owned(), radiance, intensity: 1.0, turn_radians: 0.0 }, clamped))
    }
}

fn read(path: &Path) -> Result<LinearPicture, PictureError> {
    let is_hdr = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("hdr"));
    if !is_hdr {
        let channels = Channels::read(path)?;
        let size = channels.size("R")?;
        let [r, g, b] = ["R", "G", "B"].map(|name| channels.samples(name, size));
        let pixels = r?.into_iter().zip(g?).zip(b?).map(|((r, g), b)| [r, g, b]).collect();
        return Ok(LinearPicture { size, pixels });
    }
    let unreadable = |reason: String| PictureError::NoEnvironment { file: path.to_owned(), reason };
    let reader = image::ImageReader::open(path).map_err(|reason| unreadable(reason.to_string()))?;
    let picture = reader.decode().map_err(|reason| unreadable(reason.to_string()))?.into_rgb32f();
    let size = Size { width: picture.width(), height: picture.height() };
    Ok(LinearPicture { size, pixels: picture.pixels().map(|pixel| pixel.0).collect() })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::picture::exr::write_exr;

    fn read_back(size: Size, odd: [f32; 3]) -> Result<(Environment, Option<Clamped>), PictureError> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("sky.exr");
        let mut pixels = vec![[0.5, 0.6, 0.7]; size.pixels()];
        pixels[1] = odd;
        write_exr(&path, &LinearPicture { size, pixels }).unwrap();
        Environment::read(&path)
    }

    #[test]
    fn what_is_no_light_is_refused_and_what_is_too_bright_is_said() {
        let size = Size { width: 8, height: 4 };
        let (sky, clamped) = read_back(size, [1.0, 2.0, 3.0]).unwrap();
        assert_eq!((sky.radiance.pixels[1], clamped), ([1.0, 2.0, 3.0], None));
        let (sun, clamped) = read_back(size, [f32::INFINITY, 2.0, 3.0]).unwrap();
        assert_eq!(sun.radiance.pixels[1], [BRIGHTEST, 2.0, 3.0]);
        assert!(clamped.unwrap().to_string().ends_with("there are 1"));
        for odd in [[f32::NAN, 0.0, 0.0], [-0.1, 0.0, 0.0], [f32::NEG_INFINITY, 0.0, 0.0]] {
            let error = read_back(size, odd).unwrap_err();
            assert!(error.to_string().contains("pixel (1, 0) is"), "{error}");
        }
        let error = read_back(Size { width: 4, height: 4 }, [0.0; 3]).unwrap_err();
        assert!(error.to_string().contains("twice as wide"), "{error}");
    }

    #[test]
    fn a_radiance_file_is_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("sky.hdr");
        let file = std::fs::File::create(&path).unwrap();
        let pixels = vec![image::Rgb([0.5_f32, 1.0, 4.0]); 8];
        image::codecs::hdr::HdrEncoder::new(file).encode(&pixels, 4, 2).unwrap();
        let (sky, _) = Environment::read(&path).unwrap();
        // RGBE has eight bits.
        let is_near = |pixel: &[f32; 3]| (pixel[0] - 0.5).abs() < 0.02 && (pixel[2] - 4.0).abs() < 0.02;
        assert!(sky.radiance.pixels.iter().all(is_near));
        assert!(Environment::read(&folder.path().join("none.hdr")).is_err());
    }
}
