//! Beside the four passes: distances in millimetres, for programs that read the frame's depth.

use crate::bindings::distance::{
    BindGroup0, DistanceView, ENTRY_DISTANCE_FRAGMENT, ENTRY_DISTANCE_VERTEX, WGSL,
};
use crate::extent::Extent;
use crate::input::{BindError, Holds, Input};
use crate::label::Label;
use crate::output::{FrameError, Output, Progress};
use crate::target::Target;
use crate::view::SubsurfaceView;
use crate::wgpu;

use super::covering_pipeline::CoveringPipeline;
use super::{cleared, uniform_buffer};

const NAME: &str = "DistancePass";

/// How a [`DistancePass`] is made.
#[derive(Clone, Debug, Default)]
pub struct DistanceDescriptor<'a> {
    /// What the labels of its objects begin with; `None`, the default, for `DistancePass`.
    pub label: Option<&'a str>,
    /// Where compiled pipelines are kept; by default nowhere.
    pub pipeline_cache: Option<&'a wgpu::PipelineCache>,
}

/// Writes the distance along the view axis, mm, to a texture that can be copied; depth-stencil textures cannot.
#[derive(Debug)]
pub struct DistancePass {
    label: Label,
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    uniform: wgpu::Buffer,
    bound: Option<(Extent, wgpu::BindGroup)>,
    progress: Progress,
}

impl DistancePass {
    /// Format of the output.
    pub const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R32Float;

    /// Pipeline and layout.
    pub fn new(device: &wgpu::Device, descriptor: &DistanceDescriptor<'_>) -> Self {
        let label = Label::new(descriptor.label, NAME);
        let layout = BindGroup0::layout(device, &label.of("layout"));
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(&label.of("module")),
            source: wgpu::ShaderSource::Wgsl(WGSL.into()),
        });
        let pipeline = CoveringPipeline {
            label: &label.of("pipeline"),
            module: &module,
            entries: (ENTRY_DISTANCE_VERTEX, ENTRY_DISTANCE_FRAGMENT),
            constants: &[],
            bind_group_layouts: &[Some(&layout)],
            targets: &[Some(Self::FORMAT.into())],
            depth_stencil: None,
            cache: descriptor.pipeline_cache,
        }
        .create(device);
        let uniform = uniform_buffer::<DistanceView>(device, &label.of("view"));
        Self { label, pipeline, layout, uniform, bound: None, progress: Progress::default() }
    }

    /// Binds the depth.
    ///
    /// # Errors
    /// A texture that holds no depth. The old one stays.
    pub fn bind(&mut self, device: &wgpu::Device, depth: &wgpu::TextureView) -> Result<(), BindError> {
        let size = Input::new("depth", depth).check(device, Holds::Numbers)?.size();
        let uniform = self.uniform.as_entire_buffer_binding();
        let group = BindGroup0 { distance_view: uniform, distance_depth_texture: depth };
        self.bound = Some((size, group.create(device, &self.layout, &self.label.of("bind group"))));
        self.progress = Progress::Bound;
        Ok(())
    }

    /// A texture that the pass can write its output to.
    ///
    /// # Errors
    /// Nothing is bound.
    pub fn create_output(&self, device: &wgpu::Device) -> Result<Target, FrameError> {
        let Some((size, _)) = self.bound else { return Err(FrameError::NotBound { pass: NAME }) };
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT;
        Ok(Target::of_checked_size(device, size, Self::FORMAT, usage, &self.label.of("output")))
    }

    /// Uploads how depth becomes distance.
    ///
    /// # Errors
    /// Nothing is bound.
    pub fn prepare(&mut self, queue: &wgpu::Queue, view: &SubsurfaceView) -> Result<(), FrameError> {
        self.progress.is_bound(NAME)?;
        let uniform = DistanceView { distance_from_depth: view.distance_from_depth() };
        queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&uniform));
        self.progress = Progress::Prepared;
        Ok(())
    }

    /// Records the pass into `output`, which has the depth's size and [`FORMAT`](Self::FORMAT).
    ///
    /// # Errors
    /// A pass that is not bound and prepared, or an output that it cannot write to.
    pub fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        output: &wgpu::TextureView,
    ) -> Result<(), FrameError> {
        self.progress.is_prepared(NAME)?;
        let Some((size, bind_group)) = &self.bound else { return Err(FrameError::NotBound { pass: NAME }) };
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT;
        Output { pass: NAME, size: *size, format: Self::FORMAT, usage }.check(output)?;
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(self.label.as_str()),
            color_attachments: &[cleared(output, wgpu::Color::TRANSPARENT)],
            ..Default::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, bind_group, &[]);
        pass.draw(0..3, 0..1);
        Ok(())
    }
}
