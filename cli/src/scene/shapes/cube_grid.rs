//! Closed meshes from the faces of a cube.

use crate::scene::Mesh;
use glam::Vec3;
use std::f32::consts::FRAC_PI_4;

const METRES_PER_MILLIMETRE: f32 = 1e-3;

/// The mesh of the six faces of a box, `map` giving each of its points a place (mm) and a normal.
///
/// `coordinates` are the grid's along each axis, from the least to the greatest.
pub(super) fn cube_grid(coordinates: &[Vec<f32>; 3], map: impl Fn(Vec3) -> (Vec3, Vec3)) -> Mesh {
    let mut mesh = Mesh::default();
    for axis in 0..3 {
        let (across, up) = ((axis + 1) % 3, (axis + 2) % 3);
        let ends = [coordinates[axis].first(), coordinates[axis].last()];
        for (is_upper, end) in ends.into_iter().flatten().enumerate() {
            let first = mesh.positions.len() as u32;
            for &v in &coordinates[up] {
                for &u in &coordinates[across] {
                    let mut point = [0.0; 3];
                    (point[axis], point[across], point[up]) = (*end, u, v);
                    let (position, normal) = map(Vec3::from(point));
                    mesh.positions.push((position * METRES_PER_MILLIMETRE).to_array());
                    mesh.normals.push(normal.to_array());
                    mesh.texture_coordinates.push([0.0; 2]);
                }
            }
            let width = coordinates[across].len() as u32;
            for row in 0..coordinates[up].len() as u32 - 1 {
                for column in 0..width - 1 {
                    let corner = first + row * width + column;
                    let (right, above) = (corner + 1, corner + width);
                    let turned = if is_upper == 1 { [right, above] } else { [above, right] };
                    mesh.indices.extend([corner, turned[0], turned[1]]);
                    mesh.indices.extend([above + 1, turned[1], turned[0]]);
                }
            }
        }
    }
    mesh
}

/// Coordinates from −1 to 1 that a sphere's middle sees under equal angles.
pub(super) fn tangents(steps: usize) -> Vec<f32> {
    (0..=steps).map(|step| (FRAC_PI_4 * (2.0 * step as f32 / steps as f32 - 1.0)).tan()).collect()
}

/// Coordinates from −half to half: `arc` steps under equal angles in each rounding, `straight` between.
pub(super) fn rounded(half: f32, radius: f32, straight: usize, arc: usize) -> Vec<f32> {
    let core = half - radius;
    let bend = |step: usize| radius * (FRAC_PI_4 * step as f32 / arc as f32).tan();
    let lower = (1..=arc).rev().map(|step| -core - bend(step));
    let between = (0..=straight).map(|step| core * (2.0 * step as f32 / straight as f32 - 1.0));
    let upper = (1..=arc).map(|step| core + bend(step));
    lower.chain(between).chain(upper).collect()
}
