//! One primitive of a mesh as triangles in world space.

use super::source::Sources;
use super::{GltfError, GltfWarning, Place, accessor};
use crate::scene::Mesh;
use glam::{Mat3, Mat4, Vec3};
use gltf::Semantic;
use gltf::mesh::Mode;

/// Reads a primitive; `None` when all of its triangles are degenerate.
pub(super) fn read(
    primitive: &gltf::Primitive<'_>,
    world_from_node: Mat4,
    sources: &Sources,
    place: &Place,
    warnings: &mut Vec<GltfWarning>,
) -> Result<Option<Mesh>, GltfError> {
    let positions = positions(primitive, world_from_node, sources, place)?;
    let indices = triangles(primitive, world_from_node, positions.len(), sources, place, warnings)?;
    let (indices, count) = without_degenerate(indices, &positions);
    if count > 0 {
        let of = count + indices.len() / 3;
        warnings.push(GltfWarning::DegenerateTriangles { place: place.clone(), count, of });
    }
    if indices.is_empty() {
        return Ok(None);
    }
    let texture_coordinates = texture_coordinates(primitive, positions.len(), sources, place, warnings)?;
    let mut mesh = Mesh { positions, normals: Vec::new(), texture_coordinates, indices };
    match normals(primitive, world_from_node, mesh.positions.len(), sources, place)? {
        Some(normals) => {
            mesh.normals = normals;
            let count = repair_normals(&mut mesh);
            if count > 0 {
                warnings.push(GltfWarning::NormalsNotFinite { place: place.clone(), count });
            }
            if is_wound_against_normals(&mesh) {
                warnings.push(GltfWarning::WoundAgainstNormals { place: place.clone() });
                turn_over(&mut mesh.indices);
            }
        }
        None => {
            warnings.push(GltfWarning::NoNormals { place: place.clone() });
            mesh = flat(&mesh);
        }
    }
    Ok(Some(mesh))
}

fn positions(
    primitive: &gltf::Primitive<'_>,
    world_from_node: Mat4,
    sources: &Sources,
    place: &Place,
) -> Result<Vec<[f32; 3]>, GltfError> {
    let attribute =
        primitive.get(&Semantic::Positions).ok_or_else(|| GltfError::NoPositions { place: place.clone() })?;
    let mut positions = accessor::vectors::<3>(&attribute, "POSITION", sources, place)?;
    for (vertex, position) in positions.iter_mut().enumerate() {
        let in_world = world_from_node.transform_point3(Vec3::from(*position));
        if !in_world.is_finite() {
            return Err(GltfError::PositionNotFinite { place: place.clone(), vertex, position: *position });
        }
        *position = in_world.to_array();
    }
    Ok(positions)
}

/// The triangles' indices, checked, counter-clockwise seen from outside.
fn triangles(
    primitive: &gltf::Primitive<'_>,
    world_from_node: Mat4,
    vertex_count: usize,
    sources: &Sources,
    place: &Place,
    warnings: &mut Vec<GltfWarning>,
) -> Result<Vec<u32>, GltfError> {
    let listed = match primitive.indices() {
        Some(attribute) => accessor::indices(&attribute, sources, place)?,
        None => {
            warnings.push(GltfWarning::NoIndices { place: place.clone(), vertex_count });
            (0..vertex_count as u32).collect()
        }
    };
    if let Some(position) = listed.iter().position(|vertex| *vertex as usize >= vertex_count) {
        let vertex = listed[position];
        return Err(GltfError::IndexOutOfRange { place: place.clone(), position, vertex, vertex_count });
    }
    let not_triangles = |mode| Err(GltfError::NotTriangles { place: place.clone(), mode });
    let mut indices: Vec<u32> = match primitive.mode() {
        Mode::Triangles if listed.len() % 3 != 0 => {
            return Err(GltfError::IncompleteTriangle { place: place.clone(), index_count: listed.len() });
        }
        Mode::Triangles => listed,
        // glTF 2.0 §3.7.2.1: every second triangle of a strip runs the other way round.
        Mode::TriangleStrip => (listed.windows(3).enumerate())
            .flat_map(|(k, t)| if k % 2 == 0 { [t[0], t[1], t[2]] } else { [t[1], t[0], t[2]] })
            .collect(),
        Mode::TriangleFan => {
            listed.get(1..).unwrap_or(&[]).windows(2).flat_map(|t| [t[0], t[1], listed[0]]).collect()
        }
        Mode::Points => return not_triangles("points"),
        Mode::Lines | Mode::LineLoop | Mode::LineStrip => return not_triangles("lines"),
    };
    // A mirrored mesh would be inside out.
    if world_from_node.determinant() < 0.0 {
        turn_over(&mut indices);
    }
    Ok(indices)
}

/// Winds triangles the other way round.
fn turn_over(indices: &mut [u32]) {
    for triangle in indices.chunks_exact_mut(3) {
        triangle.swap(1, 2);
    }
}

