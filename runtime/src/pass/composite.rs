//! Pass 4: radiance, tone mapping, sRGB.

use crate::albedo_mixes::AlbedoMixes;
use crate::bind_error::BindError;
use crate::bindings::composite::{self, BindGroup0, ENTRY_COMPOSITE_FRAGMENT, ENTRY_COMPOSITE_VERTEX, WGSL};
use crate::extent::Extent;
use crate::frame_error::FrameError;
use crate::input::{Holds, Input};
use crate::label::Label;
use crate::loaded_kernel::LoadedKernel;
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
    /// The kernel whose materials say how much of the surface albedo came before the light diffused
    /// (`surface_albedo_mix`); by default none, and all of it comes afterwards.
    pub kernel: Option<&'a LoadedKernel>,
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
            kernel: None,
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
    /// Surface albedo; alpha is the material number, below 0 for none.
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
pub struct CompositePass {
    covering: CoveringPass,
    albedo_mixes: AlbedoMixes,
    pipeline_cache: Option<wgpu::PipelineCache>,
    timestamps: Option<Timestamps>,
    bound: Option<BoundInputs>,
}

/// Kept for another kernel.
#[derive(Debug)]
struct BoundInputs {
    size: Extent,
    diffused: wgpu::TextureView,
    unscattered: wgpu::TextureView,
    surface: wgpu::TextureView,
}

impl CompositePass {
    /// Pipeline and layout.
    pub fn new(device: &wgpu::Device, descriptor: &CompositeDescriptor<'_>) -> Self {
        let albedo_mixes = match descriptor.kernel {
            Some(kernel) => kernel.albedo_mixes().clone(),
            None => AlbedoMixes::none(device),
        };
        let (cache, timestamps) = (descriptor.pipeline_cache, descriptor.timestamps.clone());
        let label = Label::new(descriptor.label, NAME);
        let covering = covering(device, label, descriptor.format, cache, timestamps, &albedo_mixes);
        Self {
            covering,
            albedo_mixes,
            pipeline_cache: cache.cloned(),
            timestamps: descriptor.timestamps.clone(),
            bound: None,
        }
    }

    /// Takes another kernel, or none: see [`CompositeDescriptor::kernel`]. What is bound stays; call
    /// [`prepare`](Self::prepare) before the next frame.
    pub fn set_kernel(&mut self, device: &wgpu::Device, kernel: Option<&LoadedKernel>) {
        self.albedo_mixes = match kernel {
            Some(kernel) => kernel.albedo_mixes().clone(),
            None => AlbedoMixes::none(device),
        };
        let (label, format) = (self.covering.label().clone(), self.covering.format());
        let (cache, timestamps) = (self.pipeline_cache.as_ref(), self.timestamps.clone());
        self.covering = covering(device, label, format, cache, timestamps, &self.albedo_mixes);
        self.bind_group(device);
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
        self.bound = Some(BoundInputs {
            size: first.size(),
            diffused: diffused.clone(),
            unscattered: unscattered.clone(),
            surface: surface.clone(),
        });
        self.bind_group(device);
        Ok(())
    }

    fn bind_group(&mut self, device: &wgpu::Device) {
        let Some(bound) = &self.bound else { return };
        let group = BindGroup0 {
            composite_settings: self.covering.uniform(),
            diffused_texture: &bound.diffused,
            unscattered_texture: &bound.unscattered,
            surface_texture: &bound.surface,
            albedo_mixes: self.albedo_mixes.buffer(),
        }
        .create(device, self.covering.layout(), &self.covering.label().of("bind group"));
        self.covering.bind(bound.size, group);
    }

    /// Uploads this frame's settings.
    ///
    /// # Errors
    /// Nothing is bound.
    pub fn prepare(&mut self, queue: &wgpu::Queue, settings: &CompositeSettings) -> Result<(), FrameError> {
        let encode = settings.tone_map && !self.covering.format().is_srgb();
        let uniform = composite::CompositeSettings {
            background_top: settings.background[0],
            exposure: settings.exposure,
            background_bottom: settings.background[1],
            tone_map: u32::from(settings.tone_map),
            encode_srgb: u32::from(encode),
            padding_36: [0; 12],
        };
        self.covering.prepare(queue, &uniform)
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
        self.covering.encode(encoder, output)
    }
}

/// The pass over all pixels, for these mixes.
fn covering(
    device: &wgpu::Device,
    label: Label,
    format: wgpu::TextureFormat,
    pipeline_cache: Option<&wgpu::PipelineCache>,
    timestamps: Option<Timestamps>,
    albedo_mixes: &AlbedoMixes,
) -> CoveringPass {
    let layout = BindGroup0::layout(device, &label.of("layout"));
    let of = CoveringPassDescriptor {
        name: NAME,
        label,
        wgsl: WGSL,
        entries: (ENTRY_COMPOSITE_VERTEX, ENTRY_COMPOSITE_FRAGMENT),
        constants: &[("HAS_ALBEDO_MIXES", f64::from(u8::from(albedo_mixes.is_used())))],
        layout,
        format,
        background: wgpu::Color::BLACK,
        pipeline_cache,
        timestamps,
    };
    CoveringPass::new::<composite::CompositeSettings>(device, of)
}
