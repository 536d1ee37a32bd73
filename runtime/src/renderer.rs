//! All four passes in order.

use crate::bind_error::BindError;
use crate::environment::Environment;
use crate::extent::Extent;
use crate::frame::Frame;
use crate::frame_error::FrameError;
use crate::gbuffer::GBuffer;
use crate::label::Label;
use crate::light::LightRanks;
use crate::loaded_kernel::LoadedKernel;
use crate::object::Object;
use crate::pass::PassError;
use crate::pass::clear::{ClearDescriptor, ClearPass};
use crate::pass::composite::{CompositeDescriptor, CompositeInputs, CompositePass, CompositeSettings};
use crate::pass::gbuffer::{GBufferDescriptor, GBufferPass, GBufferView};
use crate::pass::shadow::{ShadowDescriptor, ShadowPass};
use crate::pass::subsurface::{Path, SubsurfaceDescriptor, SubsurfaceInputs, SubsurfacePass};
use crate::pass::tone::{ToneDescriptor, TonePass};
use crate::target::Target;
use crate::timestamps::PassTimer;
use crate::wgpu;
use subsurface_kernel::ComputeShape;

const NAME: &str = "Renderer";

/// How a [`Renderer`] is made.
///
/// ```
/// use subsurface_runtime::{RendererDescriptor, wgpu};
///
/// let descriptor = RendererDescriptor { label: Some("portrait"), ..Default::default() };
/// assert_eq!(descriptor.format, wgpu::TextureFormat::Rgba8UnormSrgb);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct RendererDescriptor<'a> {
    /// What the labels of all objects begin with; by default the passes' types.
    pub label: Option<&'a str>,
    /// Format of the picture; by default `Rgba8UnormSrgb`.
    pub format: wgpu::TextureFormat,
    /// Texels per side of a shadow map; by default 2048.
    pub shadow_map_size: Option<u32>,
    /// Whether objects may scale the mean free path, by a texture or a factor: one target more, of two bytes a pixel. By
    /// default not.
    pub mean_free_path_scale: bool,
    /// Whether objects may be clear ([`SurfaceDescriptor::clear`](crate::SurfaceDescriptor::clear)): three passes more, and
    /// targets of 24 bytes a pixel. By default not.
    pub clear: bool,
    /// Path of the subsurface pass; by default the best that the device has.
    pub path: Option<Path>,
    /// How the compute path of the subsurface pass shares its work; by default what suits the device.
    pub shape: Option<ComputeShape>,
    /// Where compiled pipelines are kept; by default nowhere.
    pub pipeline_cache: Option<&'a wgpu::PipelineCache>,
    /// Where the passes write their times: a timer of four passes, [`Renderer::PASSES`]. By default nowhere.
    pub timer: Option<&'a PassTimer>,
}

impl Default for RendererDescriptor<'_> {
    fn default() -> Self {
        Self {
            label: None,
            format: wgpu::TextureFormat::Rgba8UnormSrgb,
            shadow_map_size: None,
            mean_free_path_scale: false,
            clear: false,
            path: None,
            shape: None,
            pipeline_cache: None,
            timer: None,
        }
    }
}

/// Shadow → G-buffer → subsurface → composite.
///
/// ```no_run
/// # use subsurface_runtime::*;
/// # fn draw(
/// #     device: &wgpu::Device, queue: &wgpu::Queue, parts: &KernelParts, geometry: Geometry, output: &wgpu::TextureView,
/// # ) -> Result<(), Box<dyn std::error::Error>> {
/// let kernel = LoadedKernel::new(device, queue, parts)?;
/// let mut renderer = Renderer::new(device, &kernel, &RendererDescriptor::default())?;
/// let surface = SurfaceDescriptor { material: kernel.material_number("skin"), ..Default::default() };
/// let objects = [Object::new(device, queue, geometry, &surface)?];
///
/// renderer.resize(device, Extent::new(1280, 720))?;
/// let lights = [DirectionalLight::default().into()];
/// let frame = Frame { lights: &lights, ..Frame::new(Camera::default(), Bounds::new([0.0; 3], 0.2), 1000.0) };
/// renderer.prepare(queue, &frame)?;
/// let mut encoder = device.create_command_encoder(&Default::default());
/// renderer.encode(&mut encoder, &objects, output)?;
/// queue.submit([encoder.finish()]);
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct Renderer {
    /// Pass 1.
    pub shadow: ShadowPass,
    /// Pass 2.
    pub gbuffer: GBufferPass,
    /// Pass 3.
    pub subsurface: SubsurfacePass,
    /// Pass 4.
    pub composite: CompositePass,
    clear: Option<Clear>,
    label: Label,
    ranks: LightRanks,
    mean_free_path_scale: bool,
    targets: Option<(GBuffer, Target)>,
}

/// What draws clear objects, between the composite pass and the picture.
#[derive(Debug)]
struct Clear {
    pass: ClearPass,
    tone: TonePass,
    /// Linear radiance.
    picture: Option<Target>,
}

