//! Beside the four passes: distances in millimetres, for programs that read the frame's depth.

use crate::bind_error::BindError;
use crate::bindings::distance::{
    BindGroup0, DistanceView, ENTRY_DISTANCE_FRAGMENT, ENTRY_DISTANCE_VERTEX, WGSL,
};
use crate::frame_error::FrameError;
use crate::input::{Holds, Input};
use crate::label::Label;
use crate::target::Target;
use crate::timestamps::Timestamps;
use crate::view::SubsurfaceView;
use crate::wgpu;

use super::covering_pass::{CoveringPass, CoveringPassDescriptor};

const NAME: &str = "DistancePass";

/// How a [`DistancePass`] is made.
#[derive(Clone, Debug, Default)]
pub struct DistanceDescriptor<'a> {
    /// What the labels of its objects begin with; `None`, the default, for `DistancePass`.
    pub label: Option<&'a str>,
    /// Where compiled pipelines are kept; by default nowhere.
    pub pipeline_cache: Option<&'a wgpu::PipelineCache>,
    /// Where the pass writes its times; by default nowhere.
    pub timestamps: Option<Timestamps>,
}

/// Writes the distance along the view axis, mm, to a texture that can be copied; depth-stencil textures cannot.
#[derive(Debug)]
pub struct DistancePass(CoveringPass);

impl DistancePass {
    /// Format of the output.
    pub const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R32Float;

    /// Pipeline and layout.
    pub fn new(device: &wgpu::Device, descriptor: &DistanceDescriptor<'_>) -> Self {
        let label = Label::new(descriptor.label, NAME);
        let layout = BindGroup0::layout(device, &label.of("layout"));
        let of = CoveringPassDescriptor {
            name: NAME,
            label,
            wgsl: WGSL,
            entries: (ENTRY_DISTANCE_VERTEX, ENTRY_DISTANCE_FRAGMENT),
            constants: &[],
            layout,
            format: Self::FORMAT,
            background: wgpu::Color::TRANSPARENT,
            pipeline_cache: descriptor.pipeline_cache,
            timestamps: descriptor.timestamps.clone(),
        };
        Self(CoveringPass::new::<DistanceView>(device, of))
    }

    /// Binds the depth.
    ///
    /// # Errors
    /// A texture that holds no depth. The old one stays.
    pub fn bind(&mut self, device: &wgpu::Device, depth: &wgpu::TextureView) -> Result<(), BindError> {
        let size = Input::new("depth", depth).check(device, Holds::Numbers)?.size();
        let group = BindGroup0 { distance_view: self.0.uniform(), distance_depth_texture: depth };
        let group = group.create(device, self.0.layout(), &self.0.label().of("bind group"));
        self.0.bind(size, group);
        Ok(())
    }

    /// A texture that the pass can write its output to.
    ///
    /// # Errors
    /// Nothing is bound.
    pub fn create_output(&self, device: &wgpu::Device) -> Result<Target, FrameError> {
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let label = self.0.label().of("output");
        Ok(Target::of_checked_size(device, self.0.size()?, Self::FORMAT, usage, &label))
    }

    /// Uploads how depth becomes distance.
    ///
    /// # Errors
    /// Nothing is bound.
    pub fn prepare(&mut self, queue: &wgpu::Queue, view: &SubsurfaceView) -> Result<(), FrameError> {
        self.0.prepare(queue, &DistanceView { distance_from_depth: view.distance_from_depth() })
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
        self.0.encode(encoder, output)
    }
}
