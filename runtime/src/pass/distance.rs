//! Beside the four passes: distances in millimetres, for programs that read the frame's depth.

use crate::bindings::distance::{
    BindGroup0, DistanceView, ENTRY_DISTANCE_FRAGMENT, ENTRY_DISTANCE_VERTEX, WGSL,
};
use crate::error::SizeError;
use crate::target::{Extent, Target};
use crate::view::SubsurfaceView;

/// Writes the distance along the view axis, mm, to a texture that can be copied; depth-stencil textures cannot.
#[derive(Debug)]
pub struct DistancePass {
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    uniform: wgpu::Buffer,
    bound: Option<(Extent, wgpu::BindGroup, Target)>,
}

impl DistancePass {
    /// Format of the output.
    pub const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R32Float;

    /// Pipeline and layout.
    pub fn new(device: &wgpu::Device) -> Self {
        let layout = BindGroup0::layout(device, "DistancePass layout");
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("DistancePass module"),
            source: wgpu::ShaderSource::Wgsl(WGSL.into()),
        });
        let entries = (ENTRY_DISTANCE_VERTEX, ENTRY_DISTANCE_FRAGMENT);
        let pipeline = super::covering_pipeline(
            device,
            "DistancePass pipeline",
            &module,
            entries,
            &[Some(&layout)],
            &[Some(Self::FORMAT.into())],
            None,
        );
        let uniform = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("DistancePass view"),
            size: size_of::<DistanceView>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { pipeline, layout, uniform, bound: None }
    }

    /// Binds the depth and makes the output.
    ///
    /// # Errors
    /// A size of 0 or beyond the device's limit; the old output stays.
    pub fn resize(
        &mut self,
        device: &wgpu::Device,
        size: Extent,
        depth: &wgpu::TextureView,
    ) -> Result<(), SizeError> {
        let output = match self.bound.take_if(|(old, ..)| *old == size) {
            Some((_, _, output)) => output,
            None => Target::new(device, size, Self::FORMAT, "DistancePass output")?,
        };
        let uniform = self.uniform.as_entire_buffer_binding();
        let group = BindGroup0 { distance_view: uniform, distance_depth_texture: depth };
        self.bound = Some((size, group.create(device, &self.layout, "DistancePass bind group"), output));
        Ok(())
    }

    /// Uploads how depth becomes distance.
    pub fn prepare(&mut self, queue: &wgpu::Queue, view: &SubsurfaceView) {
        let uniform = DistanceView { distance_from_depth: view.distance_from_depth() };
        queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&uniform));
    }

    /// Records the pass.
    pub fn encode(&self, encoder: &mut wgpu::CommandEncoder) {
        let Some((_, bind_group, output)) = &self.bound else { return };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("DistancePass"),
            color_attachments: &[super::cleared(&output.view, wgpu::Color::TRANSPARENT)],
            ..Default::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, bind_group, &[]);
        pass.draw(0..3, 0..1);
    }

    /// The distances; `None` before the first [`resize`](Self::resize).
    pub fn output(&self) -> Option<&Target> {
        self.bound.as_ref().map(|(_, _, output)| output)
    }
}
