//! A ball.

use subsurface_runtime::Vertex;

/// Vertices and triangles of a ball: so many rings, and twice as many sectors.
pub fn ball(middle: [f32; 3], radius: f32, rings: u32) -> (Vec<Vertex>, Vec<u32>) {
    let vertices = (0..=rings).flat_map(|ring| {
        (0..=2 * rings).map(move |sector| {
            let theta = ring as f32 / rings as f32 * std::f32::consts::PI;
            let phi = sector as f32 / rings as f32 * std::f32::consts::PI;
            let normal = [theta.sin() * phi.sin(), theta.cos(), theta.sin() * phi.cos()];
            let position = [0, 1, 2].map(|axis: usize| middle[axis] + radius * normal[axis]);
            Vertex { position, normal, texture_coordinate: [0.0; 2] }
        })
    });
    let row = 2 * rings + 1;
    let quads = (0..rings).flat_map(|ring| (0..2 * rings).map(move |sector| ring * row + sector));
    let indices = quads.flat_map(|a| [a, a + row, a + 1, a + 1, a + row, a + row + 1]);
    (vertices.collect(), indices.collect())
}
