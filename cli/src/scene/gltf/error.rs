//! Why a glTF file cannot be drawn.

use crate::failure::Explain;
use std::path::PathBuf;
use thiserror::Error;

/// A primitive in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The file.
    pub file: PathBuf,
    /// The mesh's name, or `#` and its index.
    pub mesh: String,
    /// Index of the primitive in its mesh, from 0.
    pub primitive: usize,
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: mesh `{}`, primitive {}", self.file.display(), self.mesh, self.primitive)
    }
}

/// Why a glTF file cannot be drawn: the file, the place in it, and by [`Explain::help`] a remedy.
#[derive(Debug, Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "the message of each variant says what its fields are")]
pub enum GltfError {
    #[error("cannot read {}: {reason}", file.display())]
    Unreadable { file: PathBuf, reason: std::io::Error },
    #[error("{} is not a valid glTF file: {reason}", file.display())]
    Malformed { file: PathBuf, reason: String },
    #[error("{} has nothing to draw: {what}", file.display())]
    Empty { file: PathBuf, what: &'static str },
    #[error("{}: node {node} has two parents or is its own ancestor", file.display())]
    NotATree { file: PathBuf, node: usize },
    #[error("{}: buffer {buffer} has {found} bytes of {expected}", file.display())]
    BufferTooShort { file: PathBuf, buffer: usize, expected: usize, found: usize },
    #[error("{}: buffer {buffer}: {reason}", file.display())]
    BufferUnreadable { file: PathBuf, buffer: usize, reason: String },
    #[error("{}: image {image}: {reason}", file.display())]
    ImageUnreadable { file: PathBuf, image: String, reason: String },
    #[error("{place}: {what} reaches beyond its buffer")]
    AccessorOutOfRange { place: Place, what: &'static str },
    #[error("{place}: {what} has type {found}, expected {expected}")]
    AccessorType { place: Place, what: &'static str, expected: &'static str, found: String },
    #[error("{place}: {what} is stored sparsely")]
    AccessorSparse { place: Place, what: &'static str },
    #[error("{place}: {what} has {found} entries for {expected} vertices")]
    AccessorCount { place: Place, what: &'static str, expected: usize, found: usize },
    #[error("{place} has no POSITION attribute")]
    NoPositions { place: Place },
    #[error("{place}: the position of vertex {vertex} is ({}, {}, {})", position[0], position[1], position[2])]
    PositionNotFinite { place: Place, vertex: usize, position: [f32; 3] },
    #[error("{place}: index {position} names vertex {vertex}, but there are only {vertex_count}")]
    IndexOutOfRange { place: Place, position: usize, vertex: u32, vertex_count: usize },
    #[error("{place} is made of {mode}, not of triangles")]
    NotTriangles { place: Place, mode: &'static str },
    #[error("{place} has {index_count} indices, not a multiple of 3")]
    IncompleteTriangle { place: Place, index_count: usize },
    #[error("{place}: a texture uses texture coordinate set {set}")]
    TextureCoordinateSet { place: Place, set: u32 },
    #[error("{place} takes the scene beyond {largest} triangles")]
    TooLarge { place: Place, largest: usize },
}

impl Explain for GltfError {
    fn help(&self) -> Option<String> {
        const EXPORT_AGAIN: &str = "the file is damaged or was cut short: export or copy it again";
        let help = match self {
            Self::Unreadable { .. } => "check the path; glTF files end in .glb or .gltf",
            Self::Malformed { .. } => {
                "expected glTF 2.0, text (.gltf) or binary (.glb); if it was, export or copy it again"
            }
            Self::Empty { .. } => "export a scene with at least one mesh of triangles",
            Self::NotATree { .. } | Self::BufferTooShort { .. } | Self::AccessorOutOfRange { .. } => {
                EXPORT_AGAIN
            }
            Self::BufferUnreadable { .. } => "put the file beside the .gltf, or export as one .glb",
            Self::ImageUnreadable { .. } => {
                "put the image (PNG or JPEG) beside the .gltf, or export as one .glb"
            }
            Self::AccessorType { .. } | Self::AccessorCount { .. } => {
                "the exporter broke the glTF standard: try another"
            }
            Self::AccessorSparse { .. } => "export without sparse accessors",
            Self::NoPositions { .. } => "remove the primitive or give it vertices",
            Self::PositionNotFinite { .. } => {
                "every coordinate must be a finite number: repair or delete the vertex"
            }
            Self::IndexOutOfRange { .. } | Self::IncompleteTriangle { .. } => {
                "repair the mesh's indices: export it again"
            }
            Self::NotTriangles { .. } => "triangulate the mesh, or delete its points and lines",
            Self::TextureCoordinateSet { .. } => "bake the material to texture coordinate set 0",
            Self::TooLarge { .. } => "decimate the mesh",
        };
        Some(help.to_owned())
    }
}
