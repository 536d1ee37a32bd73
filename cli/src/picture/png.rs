//! PNG files: 8-bit sRGB.

use super::file::write_atomically;
use super::{DisplayPicture, PictureError};
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder as _};
use std::path::Path;

/// Writes an 8-bit sRGB picture.
pub fn write_png(path: &Path, picture: &DisplayPicture) -> Result<(), PictureError> {
    write(path, picture, CompressionType::default())
}

/// The same as small as may be: for pictures that stand in documents. Takes some times as long.
#[cfg(feature = "analysis")]
pub fn write_small_png(path: &Path, picture: &DisplayPicture) -> Result<(), PictureError> {
    write(path, picture, CompressionType::Best)
}

fn write(path: &Path, picture: &DisplayPicture, compression: CompressionType) -> Result<(), PictureError> {
    let mut bytes = Vec::new();
    PngEncoder::new_with_quality(&mut bytes, compression, FilterType::Adaptive)
        .write_image(
            picture.pixels.as_flattened(),
            picture.size.width,
            picture.size.height,
            ExtendedColorType::Rgb8,
        )
        .map_err(|reason| PictureError::Unencodable { file: path.to_owned(), reason: reason.to_string() })?;
    write_atomically(path, &bytes)
}
