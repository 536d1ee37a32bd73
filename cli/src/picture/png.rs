//! PNG files: 8-bit sRGB.

use super::file::write_atomically;
use super::{DisplayPicture, PictureError};
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder as _};
use std::path::Path;

/// Writes an 8-bit sRGB picture.
pub fn write_png(path: &Path, picture: &DisplayPicture) -> Result<(), PictureError> {
    let mut bytes = Vec::new();
    PngEncoder::new(&mut bytes)
        .write_image(
            picture.pixels.as_flattened(),
            picture.size.width,
            picture.size.height,
            ExtendedColorType::Rgb8,
        )
        .map_err(|reason| PictureError::Unencodable { file: path.to_owned(), reason: reason.to_string() })?;
    write_atomically(path, &bytes)
}