impl Renderer {
    /// Names of the passes, in the order in which a [`PassTimer`] times them.
    pub const PASSES: [&'static str; 4] = ["shadow", "G-buffer", "subsurface", "composite"];

    /// All that does not depend on the frame's size.
    ///
    /// # Errors
    /// A kernel without the G-buffer's entry points, or a path that the device cannot take.
    pub fn new(
        device: &wgpu::Device,
        kernel: &LoadedKernel,
        descriptor: &RendererDescriptor<'_>,
    ) -> Result<Self, PassError> {
        let RendererDescriptor {
            format,
            mean_free_path_scale,
            clear,
            path,
            shape,
            pipeline_cache,
            timer,
            ..
        } = *descriptor;
        let names = ["ShadowPass", "GBufferPass", "SubsurfacePass", "CompositePass"];
        let labels =
            names.map(|name| descriptor.label.map_or(name.to_owned(), |label| format!("{label} {name}")));
        let [shadow, gbuffer, subsurface, composite] = labels.each_ref().map(|label| Some(label.as_str()));
        let timestamps = |pass| timer.and_then(|timer| timer.timestamps(pass));
        let shadow = ShadowPass::new(
            device,
            &ShadowDescriptor {
                label: shadow,
                map_size: descriptor.shadow_map_size,
                pipeline_cache,
                timestamps: timestamps(0),
            },
        );
        let gbuffer = GBufferPass::new(
            device,
            kernel,
            &GBufferDescriptor {
                label: gbuffer,
                mean_free_path_scale,
                pipeline_cache,
                timestamps: timestamps(1),
            },
        )?;
        let subsurface = SubsurfacePass::new(
            device,
            kernel,
            &SubsurfaceDescriptor {
                label: subsurface,
                format: GBuffer::COLOUR_FORMAT,
                stencil: Some(GBuffer::DEPTH_STENCIL_FORMAT),
                path,
                shape,
                pipeline_cache,
                timestamps: timestamps(2),
                ..Default::default()
            },
        )?;
        let composite = CompositePass::new(
            device,
            &CompositeDescriptor {
                label: composite,
                format: if clear { ClearPass::FORMAT } else { format },
                kernel: Some(kernel),
                pipeline_cache,
                timestamps: timestamps(3),
            },
        );
        let label = Label::new(descriptor.label, NAME);
        let clear = clear.then(|| {
            let [clear, tone] = ["ClearPass", "TonePass"]
                .map(|name| descriptor.label.map_or(name.to_owned(), |label| format!("{label} {name}")));
            let pass = ClearDescriptor { label: Some(&clear), pipeline_cache };
            let tone = ToneDescriptor { label: Some(&tone), format, pipeline_cache };
            Clear { pass: ClearPass::new(device, &pass), tone: TonePass::new(device, &tone), picture: None }
        });
        Ok(Self {
            shadow,
            gbuffer,
            subsurface,
            composite,
            clear,
            label,
            ranks: LightRanks::default(),
            mean_free_path_scale,
            targets: None,
        })
    }

    /// Takes another kernel, such as one whose materials were edited; call [`prepare`](Self::prepare) before the next
    /// frame. Material numbers of objects are those of the new kernel: [`Object::set_material`] sets them.
    ///
    /// # Errors
    /// As of [`new`](Self::new).
    pub fn set_kernel(&mut self, device: &wgpu::Device, kernel: &LoadedKernel) -> Result<(), PassError> {
        // Refused before either pass has taken it.
        if !kernel.module().has_gbuffer() {
            return Err(PassError::NoGBuffer);
        }
        self.subsurface.set_kernel(device, kernel)?;
        self.gbuffer.set_kernel(device, kernel)?;
        self.composite.set_kernel(device, Some(kernel));
        Ok(())
    }

    /// Lights all objects from all around too, or no more; [`Frame`] says how bright it is and how it is turned.
    ///
    /// # Errors
    /// As of [`new`](Self::new).
    pub fn set_environment(&mut self, environment: Option<Environment>) -> Result<(), PassError> {
        if let Some(clear) = &mut self.clear {
            clear.pass.set_environment(environment.clone());
        }
        self.gbuffer.set_environment(environment)
    }

    /// How important the lights of the last frame are that was prepared.
    pub fn light_ranks(&self) -> &LightRanks {
        &self.ranks
    }

    /// Makes targets and bindings anew if `size` changed.
    ///
    /// # Errors
    /// A size of 0 or beyond the device's limit; the old targets stay.
    pub fn resize(&mut self, device: &wgpu::Device, size: Extent) -> Result<(), BindError> {
        if self.targets.as_ref().is_some_and(|(targets, _)| targets.size() == size) {
            return Ok(());
        }
        let mut targets = GBuffer::new(device, size)?;
        if self.mean_free_path_scale {
            targets = targets.with_mean_free_path_scale(device);
        }
        let mut written = wgpu::TextureUsages::RENDER_ATTACHMENT;
        if self.subsurface.path() == Path::Compute {
            written |= wgpu::TextureUsages::STORAGE_BINDING;
        }
        let label = self.label.of("diffused irradiance");
        let diffused = Target::filled_by(device, size, GBuffer::COLOUR_FORMAT, written, &label)?;
        self.gbuffer.bind(device, self.shadow.maps())?;
        let mut inputs =
            SubsurfaceInputs::new(&targets.irradiance.view, &targets.surface.view, &targets.depth);
        if let Some(scale) = &targets.mean_free_path_scale {
            inputs = inputs.with_mean_free_path_scale(&scale.view);
        }
        self.subsurface.bind(device, &inputs.with_depth_stencil(&targets.depth_stencil.view))?;
        self.composite.bind(
            device,
            &CompositeInputs::new(&diffused.view, &targets.unscattered.view, &targets.surface.view),
        )?;
        if let Some(clear) = &mut self.clear {
            let picture = Target::new(device, size, ClearPass::FORMAT, &self.label.of("radiance"))?;
            clear.pass.bind(device, &targets.depth)?;
            clear.tone.bind(device, &picture.view)?;
            clear.picture = Some(picture);
        }
        self.targets = Some((targets, diffused));
        Ok(())
    }

    /// Uploads this frame's parameters.
    ///
    /// # Errors
    /// No [`resize`](Self::resize) came before.
    pub fn prepare(&mut self, queue: &wgpu::Queue, frame: &Frame<'_>) -> Result<(), FrameError> {
        let Some((targets, _)) = &self.targets else { return Err(FrameError::NotResized) };
        let size = targets.size();
        self.ranks.update(frame.lights, &frame.bounds);
        self.shadow.prepare(queue, frame.lights, &self.ranks, &frame.bounds);
        let view = GBufferView {
            size,
            camera: &frame.camera,
            lights: frame.lights,
            ranks: Some(&self.ranks),
            ambient_irradiance: frame.ambient_irradiance,
            environment_intensity: frame.environment_intensity,
            environment_turn_radians: frame.environment_turn_radians,
            transmission: frame.transmission,
            bounds: frame.bounds,
            millimetres_per_world_unit: frame.millimetres_per_world_unit,
        };
        self.gbuffer.prepare(queue, &view)?;
        self.subsurface.prepare(queue, &frame.subsurface_view(size))?;
        let Some(clear) = &mut self.clear else { return self.composite.prepare(queue, &frame.composite) };
        clear.pass.prepare(queue, &view)?;
        clear.tone.prepare(queue, &frame.composite)?;
        let linear = CompositeSettings { exposure: 1.0, tone_map: false, ..frame.composite };
        self.composite.prepare(queue, &linear)
    }

    /// Records all four passes; the picture goes to `output`, whose alpha is 1 where an object is and 0 on the
    /// background.
    ///
    /// # Errors
    /// A renderer that is not resized and prepared, or an output that it cannot write to.
    pub fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        objects: &[Object],
        output: &wgpu::TextureView,
    ) -> Result<(), FrameError> {
        let Some((targets, diffused)) = &self.targets else { return Err(FrameError::NotResized) };
        self.shadow.encode(encoder, objects)?;
        self.gbuffer.encode(encoder, objects, targets)?;
        self.subsurface.encode(encoder, &diffused.view)?;
        self.encode_picture(encoder, objects, output)
    }

