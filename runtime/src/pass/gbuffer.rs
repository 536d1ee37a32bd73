//! Pass 2: irradiance, unscattered radiance and surface in one go.

use crate::bind_error::BindError;
use crate::bindings::kernel::{
    BindGroup3, ENTRY_GBUFFER_FRAGMENT, ENTRY_GBUFFER_VERTEX, GBufferFrame, GBufferVertex, GbufferBindGroup2,
};
use crate::camera::{Bounds, Camera};
use crate::environment::Environment;
use crate::extent::Extent;
use crate::frame_error::FrameError;
use crate::gbuffer::{GBuffer, TRANSLUCENT_STENCIL};
use crate::input::{Holds, Input};
use crate::label::Label;
use crate::light::{Light, LightBuffer, LightRanks};
use crate::loaded_kernel::LoadedKernel;
use crate::object::Object;
use crate::output::{Output, Progress};
use crate::timestamps::Timestamps;
use crate::wgpu;
use crate::wgpu_version::vertex_buffer;

use super::{PassError, cleared, uniform_buffer};

const NAME: &str = "GBufferPass";

/// How a [`GBufferPass`] is made.
#[derive(Clone, Debug, Default)]
pub struct GBufferDescriptor<'a> {
    /// What the labels of its objects begin with; `None`, the default, for `GBufferPass`.
    pub label: Option<&'a str>,
    /// Whether objects may scale the mean free path: the pass then writes one target more,
    /// [`GBuffer::with_mean_free_path_scale`]. By default not.
    pub mean_free_path_scale: bool,
    /// Where compiled pipelines are kept; by default nowhere.
    pub pipeline_cache: Option<&'a wgpu::PipelineCache>,
    /// Where the pass writes its times; by default nowhere.
    pub timestamps: Option<Timestamps>,
}

/// Camera and lights of one frame.
///
/// ```
/// use subsurface_runtime::{Bounds, Camera, Extent, GBufferView};
///
/// let (camera, bounds) = (Camera::default(), Bounds::new([0.0; 3], 0.2));
/// let view = GBufferView { ambient_irradiance: [0.1; 3], ..GBufferView::new(Extent::new(1280, 720), &camera, bounds, 1000.0) };
/// assert_eq!((view.lights.len(), view.transmission), (0, 1.0));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct GBufferView<'a> {
    /// Size of the targets.
    pub size: Extent,
    /// The camera.
    pub camera: &'a Camera,
    /// Lights, any number; by default none.
    pub lights: &'a [Light],
    /// Which of them have a map: those that the [`ShadowPass`](crate::ShadowPass) was given. By default none.
    pub ranks: Option<&'a LightRanks>,
    /// Irradiance that comes from everywhere alike, linear red, green, blue; by default 0.
    pub ambient_irradiance: [f32; 3],
    /// Factor on the environment that the pass was given: 1, the default, or 0 for none.
    pub environment_intensity: f32,
    /// Turn of the environment about the y axis, in radians; by default 0.
    pub environment_turn_radians: f32,
    /// Factor on every material's transmission: 1, the default, or 0 for none.
    pub transmission: f32,
    /// A sphere around all objects.
    pub bounds: Bounds,
    /// Millimetres that a world unit has: 1000 for metres. There is no default, because a wrong scale often looks
    /// plausible.
    pub millimetres_per_world_unit: f32,
}

impl<'a> GBufferView<'a> {
    /// A view without lights.
    pub const fn new(
        size: Extent,
        camera: &'a Camera,
        bounds: Bounds,
        millimetres_per_world_unit: f32,
    ) -> Self {
        Self {
            size,
            camera,
            lights: &[],
            ranks: None,
            ambient_irradiance: [0.0; 3],
            environment_intensity: 1.0,
            environment_turn_radians: 0.0,
            transmission: 1.0,
            bounds,
            millimetres_per_world_unit,
        }
    }
}

