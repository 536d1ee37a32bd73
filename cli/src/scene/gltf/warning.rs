//! What is legal in a glTF file but suspect.

use super::Place;
use crate::failure::Explain;

/// Legal but suspect: the file is drawn, after a repair where one is named.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[allow(missing_docs, reason = "the message of each variant says what its fields are")]
pub enum GltfWarning {
    NoNormals { place: Place },
    NormalsNotFinite { place: Place, count: usize },
    NoIndices { place: Place, vertex_count: usize },
    DegenerateTriangles { place: Place, count: usize, of: usize },
    NoTextureCoordinates { place: Place },
    WoundAgainstNormals { place: Place },
    LittleTransmission { place: Place },
    PartlyClear { place: Place },
    TintedVolume { place: Place },
    ClearOutOfRange { place: Place, what: &'static str },
}

impl std::fmt::Display for GltfWarning {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::NoNormals { place } => write!(f, "{place} has no normals"),
            Self::NormalsNotFinite { place, count } => {
                write!(f, "{place} has {count} normals that are zero or not finite")
            }
            Self::NoIndices { place, vertex_count } => {
                write!(f, "{place} has no indices: its {vertex_count} vertices are taken in order")
            }
            Self::DegenerateTriangles { place, count, of } => {
                write!(f, "{place}: {count} of {of} triangles have no area and are left out")
            }
            Self::NoTextureCoordinates { place } => {
                write!(f, "{place} has a texture but no texture coordinates")
            }
            Self::WoundAgainstNormals { place } => {
                write!(f, "{place} is wound against its normals: its triangles are turned around")
            }
            Self::LittleTransmission { place } => {
                write!(
                    f,
                    "{place} transmits half of the light or less: it is drawn as if it transmitted none"
                )
            }
            Self::PartlyClear { place } => {
                write!(f, "{place} transmits a part of the light, or by a texture: it is drawn clear")
            }
            Self::ClearOutOfRange { place, what } => {
                write!(f, "{place} is clear and its `{what}` is out of range: the nearest within is taken")
            }
            Self::TintedVolume { place } => {
                write!(
                    f,
                    "{place} is clear and has a base colour that its absorption does not say: it is left out"
                )
            }
        }
    }
}

impl Explain for GltfWarning {
    fn help(&self) -> Option<String> {
        let help = match self {
            Self::NoNormals { .. } => {
                "each triangle is drawn flat, as the glTF standard says; export with normals to have it smooth"
            }
            Self::NormalsNotFinite { .. } => {
                "those vertices take the normal of their triangle; recompute the normals to be rid of this"
            }
            Self::NoIndices { .. } => "export with indices: shared vertices are stored and transformed once",
            Self::DegenerateTriangles { .. } => "merge doubled vertices to be rid of this",
            Self::NoTextureCoordinates { .. } => {
                "the whole surface takes the colour of the texture's upper left pixel; unwrap the mesh"
            }
            Self::WoundAgainstNormals { .. } => {
                "front faces wind anticlockwise; flip the faces or recalculate the normals before the export"
            }
            Self::LittleTransmission { .. } => "set its `transmissionFactor` to 0 or 1",
            Self::PartlyClear { .. } => {
                "set its `transmissionFactor` to 1 without a texture, or give the object a `Clear(…)` by name"
            }
            Self::ClearOutOfRange { .. } => {
                "an `ior` is from 1 to 2, a roughness or a colour from 0 to 1, a distance above 0"
            }
            Self::TintedVolume { .. } => {
                "give the colour as `attenuationColor` at an `attenuationDistance`, and a white base colour"
            }
        };
        Some(help.to_owned())
    }
}
