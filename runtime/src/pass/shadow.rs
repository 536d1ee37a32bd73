//! Pass 1: the nearest depth along each light.

use crate::Vertex;
use crate::bindings::shadow::{BindGroup0, ENTRY_SHADOW_VERTEX, ShadowProjection, WGSL};
use crate::camera::Bounds;
use crate::geometry::Object;
use crate::light::{DirectionalLight, LIGHT_CAPACITY};

/// Texels per side of a shadow map: 0.2 mm on a head half a metre tall.
const SHADOW_MAP_SIZE: u32 = 2048;

/// Renders one shadow map per light; they feed shadows and thickness.
#[derive(Debug)]
pub struct ShadowPass {
    pipeline: wgpu::RenderPipeline,
    maps: wgpu::TextureView,
    layers: Vec<Layer>,
    light_count: usize,
}

#[derive(Debug)]
struct Layer {
    view: wgpu::TextureView,
    uniform: wgpu::Buffer,
    bind_group: wgpu::BindGroup,
}

impl ShadowPass {
    /// Format of the maps.
    pub const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

    /// Pipeline and maps; their size does not depend on the frame's.
    pub fn new(device: &wgpu::Device) -> Self {
        let layout = BindGroup0::layout(device, "ShadowPass layout");
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("ShadowPass module"),
            source: wgpu::ShaderSource::Wgsl(WGSL.into()),
        });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("ShadowPass pipeline layout"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let position_only =
            wgpu::VertexBufferLayout { attributes: &Vertex::LAYOUT.attributes[..1], ..Vertex::LAYOUT };
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("ShadowPass pipeline"),
            layout: Some(&pipeline_layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some(ENTRY_SHADOW_VERTEX),
                compilation_options: Default::default(),
                buffers: &[Some(position_only)],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format: Self::FORMAT,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Less),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: Default::default(),
            fragment: None,
            multiview_mask: None,
            cache: None,
        });
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("ShadowPass maps"),
            size: wgpu::Extent3d {
                width: SHADOW_MAP_SIZE,
                height: SHADOW_MAP_SIZE,
                depth_or_array_layers: LIGHT_CAPACITY as u32,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: Self::FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let layers =
            (0..LIGHT_CAPACITY as u32).map(|layer| Layer::new(device, &layout, &texture, layer)).collect();
        let maps = texture.create_view(&wgpu::TextureViewDescriptor {
            label: Some("ShadowPass maps"),
            dimension: Some(wgpu::TextureViewDimension::D2Array),
            ..Default::default()
        });
        Self { pipeline, maps, layers, light_count: 0 }
    }

    /// All maps, one layer per light.
    pub fn maps(&self) -> &wgpu::TextureView {
        &self.maps
    }

    /// Texels per side of a map.
    pub fn map_size(&self) -> u32 {
        SHADOW_MAP_SIZE
    }

    /// Uploads the lights' projections; lights beyond [`LIGHT_CAPACITY`] are left out.
    pub fn prepare(&mut self, queue: &wgpu::Queue, lights: &[DirectionalLight], bounds: &Bounds) {
        for (light, layer) in lights.iter().zip(&self.layers) {
            let projection =
                ShadowProjection { light_from_world: light.light_from_world(bounds).to_cols_array_2d() };
            queue.write_buffer(&layer.uniform, 0, bytemuck::bytes_of(&projection));
        }
        self.light_count = lights.len().min(self.layers.len());
    }

    /// Records one depth-only pass per light.
    pub fn encode(&self, encoder: &mut wgpu::CommandEncoder, objects: &[Object]) {
        for layer in &self.layers[..self.light_count] {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("ShadowPass"),
                color_attachments: &[],
                depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                    view: &layer.view,
                    depth_ops: Some(wgpu::Operations {
                        load: wgpu::LoadOp::Clear(1.0),
                        store: wgpu::StoreOp::Store,
                    }),
                    stencil_ops: None,
                }),
                ..Default::default()
            });
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &layer.bind_group, &[]);
            for object in objects {
                pass.set_vertex_buffer(0, object.geometry.vertices.slice(..));
                pass.set_index_buffer(object.geometry.indices.slice(..), wgpu::IndexFormat::Uint32);
                pass.draw_indexed(0..object.geometry.index_count, 0, 0..1);
            }
        }
    }
}

impl Layer {
    fn new(device: &wgpu::Device, layout: &wgpu::BindGroupLayout, maps: &wgpu::Texture, layer: u32) -> Self {
        let view = maps.create_view(&wgpu::TextureViewDescriptor {
            label: Some("ShadowPass map"),
            dimension: Some(wgpu::TextureViewDimension::D2),
            base_array_layer: layer,
            array_layer_count: Some(1),
            ..Default::default()
        });
        let uniform = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("ShadowPass projection"),
            size: size_of::<ShadowProjection>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let bind_group = BindGroup0 { projection: uniform.as_entire_buffer_binding() }.create(
            device,
            layout,
            "ShadowPass bind group",
        );
        Self { view, uniform, bind_group }
    }
}
