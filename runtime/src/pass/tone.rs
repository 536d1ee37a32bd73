//! Radiance to a display's colours, where passes come between the composite pass and the picture.

use crate::bind_error::BindError;
use crate::bindings::tone::{self, BindGroup0, ENTRY_TONE_FRAGMENT, ENTRY_TONE_VERTEX, WGSL};
use crate::frame_error::FrameError;
use crate::input::{Holds, Input};
use crate::label::Label;
use crate::wgpu;

use super::composite::CompositeSettings;
use super::covering_pass::{CoveringPass, CoveringPassDescriptor};

const NAME: &str = "TonePass";

/// How a [`TonePass`] is made.
#[derive(Clone, Debug)]
pub struct ToneDescriptor<'a> {
    /// What the labels of its objects begin with; `None`, the default, for `TonePass`.
    pub label: Option<&'a str>,
    /// Format of the picture; by default `Rgba8UnormSrgb`.
    pub format: wgpu::TextureFormat,
    /// Where compiled pipelines are kept; by default nowhere.
    pub pipeline_cache: Option<&'a wgpu::PipelineCache>,
}

impl Default for ToneDescriptor<'_> {
    fn default() -> Self {
        Self { label: None, format: wgpu::TextureFormat::Rgba8UnormSrgb, pipeline_cache: None }
    }
}

/// Exposes, tone maps and encodes a picture of linear radiance.
#[derive(Debug)]
pub struct TonePass(CoveringPass);

impl TonePass {
    /// Pipeline and layout.
    pub fn new(device: &wgpu::Device, descriptor: &ToneDescriptor<'_>) -> Self {
        let label = Label::new(descriptor.label, NAME);
        let layout = BindGroup0::layout(device, &label.of("layout"));
        let of = CoveringPassDescriptor {
            name: NAME,
            label,
            wgsl: WGSL,
            entries: (ENTRY_TONE_VERTEX, ENTRY_TONE_FRAGMENT),
            constants: &[],
            layout,
            format: descriptor.format,
            background: wgpu::Color::BLACK,
            pipeline_cache: descriptor.pipeline_cache,
            timestamps: None,
        };
        Self(CoveringPass::new::<tone::ToneSettings>(device, of))
    }

    /// Binds the radiance.
    ///
    /// # Errors
    /// A texture that holds no colours. The old one stays.
    pub fn bind(&mut self, device: &wgpu::Device, radiance: &wgpu::TextureView) -> Result<(), BindError> {
        let size = Input::new("radiance", radiance).check(device, Holds::Colours)?.size();
        let group = BindGroup0 { tone_settings: self.0.uniform(), radiance_texture: radiance };
        let group = group.create(device, self.0.layout(), &self.0.label().of("bind group"));
        self.0.bind(size, group);
        Ok(())
    }

    /// Uploads this frame's settings, as of the composite pass; the background is in the radiance.
    ///
    /// # Errors
    /// Nothing is bound.
    pub fn prepare(&mut self, queue: &wgpu::Queue, settings: &CompositeSettings) -> Result<(), FrameError> {
        let encode = settings.tone_map && !self.0.format().is_srgb();
        let uniform = tone::ToneSettings {
            exposure: settings.exposure,
            tone_map: u32::from(settings.tone_map),
            encode_srgb: u32::from(encode),
        };
        self.0.prepare(queue, &uniform)
    }

    /// Records the pass into `output`, which has the radiance's size and the descriptor's format.
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
