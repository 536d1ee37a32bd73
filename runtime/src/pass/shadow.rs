//! Pass 1: the nearest depth along each light.

use crate::Vertex;
use crate::bindings::shadow::{BindGroup0, BindGroup1, ENTRY_SHADOW_VERTEX, ShadowProjection, WGSL};
use crate::camera::Bounds;
use crate::frame_error::FrameError;
use crate::label::Label;
use crate::light::{Light, LightRanks, SHADOW_MAPS};
use crate::object::Object;
use crate::output::Progress;
use crate::timestamps::Timestamps;
use crate::wgpu;
use crate::wgpu_version::vertex_buffer;

use super::uniform_buffer;

const NAME: &str = "ShadowPass";

/// Texels per side of a shadow map where the caller does not say.
const SHADOW_MAP_SIZE: u32 = 2048;

/// How a [`ShadowPass`] is made.
#[derive(Clone, Debug, Default)]
pub struct ShadowDescriptor<'a> {
    /// What the labels of its objects begin with; `None`, the default, for `ShadowPass`.
    pub label: Option<&'a str>,
    /// Texels per side of a map, kept within 1 and the device's limit; by default 2048, 0.2 mm on a head half a metre tall.
    pub map_size: Option<u32>,
    /// Where compiled pipelines are kept; by default nowhere.
    pub pipeline_cache: Option<&'a wgpu::PipelineCache>,
    /// Where the pass writes its times; by default nowhere.
    pub timestamps: Option<Timestamps>,
}

/// Renders a shadow map for each of the most important lights, [`SHADOW_MAPS`] at most; they feed shadows and thickness.
///
/// It reads no texture, so there is nothing to bind: `new`, `prepare`, `encode`.
#[derive(Debug)]
pub struct ShadowPass {
    label: Label,
    pipeline: wgpu::RenderPipeline,
    maps: wgpu::TextureView,
    layers: Vec<Layer>,
    timestamps: Option<Timestamps>,
    light_count: usize,
    progress: Progress,
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
    pub fn new(device: &wgpu::Device, descriptor: &ShadowDescriptor<'_>) -> Self {
        let label = Label::new(descriptor.label, NAME);
        let layout = BindGroup0::layout(device, &label.of("layout"));
        let object_layout = BindGroup1::layout(device, &label.of("object layout"));
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(&label.of("module")),
            source: wgpu::ShaderSource::Wgsl(WGSL.into()),
        });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(&label.of("pipeline layout")),
            bind_group_layouts: &[Some(&layout), Some(&object_layout)],
            immediate_size: 0,
        });
        let position_only =
            wgpu::VertexBufferLayout { attributes: &Vertex::LAYOUT.attributes[..1], ..Vertex::LAYOUT };
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(&label.of("pipeline")),
            layout: Some(&pipeline_layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some(ENTRY_SHADOW_VERTEX),
                compilation_options: Default::default(),
                buffers: &[vertex_buffer(position_only)],
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
            cache: descriptor.pipeline_cache,
        });
        let largest = device.limits().max_texture_dimension_2d;
        let map_size = descriptor.map_size.unwrap_or(SHADOW_MAP_SIZE).clamp(1, largest);
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some(&label.of("maps")),
            size: wgpu::Extent3d {
                width: map_size,
                height: map_size,
                depth_or_array_layers: SHADOW_MAPS as u32,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: Self::FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let layers = (0..SHADOW_MAPS as u32)
            .map(|layer| Layer::new(device, &label, &layout, &texture, layer))
            .collect();
        let maps = texture.create_view(&wgpu::TextureViewDescriptor {
            label: Some(&label.of("maps")),
            dimension: Some(wgpu::TextureViewDimension::D2Array),
            ..Default::default()
        });
        let (timestamps, progress) = (descriptor.timestamps.clone(), Progress::Bound);
        Self { label, pipeline, maps, layers, timestamps, light_count: 0, progress }
    }

    /// All maps, one layer per light.
    pub fn maps(&self) -> &wgpu::TextureView {
        &self.maps
    }

    /// Texels per side of a map.
    pub fn map_size(&self) -> u32 {
        self.maps.texture().width()
    }

    /// Uploads the projections of the lights that have a map.
    pub fn prepare(&mut self, queue: &wgpu::Queue, lights: &[Light], ranks: &LightRanks, bounds: &Bounds) {
        self.light_count = 0;
        for (index, layer) in ranks.mapped().zip(&self.layers) {
            let camera = lights[index].shadow_camera(bounds);
            let projection =
                ShadowProjection { light_from_world: camera.clip_from_world().to_cols_array_2d() };
            queue.write_buffer(&layer.uniform, 0, bytemuck::bytes_of(&projection));
            self.light_count += 1;
        }
        self.progress = Progress::Prepared;
    }

    /// Records one depth-only pass per light, each into its layer of [`maps`](Self::maps).
    ///
    /// # Errors
    /// A pass that is not prepared.
    pub fn encode(&self, encoder: &mut wgpu::CommandEncoder, objects: &[Object]) -> Result<(), FrameError> {
        self.progress.is_prepared(NAME)?;
        if let (0, Some(timestamps)) = (self.light_count, &self.timestamps) {
            timestamps.of_nothing(encoder, self.label.as_str());
        }
        for (index, layer) in self.layers[..self.light_count].iter().enumerate() {
            let (is_first, is_last) = (index == 0, index + 1 == self.light_count);
            let timestamps = self.timestamps.as_ref();
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some(self.label.as_str()),
                color_attachments: &[],
                depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                    view: &layer.view,
                    depth_ops: Some(wgpu::Operations {
                        load: wgpu::LoadOp::Clear(1.0),
                        store: wgpu::StoreOp::Store,
                    }),
                    stencil_ops: None,
                }),
                timestamp_writes: timestamps.and_then(|times| times.of_render_pass(is_first, is_last)),
                ..Default::default()
            });
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &layer.bind_group, &[]);
            for object in objects.iter().filter(|object| !object.is_clear()) {
                pass.set_bind_group(BindGroup1::INDEX, &object.shadow_group, &[]);
                object.geometry.draw(&mut pass);
            }
        }
        Ok(())
    }
}

impl Layer {
    fn new(
        device: &wgpu::Device,
        label: &Label,
        layout: &wgpu::BindGroupLayout,
        maps: &wgpu::Texture,
        layer: u32,
    ) -> Self {
        let view = maps.create_view(&wgpu::TextureViewDescriptor {
            label: Some(&label.of("map")),
            dimension: Some(wgpu::TextureViewDimension::D2),
            base_array_layer: layer,
            array_layer_count: Some(1),
            ..Default::default()
        });
        let uniform = uniform_buffer::<ShadowProjection>(device, &label.of("projection"));
        let bind_group = BindGroup0 { projection: uniform.as_entire_buffer_binding() }.create(
            device,
            layout,
            &label.of("bind group"),
        );
        Self { view, uniform, bind_group }
    }
}
