//! Meshes on the device.

use glam::DVec3;

use crate::Vertex;
use crate::wgpu::{self, util::DeviceExt as _};

/// Vertices and indices of one mesh.
#[derive(Clone, Debug)]
pub struct Geometry {
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
    index_count: u32,
    mean_curvature: f32,
}

impl Geometry {
    /// Uploads a list of triangles; front faces wind anticlockwise. An [`Object`](crate::Object) places it in the world.
    ///
    /// No triangle is no error: such a mesh draws nothing.
    pub fn new(device: &wgpu::Device, vertices: &[Vertex], indices: &[u32]) -> Self {
        let buffer = |label, contents: &[u8], usage| {
            // A buffer of 0 bytes cannot be bound.
            let padded;
            let contents = if contents.is_empty() {
                padded = [0; 4];
                &padded[..]
            } else {
                contents
            };
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some(label),
                contents,
                usage,
            })
        };
        Self {
            vertices: buffer("Geometry vertices", bytemuck::cast_slice(vertices), wgpu::BufferUsages::VERTEX),
            indices: buffer("Geometry indices", bytemuck::cast_slice(indices), wgpu::BufferUsages::INDEX),
            index_count: u32::try_from(indices.len()).unwrap_or(u32::MAX),
            mean_curvature: mean_curvature(vertices, indices),
        }
    }

    /// Mean curvature of the surface in the mean over its area, per unit of the mesh: 1/r of a ball of radius r, 0 of what is
    /// flat, below 0 of what is hollow.
    pub(crate) fn mean_curvature(&self) -> f32 {
        self.mean_curvature
    }

    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..self.index_count, 0, 0..1);
    }
}

/// ∫ H dA/∫ dA, 2H = ∇·n: over a triangle whose normals are straight between its corners the divergence times the area is
/// ½ Σ (N × e_k)·n_k, e_k the edge across from corner k and N the triangle's own normal.
fn mean_curvature(vertices: &[Vertex], indices: &[u32]) -> f32 {
    let (mut bending, mut area) = (0.0_f64, 0.0_f64);
    for triangle in indices.as_chunks().0 {
        let [a, b, c]: [u32; 3] = *triangle;
        let (Some(a), Some(b), Some(c)) =
            (vertices.get(a as usize), vertices.get(b as usize), vertices.get(c as usize))
        else {
            continue;
        };
        let corners = [a, b, c];
        let [p, q, r] = corners.map(|corner| DVec3::from(corner.position.map(f64::from)));
        let across = (q - p).cross(r - p);
        let twice_area = across.length();
        let Some(normal) = across.try_normalize() else { continue };
        let edges = [r - q, p - r, q - p];
        let divergence: f64 = corners
            .iter()
            .zip(edges)
            .map(|(corner, edge)| {
                let own = DVec3::from(corner.normal.map(f64::from)).normalize_or_zero();
                normal.cross(edge).dot(own)
            })
            .sum();
        if divergence.is_finite() {
            bending += 0.25 * divergence;
            area += 0.5 * twice_area;
        }
    }
    if area > 0.0 { (bending / area) as f32 } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ball of an icosahedron's corners moved out, with facets as fine as `rings` says.
    fn ball(radius: f32, rings: u32) -> (Vec<Vertex>, Vec<u32>) {
        let point = |ring: u32, sector: u32| {
            let theta = ring as f32 / rings as f32 * std::f32::consts::PI;
            let phi = sector as f32 / rings as f32 * std::f32::consts::TAU;
            let normal = [theta.sin() * phi.sin(), theta.cos(), theta.sin() * phi.cos()];
            Vertex { position: normal.map(|x| radius * x), normal, texture_coordinate: [0.0; 2] }
        };
        let vertices =
            (0..=rings).flat_map(|ring| (0..=rings).map(move |sector| point(ring, sector))).collect();
        let quads = (0..rings).flat_map(|ring| (0..rings).map(move |sector| ring * (rings + 1) + sector));
        let corners = |a: u32| [a, a + rings + 1, a + 1, a + 1, a + rings + 1, a + rings + 2];
        (vertices, quads.flat_map(corners).collect())
    }

    #[test]
    fn a_ball_s_curvature_is_its_radius_over_one() {
        for radius in [1e-3, 0.04, 10.0_f32] {
            let (mut vertices, indices) = ball(radius, 32);
            // Normals over radius are positions: their divergence is exact on every facet, but for rounding.
            let found = mean_curvature(&vertices, &indices);
            assert!((found * radius - 1.0).abs() < 1e-3, "{found} of {radius}");
            // Hollow.
            for vertex in &mut vertices {
                vertex.normal = vertex.normal.map(|x| -x);
            }
            let turned: Vec<u32> =
                indices.as_chunks::<3>().0.iter().flat_map(|[a, b, c]| [*a, *c, *b]).collect();
            let hollow = mean_curvature(&vertices, &turned);
            assert!((hollow * radius + 1.0).abs() < 1e-3, "{hollow} of {radius}");
        }
    }

    #[test]
    fn what_is_flat_empty_or_no_number_has_none() {
        let corner = |x: f32, y: f32| Vertex {
            position: [x, y, 0.0],
            normal: [0.0, 0.0, 1.0],
            texture_coordinate: [0.0; 2],
        };
        let mut square = [corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)];
        let indices = [0, 1, 2, 0, 2, 3];
        assert!(mean_curvature(&square, &indices).abs() < 1e-6);
        assert_eq!(mean_curvature(&[], &[]), 0.0);
        assert_eq!(mean_curvature(&square, &[0, 0, 0, 1, 2, 9]), 0.0);
        square[0].position = [f32::NAN; 3];
        square[2].normal = [0.0; 3];
        assert!(mean_curvature(&square, &indices).is_finite());
    }
}