/// Shades all objects into a [`GBuffer`].
#[derive(Debug)]
pub struct GBufferPass {
    label: Label,
    /// Whether it writes scales of the mean free path.
    writes_scales: bool,
    pipeline_cache: Option<wgpu::PipelineCache>,
    timestamps: Option<Timestamps>,
    kernel: LoadedKernel,
    pipelines: Pipelines,
    uniform: wgpu::Buffer,
    comparison: wgpu::Sampler,
    layout: wgpu::BindGroupLayout,
    /// For a buffer of more lights.
    device: wgpu::Device,
    lights: LightBuffer,
    environment: Option<Environment>,
    /// What is bound where there is no environment.
    darkness: Environment,
    bound: Option<Bound>,
    /// Size of the frame that is prepared.
    size: Extent,
    progress: Progress,
}

#[derive(Debug)]
struct Bound {
    bind_group: wgpu::BindGroup,
    shadow_maps: wgpu::TextureView,
}

impl GBufferPass {
    /// Pipeline and layouts.
    ///
    /// # Errors
    /// A kernel that was compiled without the G-buffer's entry points.
    pub fn new(
        device: &wgpu::Device,
        kernel: &LoadedKernel,
        descriptor: &GBufferDescriptor<'_>,
    ) -> Result<Self, PassError> {
        let label = Label::new(descriptor.label, NAME);
        let writes_scales = descriptor.mean_free_path_scale;
        let shape = Shape { writes_scales, has_environment: false };
        let pipelines = Pipelines::new(device, kernel, &label, descriptor.pipeline_cache, shape)?;
        let layout = GbufferBindGroup2::layout(device, &label.of("frame layout"));
        let uniform = uniform_buffer::<GBufferFrame>(device, &label.of("frame"));
        let comparison = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some(&label.of("shadow comparison")),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            compare: Some(wgpu::CompareFunction::LessEqual),
            ..Default::default()
        });
        let lights = LightBuffer::new(device, label.of("lights"));
        let darkness = Environment::darkness(device);
        Ok(Self {
            label,
            writes_scales,
            pipeline_cache: descriptor.pipeline_cache.cloned(),
            timestamps: descriptor.timestamps.clone(),
            kernel: kernel.clone(),
            pipelines,
            uniform,
            comparison,
            layout,
            device: device.clone(),
            lights,
            environment: None,
            darkness,
            bound: None,
            size: Extent::new(0, 0),
            progress: Progress::default(),
        })
    }

    /// Takes another kernel; what is bound and prepared stays. The material numbers of objects are those of the new
    /// kernel from now on: [`Object::set_material`] sets them.
    ///
    /// # Errors
    /// As of [`new`](Self::new); the old kernel stays.
    pub fn set_kernel(&mut self, device: &wgpu::Device, kernel: &LoadedKernel) -> Result<(), PassError> {
        let cache = self.pipeline_cache.as_ref();
        self.pipelines = Pipelines::new(device, kernel, &self.label, cache, self.shape())?;
        self.kernel = kernel.clone();
        Ok(())
    }

    /// Binds the shadow maps: [`ShadowPass::maps`](crate::ShadowPass::maps), or as many maps of a depth format in one
    /// array.
    ///
    /// # Errors
    /// A texture that holds no depth. The old one stays.
    pub fn bind(&mut self, device: &wgpu::Device, shadow_maps: &wgpu::TextureView) -> Result<(), BindError> {
        Input::new("shadow_maps", shadow_maps).check(device, Holds::Depth)?;
        self.bind_group(shadow_maps.clone());
        self.progress = Progress::Bound;
        Ok(())
    }

    /// Lights all objects from all around too, or no more: light that is reflected, and that enters.
    ///
    /// [`GBufferView`] says how bright it is and how it is turned.
    ///
    /// Makes other pipelines where there was none before, or is none after.
    ///
    /// # Errors
    /// As of [`new`](Self::new).
    pub fn set_environment(&mut self, environment: Option<Environment>) -> Result<(), PassError> {
        let shape = Shape { has_environment: environment.is_some(), ..self.shape() };
        if shape != self.shape() {
            let cache = self.pipeline_cache.as_ref();
            self.pipelines = Pipelines::new(&self.device, &self.kernel, &self.label, cache, shape)?;
        }
        self.environment = environment;
        if let Some(bound) = self.bound.take() {
            self.bind_group(bound.shadow_maps);
        }
        Ok(())
    }

    fn shape(&self) -> Shape {
        Shape { writes_scales: self.writes_scales, has_environment: self.environment.is_some() }
    }

    fn bind_group(&mut self, shadow_maps: wgpu::TextureView) {
        let environment = self.environment.as_ref().unwrap_or(&self.darkness);
        let bind_group = GbufferBindGroup2 {
            frame: self.uniform.as_entire_buffer_binding(),
            shadow_maps: &shadow_maps,
            shadow_comparison: &self.comparison,
            lights: self.lights.binding(),
            environment_radiance: environment.radiance(),
            environment_sampler: environment.sampler(),
        }
        .create(&self.device, &self.layout, &self.label.of("frame bind group"));
        self.bound = Some(Bound { bind_group, shadow_maps });
    }

    /// Uploads this frame's camera and lights.
    ///
    /// # Errors
    /// Nothing is bound.
    pub fn prepare(&mut self, queue: &wgpu::Queue, view: &GBufferView<'_>) -> Result<(), FrameError> {
        if self.bound.is_none() {
            return Err(FrameError::NotBound { pass: NAME });
        }
        if self.lights.upload(&self.device, queue, view)
            && let Some(bound) = self.bound.take()
        {
            self.bind_group(bound.shadow_maps);
        }
        let projection =
            glam::Mat4::from_cols_array_2d(&view.camera.projection(view.size.aspect(), &view.bounds));
        let environment = self.environment.as_ref().unwrap_or(&self.darkness);
        let frame = GBufferFrame {
            clip_from_world: (projection * view.camera.view_from_world()).to_cols_array_2d(),
            camera_position: view.camera.position,
            light_count: view.lights.len() as u32,
            ambient_irradiance: view.ambient_irradiance,
            transmission: view.transmission,
            environment: environment.uniform(view.environment_intensity, view.environment_turn_radians),
            millimetres_per_world_unit: view.millimetres_per_world_unit,
            padding_260: [0; 12],
        };
        queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&frame));
        self.size = view.size;
        self.progress = Progress::Prepared;
        Ok(())
    }

    /// Records the pass into `targets`, which have the view's size.
    ///
    /// # Errors
    /// A pass that is not bound and prepared, or targets of another size than the view's.
    pub fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        objects: &[Object],
        targets: &GBuffer,
    ) -> Result<(), FrameError> {
        self.progress.is_prepared(NAME)?;
        let Some(bound) = &self.bound else { return Err(FrameError::NotBound { pass: NAME }) };
        let (format, usage) = (GBuffer::COLOUR_FORMAT, wgpu::TextureUsages::RENDER_ATTACHMENT);
        Output { pass: NAME, size: self.size, format, usage }.check(&targets.irradiance.view)?;
        if !self.writes_scales && objects.iter().any(Object::scales_mean_free_path) {
            return Err(FrameError::NoMeanFreePathScale { pass: NAME });
        }
        let scale = match &targets.mean_free_path_scale {
            Some(scale) if self.writes_scales => Some(scale),
            None if self.writes_scales => return Err(FrameError::NoScaleTarget { pass: NAME }),
            _ => None,
        };
        let attachments = [
            cleared(&targets.irradiance.view, wgpu::Color::TRANSPARENT),
            cleared(&targets.unscattered.view, wgpu::Color::TRANSPARENT),
            // −1: no material.
            cleared(&targets.surface.view, wgpu::Color { a: -1.0, ..wgpu::Color::TRANSPARENT }),
            scale.and_then(|scale| cleared(&scale.view, wgpu::Color::WHITE)),
        ];
        let timestamps = self.timestamps.as_ref();
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(self.label.as_str()),
            color_attachments: &attachments[..if scale.is_some() { 4 } else { 3 }],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &targets.depth_stencil.view,
                depth_ops: Some(wgpu::Operations {
                    // Reversed: 0 is infinitely far.
                    load: wgpu::LoadOp::Clear(0.0),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(0),
                    store: wgpu::StoreOp::Store,
                }),
            }),
            timestamp_writes: timestamps.and_then(|timestamps| timestamps.of_render_pass(true, true)),
            ..Default::default()
        });
        pass.set_bind_group(0, self.kernel.bind_group(), &[]);
        pass.set_bind_group(GbufferBindGroup2::INDEX, &bound.bind_group, &[]);
        let mut current = None;
        for object in objects.iter().filter(|object| !object.is_clear()) {
            let has_details = object.has_details();
            if current != Some(has_details) {
                pass.set_pipeline(self.pipelines.of(has_details));
                current = Some(has_details);
            }
            pass.set_stencil_reference(if object.is_translucent() { TRANSLUCENT_STENCIL } else { 0 });
            pass.set_bind_group(BindGroup3::INDEX, &object.surface_group, &[]);
            object.geometry.draw(&mut pass);
        }
        Ok(())
    }
}