/// Whether more of the area is wound against its normals than with them.
fn is_wound_against_normals(mesh: &Mesh) -> bool {
    let agreement = |triangle: &[u32]| {
        let [a, b, c] = corners(triangle, &mesh.positions);
        let twice_area = (b - a).as_dvec3().cross((c - a).as_dvec3());
        let [p, q, r] = [0, 1, 2].map(|k: usize| Vec3::from(mesh.normals[triangle[k] as usize]).as_dvec3());
        let along = twice_area.dot(p + q + r);
        twice_area.length() * along.signum() * f64::from(u8::from(along != 0.0))
    };
    mesh.indices.chunks_exact(3).map(agreement).sum::<f64>() < 0.0
}

/// Leaves out triangles without area; returns how many.
fn without_degenerate(indices: Vec<u32>, positions: &[[f32; 3]]) -> (Vec<u32>, usize) {
    let all = indices.len() / 3;
    let kept: Vec<u32> = indices
        .chunks_exact(3)
        .filter(|t| {
            let [a, b, c] = corners(t, positions);
            // In f64: the product of two small f32 edges may vanish in f32.
            (b - a).as_dvec3().cross((c - a).as_dvec3()).length_squared() > 0.0
        })
        .flatten()
        .copied()
        .collect();
    let dropped = all - kept.len() / 3;
    (kept, dropped)
}

fn corners(triangle: &[u32], positions: &[[f32; 3]]) -> [Vec3; 3] {
    [0, 1, 2].map(|k| Vec3::from(positions[triangle[k] as usize]))
}

/// Unit normal of a triangle that has an area.
fn face_normal(triangle: &[u32], positions: &[[f32; 3]]) -> [f32; 3] {
    let [a, b, c] = corners(triangle, positions);
    (b - a).as_dvec3().cross((c - a).as_dvec3()).normalize_or(glam::DVec3::Z).as_vec3().to_array()
}

fn normals(
    primitive: &gltf::Primitive<'_>,
    world_from_node: Mat4,
    vertex_count: usize,
    sources: &Sources,
    place: &Place,
) -> Result<Option<Vec<[f32; 3]>>, GltfError> {
    let Some(attribute) = primitive.get(&Semantic::Normals) else { return Ok(None) };
    let normals = accessor::vectors::<3>(&attribute, "NORMAL", sources, place)?;
    check_count(normals.len(), vertex_count, "NORMAL", place)?;
    // Cofactors: the inverse transpose times the determinant, which exists for a flattened node too. Its sign turns
    // the normal of a mirrored node inwards, so it is taken out again.
    let m = Mat3::from_mat4(world_from_node);
    let cofactors =
        Mat3::from_cols(m.y_axis.cross(m.z_axis), m.z_axis.cross(m.x_axis), m.x_axis.cross(m.y_axis));
    let sign = if m.determinant() < 0.0 { -1.0 } else { 1.0 };
    // A zero or non-finite normal becomes zero, for `repair_normals` to find.
    let turn = |normal: [f32; 3]| (sign * (cofactors * Vec3::from(normal))).normalize_or_zero().to_array();
    Ok(Some(normals.into_iter().map(turn).collect()))
}

/// Replaces normals of length zero by that of a triangle at the vertex; returns how many.
fn repair_normals(mesh: &mut Mesh) -> usize {
    let mut count = 0;
    for triangle in mesh.indices.chunks_exact(3) {
        for vertex in triangle {
            let normal = &mut mesh.normals[*vertex as usize];
            if *normal == [0.0; 3] {
                *normal = face_normal(triangle, &mesh.positions);
                count += 1;
            }
        }
    }
    count
}

/// Own vertices for every triangle, with its normal. glTF 2.0 §3.7.2.1: "flat normals".
fn flat(mesh: &Mesh) -> Mesh {
    let mut flat = Mesh::default();
    for triangle in mesh.indices.chunks_exact(3) {
        let normal = face_normal(triangle, &mesh.positions);
        for vertex in triangle {
            flat.indices.push(flat.positions.len() as u32);
            flat.positions.push(mesh.positions[*vertex as usize]);
            flat.texture_coordinates.push(mesh.texture_coordinates[*vertex as usize]);
            flat.normals.push(normal);
        }
    }
    flat
}

fn texture_coordinates(
    primitive: &gltf::Primitive<'_>,
    vertex_count: usize,
    sources: &Sources,
    place: &Place,
    warnings: &mut Vec<GltfWarning>,
) -> Result<Vec<[f32; 2]>, GltfError> {
    let Some(attribute) = primitive.get(&Semantic::TexCoords(0)) else {
        let material = primitive.material();
        let colour = material.pbr_metallic_roughness();
        if colour.base_color_texture().is_some() || material.normal_texture().is_some() {
            warnings.push(GltfWarning::NoTextureCoordinates { place: place.clone() });
        }
        return Ok(vec![[0.0; 2]; vertex_count]);
    };
    let coordinates = accessor::vectors::<2>(&attribute, "TEXCOORD_0", sources, place)?;
    check_count(coordinates.len(), vertex_count, "TEXCOORD_0", place)?;
    // A texture coordinate that is not a number would spread over its triangle.
    let finite = |[u, v]: [f32; 2]| if u.is_finite() && v.is_finite() { [u, v] } else { [0.0; 2] };
    Ok(coordinates.into_iter().map(finite).collect())
}

fn check_count(found: usize, expected: usize, what: &'static str, place: &Place) -> Result<(), GltfError> {
    if found == expected {
        return Ok(());
    }
    Err(GltfError::AccessorCount { place: place.clone(), what, expected, found })
}
