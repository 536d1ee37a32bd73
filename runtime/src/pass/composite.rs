//! Pass 4: radiance, tone mapping, sRGB.

use crate::bind_error::BindError;
use crate::bindings::composite::{self, BindGroup0, ENTRY_COMPOSITE_FRAGMENT, ENTRY_COMPOSITE_VERTEX, WGSL};
use crate::frame_error::FrameError;
use crate::input::{Holds, Input};
use crate::label::Label;
use crate::timestamps::Timestamps;
use crate::wgpu;

use super::covering_pass::{CoveringPass, CoveringPassDescriptor};

const NAME: &str = "CompositePass";

/// How a [`CompositePass`] is made.
///
/// ```
/// use subsurface_runtime::{CompositeDescriptor, wgpu};
///
/// let descriptor = CompositeDescriptor { label: Some("screen"), ..Default::default() };
/// assert_eq!(descriptor.format, wgpu::TextureFormat::Rgba8UnormSrgb);
/// ```
#[derive(Clone, Debug)]
pub struct CompositeDescriptor<'a> {
    /// What the labels of its objects begin with; `None`, the default, for `CompositePass`.
    pub label: Option<&'a str>,
    /// Format of the picture; by default `Rgba8UnormSrgb`.
    pub format: wgpu::TextureFormat,
    /// Where compiled pipelines are kept; by default nowhere.
    pub pipeline_cache: Option<&'a wgpu::PipelineCache>,
    /// Where the pass writes its times; by default nowhere.
    pub timestamps: Option<Timestamps>,
}

impl Default for CompositeDescriptor<'_> {
    fn default() -> Self {
        Self {
            label: None,
            format: wgpu::TextureFormat::Rgba8UnormSrgb,
            pipeline_cache: None,
            timestamps: None,
        }
    }
}

/// What the pass reads. All views have one size.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct CompositeInputs<'a> {
    /// Diffused irradiance, linear RGB; alpha is what it is multiplied by where it leaves, 1 for Lambert's.
    pub diffused: &'a wgpu::TextureView,
    /// Specular reflection + transmission; alpha is 0 where the background shows, and on geometry 1 or what
    /// [`GBuffer::unscattered`](crate::GBuffer::unscattered) says.
    pub unscattered: &'a wgpu::TextureView,
    /// Surface albedo.
    pub surface: &'a wgpu::TextureView,
}

impl<'a> CompositeInputs<'a> {
    /// All that the pass reads.
    pub const fn new(
        diffused: &'a wgpu::TextureView,
        unscattered: &'a wgpu::TextureView,
        surface: &'a wgpu::TextureView,
    ) -> Self {
        Self { diffused, unscattered, surface }
    }
}

/// How radiance becomes a picture.
///
/// ```
/// use subsurface_runtime::CompositeSettings;
///
/// let linear = CompositeSettings { tone_map: false, ..Default::default() };
/// assert_eq!(linear.exposure, 1.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CompositeSettings {
    /// Factor on all radiance before tone mapping; by default 1.
    pub exposure: f32,
    /// Tone map to [0, 1] (Khronos PBR Neutral) and, where the target does not do it, encode as sRGB. Off: linear
    /// radiance. On by default.
    pub tone_map: bool,
    /// Radiance of the background at the top and at the bottom, linear red, green, blue; by default dark greys,
    /// (0.035, 0.037, 0.042) to (0.012, 0.012, 0.014).
    pub background: [[f32; 3]; 2],
}

impl Default for CompositeSettings {
    fn default() -> Self {
        Self { exposure: 1.0, tone_map: true, background: [[0.035, 0.037, 0.042], [0.012, 0.012, 0.014]] }
    }
}

/// Multiplies with the surface albedo, adds what was not scattered and maps to the display.
///
/// The picture's alpha is 1 on geometry and 0 on the background, whose colour is written all the
/// same. Colours are not multiplied by it.
#[derive(Debug)]
pub struct CompositePass(CoveringPass);

impl CompositePass {
    /// Pipeline and layout.
    pub fn new(device: &wgpu::Device, descriptor: &CompositeDescriptor<'_>) -> Self {
        let label = Label::new(descriptor.label, NAME);
        let layout = BindGroup0::layout(device, &label.of("layout"));
        let of = CoveringPassDescriptor {
            name: NAME,
            label,
            wgsl: WGSL,
            entries: (ENTRY_COMPOSITE_VERTEX, ENTRY_COMPOSITE_FRAGMENT),
            layout,
            format: descriptor.format,
            background: wgpu::Color::BLACK,
            pipeline_cache: descriptor.pipeline_cache,
            timestamps: descriptor.timestamps.clone(),
        };
        Self(CoveringPass::new::<composite::CompositeSettings>(device, of))
    }

    /// Binds the inputs. Call it again when a view is replaced; the pass has no target of its own.
    ///
    /// # Errors
    /// Inputs of different sizes, or of formats that the pass cannot read. The old ones stay.
    pub fn bind(&mut self, device: &wgpu::Device, inputs: &CompositeInputs<'_>) -> Result<(), BindError> {
        let CompositeInputs { diffused, unscattered, surface } = *inputs;
        let first = Input::new("diffused", diffused).check(device, Holds::Colours)?;
        for (name, view) in [("unscattered", unscattered), ("surface", surface)] {
            Input::new(name, view).check(device, Holds::Colours)?.as_large_as(first)?;
        }
        let bind_group = BindGroup0 {
            composite_settings: self.0.uniform(),
            diffused_texture: diffused,
            unscattered_texture: unscattered,
            surface_texture: surface,
        }
        .create(device, self.0.layout(), &self.0.label().of("bind group"));
        self.0.bind(first.size(), bind_group);
        Ok(())
    }

    /// Uploads this frame's settings.
    ///
    /// # Errors
    /// Nothing is bound.
    pub fn prepare(&mut self, queue: &wgpu::Queue, settings: &CompositeSettings) -> Result<(), FrameError> {
        let encode = settings.tone_map && !self.0.format().is_srgb();
        let uniform = composite::CompositeSettings {
            background_top: settings.background[0],
            exposure: settings.exposure,
            background_bottom: settings.background[1],
            tone_map: u32::from(settings.tone_map),
            encode_srgb: u32::from(encode),
            padding_36: [0; 12],
        };
        self.0.prepare(queue, &uniform)
    }

    /// Records the pass into `output`, which has the inputs' size and the descriptor's format.
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
