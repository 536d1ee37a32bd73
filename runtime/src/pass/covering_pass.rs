//! A pass of one triangle over the whole output, with one uniform and one bind group.

use bytemuck::Pod;

use crate::extent::Extent;
use crate::frame_error::FrameError;
use crate::label::Label;
use crate::output::{Output, Progress};
use crate::timestamps::Timestamps;
use crate::wgpu;

use super::covering_pipeline::CoveringPipeline;
use super::{cleared, uniform_buffer};

/// What such a pass is made of.
pub(super) struct CoveringPassDescriptor<'a> {
    /// Its name in errors.
    pub(super) name: &'static str,
    pub(super) label: Label,
    pub(super) wgsl: &'static str,
    /// Vertex and fragment entry points.
    pub(super) entries: (&'a str, &'a str),
    /// Values of the module's `override`s.
    pub(super) constants: &'a [(&'a str, f64)],
    /// Layout of bind group 0.
    pub(super) layout: wgpu::BindGroupLayout,
    /// Format of the output.
    pub(super) format: wgpu::TextureFormat,
    /// What the output is before the triangle.
    pub(super) background: wgpu::Color,
    pub(super) pipeline_cache: Option<&'a wgpu::PipelineCache>,
    pub(super) timestamps: Option<Timestamps>,
}

/// The pass, with what is bound to it.
#[derive(Debug)]
pub(super) struct CoveringPass {
    name: &'static str,
    label: Label,
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    uniform: wgpu::Buffer,
    format: wgpu::TextureFormat,
    background: wgpu::Color,
    timestamps: Option<Timestamps>,
    bound: Option<(Extent, wgpu::BindGroup)>,
    progress: Progress,
}

impl CoveringPass {
    /// The pass, whose uniform is a `U`.
    pub(super) fn new<U: Pod>(device: &wgpu::Device, descriptor: CoveringPassDescriptor<'_>) -> Self {
        let CoveringPassDescriptor { name, label, layout, format, background, timestamps, .. } = descriptor;
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(&label.of("module")),
            source: wgpu::ShaderSource::Wgsl(descriptor.wgsl.into()),
        });
        let pipeline = CoveringPipeline {
            label: &label.of("pipeline"),
            module: &module,
            entries: descriptor.entries,
            constants: descriptor.constants,
            bind_group_layouts: &[Some(&layout)],
            targets: &[Some(format.into())],
            depth_stencil: None,
            cache: descriptor.pipeline_cache,
        }
        .create(device);
        let uniform = uniform_buffer::<U>(device, &label.of("uniform"));
        let (bound, progress) = (None, Progress::default());
        Self { name, label, pipeline, layout, uniform, format, background, timestamps, bound, progress }
    }

    pub(super) fn label(&self) -> &Label {
        &self.label
    }

    pub(super) fn layout(&self) -> &wgpu::BindGroupLayout {
        &self.layout
    }

    pub(super) fn uniform(&self) -> wgpu::BufferBinding<'_> {
        self.uniform.as_entire_buffer_binding()
    }

    pub(super) fn format(&self) -> wgpu::TextureFormat {
        self.format
    }

    /// Binds inputs of `size`.
    pub(super) fn bind(&mut self, size: Extent, group: wgpu::BindGroup) {
        self.bound = Some((size, group));
        self.progress = Progress::Bound;
    }

    /// Size of what is bound.
    pub(super) fn size(&self) -> Result<Extent, FrameError> {
        let bound = self.bound.as_ref().ok_or(FrameError::NotBound { pass: self.name })?;
        Ok(bound.0)
    }

    /// Uploads the uniform of a frame.
    pub(super) fn prepare<U: Pod>(&mut self, queue: &wgpu::Queue, uniform: &U) -> Result<(), FrameError> {
        self.progress.is_bound(self.name)?;
        queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(uniform));
        self.progress = Progress::Prepared;
        Ok(())
    }

    /// Records the pass into `output`.
    pub(super) fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        output: &wgpu::TextureView,
    ) -> Result<(), FrameError> {
        self.progress.is_prepared(self.name)?;
        let Some((size, group)) = &self.bound else {
            return Err(FrameError::NotBound { pass: self.name });
        };
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT;
        Output { pass: self.name, size: *size, format: self.format, usage }.check(output)?;
        let timestamps = self.timestamps.as_ref();
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(self.label.as_str()),
            color_attachments: &[cleared(output, self.background)],
            timestamp_writes: timestamps.and_then(|timestamps| timestamps.of_render_pass(true, true)),
            ..Default::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, group, &[]);
        pass.draw(0..3, 0..1);
        Ok(())
    }
}
