//! Figures of curves: axes with units, a legend, SVG and PNG.
//!
//! The central type is [`Figure`]: panels side by side that share a legend. [`Figure::to_svg`] gives the same bytes on
//! every machine; the PNG is a rasterisation of exactly that SVG.

mod axis;
mod canvas;
mod draw;
mod figure;
pub mod ink;
mod legend;
mod lettering;
mod png;
mod sheet;
mod strokes;
mod thin;

pub use axis::{Axis, Scale};
pub use figure::{Figure, Mark, Panel, Series};
pub use ink::{Colour, Dash};

use crate::picture::{PictureError, file, write_png};
use std::path::{Path, PathBuf};

impl Figure {
    /// The figure as SVG text.
    pub fn to_svg(&self) -> String {
        draw::draw(self)
    }
}

/// Where a figure goes: the ending of the name says how.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FigureFile {
    /// Vector graphics.
    Svg(PathBuf),
    /// Pixels, two per unit of the SVG.
    Png(PathBuf),
}

impl FigureFile {
    /// From a file name that ends in .svg or .png.
    pub fn parse(text: &str) -> Result<Self, String> {
        let path = PathBuf::from(text);
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
        match ending.as_deref() {
            Some("svg") => Ok(Self::Svg(path)),
            Some("png") => Ok(Self::Png(path)),
            _ => Err("the name must end in .svg or .png".into()),
        }
    }

    /// The same with `-suffix` before the ending.
    #[must_use]
    pub fn with_suffix(&self, suffix: &str) -> Self {
        let with = |path: &Path| {
            let stem = path.file_stem().unwrap_or_default().to_string_lossy();
            let ending = path.extension().unwrap_or_default().to_string_lossy();
            path.with_file_name(format!("{stem}-{suffix}.{ending}"))
        };
        match self {
            Self::Svg(path) => Self::Svg(with(path)),
            Self::Png(path) => Self::Png(with(path)),
        }
    }

    /// The file.
    pub fn path(&self) -> &Path {
        match self {
            Self::Svg(path) | Self::Png(path) => path,
        }
    }

    /// Writes the figure, whole or not at all.
    pub fn write(&self, figure: &Figure) -> Result<(), PictureError> {
        let svg = figure.to_svg();
        match self {
            Self::Svg(path) => file::write_atomically(path, svg.as_bytes()),
            Self::Png(path) => {
                let unencodable = |reason| PictureError::Unencodable { file: path.clone(), reason };
                write_png(path, &png::rasterise(&svg).map_err(unencodable)?)
            }
        }
    }
}
