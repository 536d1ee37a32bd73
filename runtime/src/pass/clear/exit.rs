//! Where rays leave what is clear.

use crate::Vertex;
use crate::bindings::clear_exit::{
    BindGroup0, BindGroup1, ClearExitFrame, ENTRY_CLEAR_EXIT_FRAGMENT, ENTRY_CLEAR_EXIT_VERTEX, WGSL,
};
use crate::label::Label;
use crate::object::Object;
use crate::pass::{cleared, uniform_buffer};
use crate::target::Target;
use crate::wgpu;
use crate::wgpu_version::vertex_buffer;

use super::DEPTH_FORMAT;

/// Format of the distances.
pub(super) const EXIT_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R32Float;

/// Draws the farthest faces.
#[derive(Debug)]
pub(super) struct Exit {
    pipeline: wgpu::RenderPipeline,
    uniform: wgpu::Buffer,
    bind_group: wgpu::BindGroup,
}

impl Exit {
    pub(super) fn new(device: &wgpu::Device, label: &Label, cache: Option<&wgpu::PipelineCache>) -> Self {
        let layout = BindGroup0::layout(device, &label.of("exit layout"));
        let object_layout = BindGroup1::layout(device, &label.of("exit object layout"));
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(&label.of("exit module")),
            source: wgpu::ShaderSource::Wgsl(WGSL.into()),
        });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(&label.of("exit pipeline layout")),
            bind_group_layouts: &[Some(&layout), Some(&object_layout)],
            immediate_size: 0,
        });
        let position_only =
            wgpu::VertexBufferLayout { attributes: &Vertex::LAYOUT.attributes[..1], ..Vertex::LAYOUT };
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(&label.of("exit pipeline")),
            layout: Some(&pipeline_layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some(ENTRY_CLEAR_EXIT_VERTEX),
                compilation_options: Default::default(),
                buffers: &[vertex_buffer(position_only)],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format: DEPTH_FORMAT,
                depth_write_enabled: Some(true),
                // Reversed: the farthest is the least.
                depth_compare: Some(wgpu::CompareFunction::Less),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some(ENTRY_CLEAR_EXIT_FRAGMENT),
                compilation_options: Default::default(),
                targets: &[Some(EXIT_FORMAT.into())],
            }),
            multiview_mask: None,
            cache,
        });
        let uniform = uniform_buffer::<ClearExitFrame>(device, &label.of("exit frame"));
        let bind_group = BindGroup0 { clear_exit_frame: uniform.as_entire_buffer_binding() }.create(
            device,
            &layout,
            &label.of("exit bind group"),
        );
        Self { pipeline, uniform, bind_group }
    }

    pub(super) fn prepare(&self, queue: &wgpu::Queue, clip_from_world: [[f32; 4]; 4], camera: [f32; 3]) {
        let frame = ClearExitFrame { clip_from_world, camera_position: camera, padding_76: [0; 4] };
        queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&frame));
    }

    pub(super) fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        label: &str,
        objects: &[Object],
        [exit, depth]: [&Target; 2],
    ) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(label),
            color_attachments: &[cleared(&exit.view, wgpu::Color::TRANSPARENT)],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &depth.view,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Discard,
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.bind_group, &[]);
        for object in objects.iter().filter(|object| object.is_clear()) {
            // Equal layouts are one to wgpu: the transform is bound as for shadows.
            pass.set_bind_group(BindGroup1::INDEX, &object.shadow_group, &[]);
            object.geometry.draw(&mut pass);
        }
    }
}
