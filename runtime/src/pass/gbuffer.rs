//! Pass 2: irradiance, unscattered radiance and surface in one go.

use crate::bindings::kernel::{
    BindGroup3, ENTRY_GBUFFER_FRAGMENT, ENTRY_GBUFFER_VERTEX, GBufferFrame, GBufferVertex, GbufferBindGroup2,
};
use crate::camera::{Bounds, Camera};
use crate::error::{SizeError, TexelsError};
use crate::geometry::{Geometry, Object, SurfaceDescriptor};
use crate::light::{DirectionalLight, LIGHT_CAPACITY};
use crate::material_table::MaterialTable;
use crate::pass::cleared;
use crate::pass::shadow::ShadowPass;
use crate::target::{Extent, GBuffer, TRANSLUCENT_STENCIL};
use subsurface_kernel::KernelParts;

/// Camera and lights of one frame.
#[derive(Clone, Copy, Debug)]
pub struct GBufferView<'a> {
    /// The camera.
    pub camera: &'a Camera,
    /// Directional lights; those beyond [`LIGHT_CAPACITY`] are left out.
    pub lights: &'a [DirectionalLight],
    /// Irradiance that comes from everywhere alike, linear red, green, blue.
    pub ambient_irradiance: [f32; 3],
    /// Factor on every material's transmission: 1, or 0 for none.
    pub transmission: f32,
    /// A sphere around all objects.
    pub bounds: Bounds,
    /// Millimetres that a world unit has: 1000 for metres.
    pub millimetres_per_world_unit: f32,
}

/// Shades all objects into the [`GBuffer`].
#[derive(Debug)]
pub struct GBufferPass {
    pipeline: wgpu::RenderPipeline,
    table: MaterialTable,
    uniform: wgpu::Buffer,
    bind_group: wgpu::BindGroup,
    object_layout: wgpu::BindGroupLayout,
    shadow_map_size: u32,
    targets: Option<(Extent, GBuffer)>,
}

