//! Meshes on the device.

use crate::Vertex;
use crate::wgpu::{self, util::DeviceExt as _};

/// Vertices and indices of one mesh.
#[derive(Clone, Debug)]
pub struct Geometry {
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
    index_count: u32,
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
        }
    }

    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..self.index_count, 0, 0..1);
    }
}
