//! Why a picture file cannot be read or written.

use crate::failure::Explain;
use std::path::PathBuf;
use thiserror::Error;

/// Why a picture file cannot be read or written.
#[derive(Debug, Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "the message of each variant says what its fields are")]
pub enum PictureError {
    #[error("cannot write {}: the folder {} does not exist", file.display(), folder.display())]
    NoFolder { file: PathBuf, folder: PathBuf },
    #[error("cannot write {}: {reason}", file.display())]
    Unwritable { file: PathBuf, reason: std::io::Error },
    #[error("cannot write {}: {reason}", file.display())]
    Unencodable { file: PathBuf, reason: String },
    #[error("cannot read {}: {reason}", file.display())]
    Unreadable { file: PathBuf, reason: String },
    #[error("{} has no channel `{channel}`", file.display())]
    MissingChannel { file: PathBuf, channel: String, present: Vec<String> },
    #[error("{}: channel `{channel}` is {}x{} pixels, expected {}x{}", file.display(), found.0, found.1, expected.0, expected.1)]
    ChannelSize { file: PathBuf, channel: String, found: (usize, usize), expected: (usize, usize) },
    #[error("{}: pixel ({x}, {y}) is {what}", file.display())]
    BadPixel { file: PathBuf, what: String, x: usize, y: usize },
    #[error("cannot take {} for an environment: {reason}", file.display())]
    NoEnvironment { file: PathBuf, reason: String },
    #[error("{}: channel `{channel}` has {what} at pixel ({x}, {y})", file.display())]
    BadValue { file: PathBuf, channel: String, what: String, x: usize, y: usize },
}

impl Explain for PictureError {
    fn help(&self) -> Option<String> {
        Some(match self {
            Self::NoFolder { folder, .. } => format!("create it first: mkdir -p {}", folder.display()),
            Self::Unwritable { .. } => "check that the folder may be written to and has space left".into(),
            Self::Unencodable { .. } => "ask for a smaller picture".into(),
            Self::Unreadable { .. } => {
                "check the path; expected an OpenEXR file with flat (not deep) pixels".into()
            }
            Self::MissingChannel { present, .. } if present.is_empty() => {
                "the file has no channels at all".into()
            }
            Self::MissingChannel { present, .. } => format!("the file has: {}", present.join(", ")),
            Self::ChannelSize { .. } => "all channels must cover the same pixels, without subsampling".into(),
            Self::BadPixel { .. } => "repair the renderer that wrote it: a picture's light is finite".into(),
            Self::NoEnvironment { .. } => {
                "give an equirectangular .exr or .hdr of radiance, which is finite and 0 or more".into()
            }
            Self::BadValue { .. } => {
                "repair the renderer that wrote it, or mark the pixel as background with Z = 0".into()
            }
        })
    }
}