impl GBufferPass {
    /// Pipeline and bindings; `kernel` must hold the G-buffer's entry points (it does unless its compiler was told to
    /// leave them out).
    pub fn new(device: &wgpu::Device, kernel: &KernelParts, shadow: &ShadowPass) -> Self {
        let table = MaterialTable::new(device, kernel);
        let frame_layout = GbufferBindGroup2::layout(device, "GBufferPass frame layout");
        let object_layout = BindGroup3::layout(device, "GBufferPass object layout");
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("GBufferPass pipeline layout"),
            bind_group_layouts: &[Some(&table.layout), None, Some(&frame_layout), Some(&object_layout)],
            immediate_size: 0,
        });
        let module = crate::material_table::shader_module(device, kernel);
        let mark = wgpu::StencilFaceState {
            compare: wgpu::CompareFunction::Always,
            fail_op: wgpu::StencilOperation::Keep,
            depth_fail_op: wgpu::StencilOperation::Keep,
            pass_op: wgpu::StencilOperation::Replace,
        };
        let colour = || Some(wgpu::ColorTargetState::from(GBuffer::COLOUR_FORMAT));
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("GBufferPass pipeline"),
            layout: Some(&pipeline_layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some(ENTRY_GBUFFER_VERTEX),
                compilation_options: Default::default(),
                buffers: &[Some(GBufferVertex::LAYOUT)],
            },
            // Both sides are drawn: scans have open borders, and a hole would show the background.
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format: GBuffer::DEPTH_STENCIL_FORMAT,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Less),
                stencil: wgpu::StencilState {
                    front: mark,
                    back: mark,
                    read_mask: TRANSLUCENT_STENCIL,
                    write_mask: TRANSLUCENT_STENCIL,
                },
                bias: Default::default(),
            }),
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some(ENTRY_GBUFFER_FRAGMENT),
                compilation_options: Default::default(),
                targets: &[colour(), colour(), colour()],
            }),
            multiview_mask: None,
            cache: None,
        });
        let uniform = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("GBufferPass frame"),
            size: size_of::<GBufferFrame>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let comparison = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("GBufferPass shadow comparison"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            compare: Some(wgpu::CompareFunction::LessEqual),
            ..Default::default()
        });
        let bind_group = GbufferBindGroup2 {
            frame: uniform.as_entire_buffer_binding(),
            shadow_maps: shadow.maps(),
            shadow_comparison: &comparison,
        }
        .create(device, &frame_layout, "GBufferPass frame bind group");
        Self {
            pipeline,
            table,
            uniform,
            bind_group,
            object_layout,
            shadow_map_size: shadow.map_size(),
            targets: None,
        }
    }

    /// An object that this pass can draw.
    ///
    /// # Errors
    /// Textures whose bytes do not fit their size, or whose size is beyond the device's limit.
    pub fn object(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        geometry: Geometry,
        surface: &SurfaceDescriptor<'_>,
    ) -> Result<Object, TexelsError> {
        Object::new(device, queue, &self.object_layout, geometry, surface)
    }

    /// Makes the targets anew if `size` changed.
    ///
    /// # Errors
    /// A size of 0 or beyond the device's limit; the old targets stay.
    pub fn resize(&mut self, device: &wgpu::Device, size: Extent) -> Result<(), SizeError> {
        if self.targets.as_ref().is_none_or(|(old, _)| *old != size) {
            self.targets = Some((size, GBuffer::new(device, size)?));
        }
        Ok(())
    }

    /// The targets; `None` before the first [`resize`](Self::resize).
    pub fn targets(&self) -> Option<&GBuffer> {
        self.targets.as_ref().map(|(_, targets)| targets)
    }

    /// Uploads this frame's camera and lights.
    pub fn prepare(&mut self, queue: &wgpu::Queue, view: &GBufferView<'_>) {
        self.table.prepare(queue);
        let Some((size, _)) = &self.targets else { return };
        let aspect = size.width as f32 / size.height as f32;
        let projection = glam::Mat4::from_cols_array_2d(&view.camera.projection(aspect, &view.bounds));
        let mut frame: GBufferFrame = bytemuck::Zeroable::zeroed();
        frame.clip_from_world = (projection * view.camera.view_from_world()).to_cols_array_2d();
        frame.camera_position = view.camera.position;
        frame.ambient_irradiance = view.ambient_irradiance;
        frame.transmission = view.transmission;
        frame.light_count = view.lights.len().min(LIGHT_CAPACITY) as u32;
        for (slot, light) in frame.lights.iter_mut().zip(view.lights) {
            *slot = light.uniform(&view.bounds, self.shadow_map_size, view.millimetres_per_world_unit);
        }
        queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&frame));
    }

    /// Records the pass; before the first [`resize`](Self::resize) there is nothing to draw into.
    pub fn encode(&self, encoder: &mut wgpu::CommandEncoder, objects: &[Object]) {
        let Some((_, targets)) = &self.targets else { return };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("GBufferPass"),
            color_attachments: &[
                cleared(&targets.irradiance.view, wgpu::Color::TRANSPARENT),
                cleared(&targets.unscattered.view, wgpu::Color::TRANSPARENT),
                // −1: no material.
                cleared(&targets.surface.view, wgpu::Color { a: -1.0, ..wgpu::Color::TRANSPARENT }),
            ],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &targets.depth_stencil.view,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(0),
                    store: wgpu::StoreOp::Store,
                }),
            }),
            ..Default::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.table.bind_group, &[]);
        pass.set_bind_group(GbufferBindGroup2::INDEX, &self.bind_group, &[]);
        for object in objects {
            pass.set_stencil_reference(if object.translucent { TRANSLUCENT_STENCIL } else { 0 });
            pass.set_bind_group(BindGroup3::INDEX, &object.bind_group, &[]);
            pass.set_vertex_buffer(0, object.geometry.vertices.slice(..));
            pass.set_index_buffer(object.geometry.indices.slice(..), wgpu::IndexFormat::Uint32);
            pass.draw_indexed(0..object.geometry.index_count, 0, 0..1);
        }
    }
}
