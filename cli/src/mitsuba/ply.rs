//! Meshes as PLY.

use crate::scene::MILLIMETRES_PER_METRE;
use crate::scene::Mesh;

/// The mesh as binary PLY: positions in mm, normals, triangles.
pub fn ply(mesh: &Mesh) -> Vec<u8> {
    let triangles = mesh.indices.len() / 3;
    let header = format!(
        "ply\nformat binary_little_endian 1.0\ncomment millimetres\nelement vertex {}\n{}element face {triangles}\n\
         property list uchar int vertex_indices\nend_header\n",
        mesh.positions.len(),
        ["x", "y", "z", "nx", "ny", "nz"].map(|name| format!("property float {name}\n")).concat(),
    );
    let mut bytes = header.into_bytes();
    for (position, normal) in mesh.positions.iter().zip(&mesh.normals) {
        let position = position.map(|metres| metres * MILLIMETRES_PER_METRE);
        bytes.extend(position.iter().chain(normal).flat_map(|value| value.to_le_bytes()));
    }
    for triangle in mesh.indices.chunks_exact(3) {
        bytes.push(3);
        bytes.extend(triangle.iter().flat_map(|index| index.to_le_bytes()));
    }
    bytes
}
