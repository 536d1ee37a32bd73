//! Smaller levels of a picture, for what is seen through rough glass.

use crate::bindings::halve::{BindGroup0, ENTRY_HALVE_FRAGMENT, ENTRY_HALVE_VERTEX, WGSL};
use crate::extent::Extent;
use crate::label::Label;
use crate::mips::level_count;
use crate::pass::cleared;
use crate::pass::covering_pipeline::CoveringPipeline;
use crate::wgpu;

/// Makes the levels.
#[derive(Debug)]
pub(super) struct Halving {
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
}

/// A picture with all of its levels.
#[derive(Debug)]
pub(super) struct Levels {
    pub(super) texture: wgpu::Texture,
    /// All levels, for reading.
    pub(super) view: wgpu::TextureView,
    /// Each level but the first as a target, and the one above it as an input.
    steps: Vec<(wgpu::TextureView, wgpu::BindGroup)>,
}

impl Halving {
    pub(super) fn new(
        device: &wgpu::Device,
        label: &Label,
        format: wgpu::TextureFormat,
        cache: Option<&wgpu::PipelineCache>,
    ) -> Self {
        let layout = BindGroup0::layout(device, &label.of("halving layout"));
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(&label.of("halving module")),
            source: wgpu::ShaderSource::Wgsl(WGSL.into()),
        });
        let pipeline = CoveringPipeline {
            label: &label.of("halving pipeline"),
            module: &module,
            entries: (ENTRY_HALVE_VERTEX, ENTRY_HALVE_FRAGMENT),
            constants: &[],
            bind_group_layouts: &[Some(&layout)],
            targets: &[Some(format.into())],
            depth_stencil: None,
            cache,
        }
        .create(device);
        Self { pipeline, layout }
    }

    /// Textures for pictures of a size that the device is known to take.
    pub(super) fn levels(
        &self,
        device: &wgpu::Device,
        label: &Label,
        size: Extent,
        format: wgpu::TextureFormat,
    ) -> Levels {
        let count = level_count(size);
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some(&label.of("behind")),
            size: wgpu::Extent3d { width: size.width, height: size.height, depth_or_array_layers: 1 },
            mip_level_count: count,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT
                | wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let level = |level| {
            texture.create_view(&wgpu::TextureViewDescriptor {
                label: Some(&label.of("behind level")),
                base_mip_level: level,
                mip_level_count: Some(1),
                ..Default::default()
            })
        };
        let step = |to: u32| {
            let group = BindGroup0 { halved_texture: &level(to - 1) };
            (level(to), group.create(device, &self.layout, &label.of("halving bind group")))
        };
        let steps = (1..count).map(step).collect();
        Levels { view: texture.create_view(&Default::default()), steps, texture }
    }

    /// Records the levels below the first.
    pub(super) fn encode(&self, encoder: &mut wgpu::CommandEncoder, label: &str, levels: &Levels) {
        for (target, group) in &levels.steps {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some(label),
                color_attachments: &[cleared(target, wgpu::Color::BLACK)],
                ..Default::default()
            });
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, group, &[]);
            pass.draw(0..3, 0..1);
        }
    }
}
