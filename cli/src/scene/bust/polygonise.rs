//! From the distance field to triangles.

use super::{STEEPEST, body, distance};
use crate::scene::Mesh;
use fast_surface_nets::ndshape::RuntimeShape;
use fast_surface_nets::{SurfaceNetsBuffer, surface_nets};
use glam::Vec3;
use rayon::prelude::*;

/// The box that holds the bust with some air around it (mm).
const LOWEST: Vec3 = Vec3::new(-128.0, body::BASE - 5.0, -148.0);
const HIGHEST: Vec3 = Vec3::new(128.0, 130.0, 118.0);

/// Cells along the edge of a block that one distance may rule out.
const BLOCK: usize = 8;

/// A grid over the box.
struct Grid {
    cell_mm: f32,
    points: [usize; 3],
}

/// The bust's mesh on a grid of `cell_mm`; the same bytes every time, on any number of threads.
///
/// Thin parts need `cell_mm` below their thickness: the ears are 2.4 mm thick.
pub(super) fn polygonise(cell_mm: f32) -> Mesh {
    let grid = Grid::new(cell_mm);
    let values = grid.sample();
    let shape = RuntimeShape::<u32, 3>::new(grid.points.map(|count| count as u32));
    let mut nets = SurfaceNetsBuffer::default();
    surface_nets(&values, &shape, [0; 3], grid.points.map(|count| count as u32 - 1), &mut nets);

    let vertices: Vec<(Vec3, Vec3)> = nets
        .positions
        .par_iter()
        .map(|position| {
            let p = settle(LOWEST + Vec3::from(*position) * cell_mm, cell_mm);
            (p, gradient(p).1.normalize_or(Vec3::Y))
        })
        .collect();
    const METRES_PER_MILLIMETRE: f32 = 1e-3;
    Mesh {
        positions: vertices.iter().map(|(p, _)| (*p * METRES_PER_MILLIMETRE).to_array()).collect(),
        normals: vertices.iter().map(|(_, n)| n.to_array()).collect(),
        texture_coordinates: vec![[0.0; 2]; vertices.len()],
        indices: nets.indices,
    }
}

impl Grid {
    fn new(cell_mm: f32) -> Self {
        let extent = (HIGHEST - LOWEST) / cell_mm;
        Self { cell_mm, points: extent.to_array().map(|cells| cells.ceil() as usize + 1) }
    }

    fn point(&self, x: usize, y: usize, z: usize) -> Vec3 {
        LOWEST + Vec3::new(x as f32, y as f32, z as f32) * self.cell_mm
    }

    /// The distance at every grid point, x fastest; only its sign is right far from the surface.
    fn sample(&self) -> Vec<f32> {
        let [nx, ny, nz] = self.points;
        let layer = nx * ny;
        let mut values = vec![0.0; layer * nz];
        values.par_chunks_mut(layer * BLOCK).enumerate().for_each(|(slab, values)| {
            let z0 = slab * BLOCK;
            for y0 in (0..ny).step_by(BLOCK) {
                for x0 in (0..nx).step_by(BLOCK) {
                    let end = [(x0 + BLOCK).min(nx), (y0 + BLOCK).min(ny), (z0 + BLOCK).min(nz)];
                    self.sample_block(values, z0, [x0, y0, z0], end);
                }
            }
        });
        values
    }

    /// Fills one block, `from` (inclusive) to `to`: with one distance where the surface cannot reach it.
    fn sample_block(&self, values: &mut [f32], z0: usize, from: [usize; 3], to: [usize; 3]) {
        let [nx, ny, _] = self.points;
        let low = self.point(from[0], from[1], from[2]);
        let high = self.point(to[0] - 1, to[1] - 1, to[2] - 1);
        let middle = distance((low + high) * 0.5);
        let edge = to[0] - from[0];
        if middle.abs() > STEEPEST * 0.5 * (high - low).length() {
            for z in from[2]..to[2] {
                for y in from[1]..to[1] {
                    let row = ((z - z0) * ny + y) * nx;
                    values[row + from[0]..row + to[0]].fill(middle);
                }
            }
        } else if edge > 2 {
            // Halve the block along each axis.
            let half: [usize; 3] =
                std::array::from_fn(|axis| from[axis] + (to[axis] - from[axis]).div_ceil(2));
            for corner in 0..8 {
                let upper = [corner & 1 != 0, corner & 2 != 0, corner & 4 != 0];
                let from: [usize; 3] =
                    std::array::from_fn(|axis| if upper[axis] { half[axis] } else { from[axis] });
                let to: [usize; 3] =
                    std::array::from_fn(|axis| if upper[axis] { to[axis] } else { half[axis] });
                if (0..3).all(|axis| from[axis] < to[axis]) {
                    self.sample_block(values, z0, from, to);
                }
            }
        } else {
            for z in from[2]..to[2] {
                for y in from[1]..to[1] {
                    for x in from[0]..to[0] {
                        values[((z - z0) * ny + y) * nx + x] = distance(self.point(x, y, z));
                    }
                }
            }
        }
    }
}

/// Moves a vertex, which surface nets puts near the surface, onto it: one Newton step along the gradient.
///
/// At most a quarter of a cell, so that no triangle can turn over.
fn settle(p: Vec3, cell_mm: f32) -> Vec3 {
    let (value, gradient) = gradient(p);
    let step = gradient * (value / gradient.length_squared().max(0.1));
    p - step.clamp_length_max(0.25 * cell_mm)
}

/// Value and gradient from the corners of a small tetrahedron.
fn gradient(p: Vec3) -> (f32, Vec3) {
    /// Half the edge of the cube about the tetrahedron (mm): well below the finest relief, well above rounding.
    const E: f32 = 0.1;
    let corners =
        [Vec3::new(1.0, -1.0, -1.0), Vec3::new(-1.0, -1.0, 1.0), Vec3::new(-1.0, 1.0, -1.0), Vec3::ONE];
    let mut value = 0.0;
    let mut slope = Vec3::ZERO;
    for corner in corners {
        let d = distance(p + corner * E);
        value += 0.25 * d;
        slope += corner * d;
    }
    (value, slope / (4.0 * E))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ruling_out_blocks_changes_no_sign() {
        let grid = Grid::new(3.7);
        let values = grid.sample();
        let [nx, ny, nz] = grid.points;
        let wrong = (0..nx * ny * nz).into_par_iter().filter(|index| {
            let p = grid.point(index % nx, index / nx % ny, index / (nx * ny));
            (values[*index] < 0.0) != (distance(p) < 0.0)
        });
        assert_eq!(wrong.count(), 0);
    }
}