/// What pipelines are made for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Shape {
    writes_scales: bool,
    has_environment: bool,
}

/// The pass for objects without and with details of their surface: what most have not costs them nothing.
#[derive(Debug)]
struct Pipelines {
    plain: wgpu::RenderPipeline,
    detailed: wgpu::RenderPipeline,
}

impl Pipelines {
    fn new(
        device: &wgpu::Device,
        kernel: &LoadedKernel,
        label: &Label,
        cache: Option<&wgpu::PipelineCache>,
        shape: Shape,
    ) -> Result<Self, PassError> {
        let of = |has_details| pipeline(device, kernel, label, cache, shape, has_details);
        Ok(Self { plain: of(false)?, detailed: of(true)? })
    }

    fn of(&self, has_details: bool) -> &wgpu::RenderPipeline {
        if has_details { &self.detailed } else { &self.plain }
    }
}

fn pipeline(
    device: &wgpu::Device,
    kernel: &LoadedKernel,
    label: &Label,
    cache: Option<&wgpu::PipelineCache>,
    shape: Shape,
    has_details: bool,
) -> Result<wgpu::RenderPipeline, PassError> {
    if !kernel.module().has_gbuffer() {
        return Err(PassError::NoGBuffer);
    }
    // Equal layouts are one to wgpu: bind groups of any of them suit the pipeline.
    let frame_layout = GbufferBindGroup2::layout(device, &label.of("frame layout"));
    let object_layout = BindGroup3::layout(device, &label.of("object layout"));
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(&label.of("pipeline layout")),
        bind_group_layouts: &[
            Some(kernel.bind_group_layout()),
            None,
            Some(&frame_layout),
            Some(&object_layout),
        ],
        immediate_size: 0,
    });
    let mark = wgpu::StencilFaceState {
        compare: wgpu::CompareFunction::Always,
        fail_op: wgpu::StencilOperation::Keep,
        depth_fail_op: wgpu::StencilOperation::Keep,
        pass_op: wgpu::StencilOperation::Replace,
    };
    let colour = || Some(wgpu::ColorTargetState::from(GBuffer::COLOUR_FORMAT));
    let scale = Some(wgpu::ColorTargetState::from(GBuffer::SCALE_FORMAT));
    let targets = [colour(), colour(), colour(), scale];
    let module = kernel.shader_module();
    Ok(device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(&label.of("pipeline")),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some(ENTRY_GBUFFER_VERTEX),
            compilation_options: Default::default(),
            buffers: &[vertex_buffer(GBufferVertex::LAYOUT)],
        },
        // Both sides are drawn: scans have open borders, and a hole would show the background.
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: GBuffer::DEPTH_STENCIL_FORMAT,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Greater),
            stencil: wgpu::StencilState {
                front: mark,
                back: mark,
                read_mask: TRANSLUCENT_STENCIL,
                write_mask: TRANSLUCENT_STENCIL,
            },
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some(ENTRY_GBUFFER_FRAGMENT),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: &[
                    ("HAS_ENVIRONMENT", f64::from(u8::from(shape.has_environment))),
                    ("HAS_DETAILS", f64::from(u8::from(has_details))),
                ],
                ..Default::default()
            },
            targets: &targets[..if shape.writes_scales { 4 } else { 3 }],
        }),
        multiview_mask: None,
        cache,
    }))
}