    /// Records what comes after the subsurface pass: the composite pass, and what is clear.
    ///
    /// # Errors
    /// As of [`encode`](Self::encode).
    pub fn encode_picture(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        objects: &[Object],
        output: &wgpu::TextureView,
    ) -> Result<(), FrameError> {
        let Some(clear) = &self.clear else {
            if objects.iter().any(Object::is_clear) {
                return Err(FrameError::NoClearPass);
            }
            return self.composite.encode(encoder, output);
        };
        let Some(picture) = &clear.picture else { return Err(FrameError::NotResized) };
        self.composite.encode(encoder, &picture.view)?;
        clear.pass.encode(encoder, objects, picture)?;
        clear.tone.encode(encoder, output)
    }

    /// Linear radiance of the picture, before exposure; `None` where the renderer draws nothing clear, and before the first
    /// [`resize`](Self::resize).
    pub fn radiance(&self) -> Option<&Target> {
        self.clear.as_ref()?.picture.as_ref()
    }

    /// The G-buffer; `None` before the first [`resize`](Self::resize).
    pub fn targets(&self) -> Option<&GBuffer> {
        self.targets.as_ref().map(|(targets, _)| targets)
    }

    /// The diffused irradiance; `None` before the first [`resize`](Self::resize).
    pub fn diffused(&self) -> Option<&Target> {
        self.targets.as_ref().map(|(_, diffused)| diffused)
    }
}
