//! Pass 3: light diffuses under the surface of translucent pixels.

mod compute;
mod descriptor;
mod fragment;
mod inputs;
mod intermediate;
mod path;

use crate::bind_error::BindError;
use crate::bindings::kernel::{self, BindGroup1, ENTRY_DEBUG_FRAGMENT, ENTRY_SUBSURFACE_VERTEX};
use crate::extent::Extent;
use crate::frame_error::FrameError;
use crate::loaded_kernel::LoadedKernel;
use crate::output::{self, Progress};
use crate::target::Target;
use crate::view::SubsurfaceView;
use crate::viewport::Viewport;
use crate::wgpu;
use subsurface_kernel::{ComputeShape, DebugView};

use super::covering_pipeline::CoveringPipeline;
use super::{PassError, uniform_buffer};
use compute::{ComputeFrame, ComputePath};
use descriptor::Settings;
use fragment::{FragmentFrame, FragmentPath, Output};
use inputs::KeptInputs;

pub use descriptor::SubsurfaceDescriptor;
pub use inputs::SubsurfaceInputs;
pub use path::Path;

const NAME: &str = "SubsurfacePass";

/// Diffuses irradiance in screen space (Liang et al. 2023, eq. 22), on translucent pixels only, with the estimator that
/// its kernel was generated for.
///
/// ```no_run
/// # use subsurface_runtime::{
/// #     LoadedKernel, SubsurfaceDescriptor, SubsurfaceInputs, KernelParts, SubsurfacePass, SubsurfaceView, wgpu,
/// # };
/// # fn frame(
/// #     device: &wgpu::Device, queue: &wgpu::Queue, encoder: &mut wgpu::CommandEncoder, parts: &KernelParts,
/// #     irradiance: &wgpu::TextureView, surface: &wgpu::TextureView, depth: &wgpu::TextureView,
/// #     projection: [[f32; 4]; 4],
/// # ) -> Result<(), Box<dyn std::error::Error>> {
/// let kernel = LoadedKernel::new(device, queue, parts)?;
/// let mut pass = SubsurfacePass::new(device, &kernel, &SubsurfaceDescriptor::default())?;
/// // When an input is made anew:
/// pass.bind(device, &SubsurfaceInputs::new(irradiance, surface, depth))?;
/// let diffused = pass.create_output(device)?;
/// // Every frame:
/// pass.prepare(queue, &SubsurfaceView::from_projection(projection, 720, 1000.0))?;
/// pass.encode(encoder, &diffused.view)?;
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct SubsurfacePass {
    settings: Settings,
    kernel: LoadedKernel,
    stages: Stages,
    /// Why the pass does not take the compute path, if it does not.
    refusal: Option<PassError>,
    debug: Option<wgpu::RenderPipeline>,
    debug_view: Option<DebugView>,
    uniform: wgpu::Buffer,
    layout: wgpu::BindGroupLayout,
    bound: Option<Bound>,
    progress: Progress,
}

#[derive(Debug)]
enum Stages {
    Compute(ComputePath),
    Fragment(FragmentPath),
}

#[derive(Debug)]
struct Bound {
    inputs: KeptInputs,
    size: Extent,
    viewport: Viewport,
    bind_group: wgpu::BindGroup,
    frame: Frame,
}

#[derive(Debug)]
enum Frame {
    Compute(Box<ComputeFrame>),
    Fragment(Box<FragmentFrame>),
}

impl SubsurfacePass {
    /// Pipelines and layouts: all that does not depend on the frame's size.
    ///
    /// # Errors
    /// A path that the device cannot take, or an output format that it can write on neither path.
    pub fn new(
        device: &wgpu::Device,
        kernel: &LoadedKernel,
        descriptor: &SubsurfaceDescriptor<'_>,
    ) -> Result<Self, PassError> {
        let settings = descriptor.settings();
        let layout = BindGroup1::layout(device, &settings.label.of("layout"));
        let uniform = uniform_buffer::<kernel::SubsurfaceView>(device, &settings.label.of("view"));
        let (stages, refusal) = Stages::new(device, kernel, &settings, &layout)?;
        let debug = debug_pipeline(device, kernel, &settings, &layout);
        Ok(Self {
            settings,
            kernel: kernel.clone(),
            stages,
            refusal,
            debug,
            debug_view: None,
            uniform,
            layout,
            bound: None,
            progress: Progress::default(),
        })
    }

    /// Takes another kernel, such as one whose materials were edited. Inputs stay bound; call
    /// [`prepare`](Self::prepare) before the next frame.
    ///
    /// The surface input holds material numbers of the new kernel from now on, which
    /// [`LoadedKernel::material_number`] knows by name. A debug view that the new kernel does not hold is turned off.
    ///
    /// # Errors
    /// As of [`new`](Self::new); the old kernel stays.
    pub fn set_kernel(&mut self, device: &wgpu::Device, kernel: &LoadedKernel) -> Result<(), PassError> {
        (self.stages, self.refusal) = Stages::new(device, kernel, &self.settings, &self.layout)?;
        self.debug = debug_pipeline(device, kernel, &self.settings, &self.layout);
        self.debug_view = self.debug_view.filter(|_| self.debug.is_some());
        self.kernel = kernel.clone();
        if let Some(mut bound) = self.bound.take() {
            bound.frame = self.stages.frame(device, &self.settings, bound.viewport.size());
            bound.bind_group = self.bind_group(device, &bound.inputs.inputs());
            self.bound = Some(bound);
            self.progress = Progress::Bound;
        }
        Ok(())
    }

    /// The kernel.
    pub fn kernel(&self) -> &LoadedKernel {
        &self.kernel
    }

    /// The path that the pass takes.
    pub fn path(&self) -> Path {
        match self.stages {
            Stages::Compute(_) => Path::Compute,
            Stages::Fragment(_) => Path::Fragment,
        }
    }

    /// How the compute path shares its work; `None` on the fragment path, and for a kernel that has one shape for all
    /// devices.
    pub fn shape(&self) -> Option<ComputeShape> {
        match &self.stages {
            Stages::Compute(path) => path.shape(),
            Stages::Fragment(_) => None,
        }
    }

    /// Why the pass does not take the compute path; `None` if it does, or if the descriptor asked for the other and the
    /// device could take either.
    pub fn compute_refusal(&self) -> Option<PassError> {
        self.refusal
    }

    /// Shows how light is gathered in place of the diffused irradiance, or that again for `None`. Takes effect with the
    /// next [`prepare`](Self::prepare) and the [`encode`](Self::encode) after it, so call it before both.
    ///
    /// # Errors
    /// A kernel that was compiled without debug views, or an output format that the device cannot render to.
    pub fn set_debug_view(&mut self, view: Option<DebugView>) -> Result<(), PassError> {
        if let (Some(view), None) = (view, &self.debug) {
            return Err(if self.kernel.module().has_debug_views() {
                PassError::NotRenderable { output: self.settings.format }
            } else {
                PassError::NoDebugViews { view }
            });
        }
        self.debug_view = view;
        Ok(())
    }

    /// Binds the inputs. Call it again when an input view is replaced; textures between the stages are made anew only if
    /// the size changed.
    ///
    /// # Errors
    /// Inputs that do not suit the pass or each other, named with what was found and what is needed. The old ones stay.
    pub fn bind(&mut self, device: &wgpu::Device, inputs: &SubsurfaceInputs<'_>) -> Result<(), BindError> {
        let (size, viewport) = inputs.check(device, &self.settings)?;
        let frame = match self.bound.take_if(|bound| bound.viewport.size() == viewport.size()) {
            Some(Bound { mut frame, .. }) => {
                if let Frame::Compute(frame) = &mut frame {
                    frame.forget_outputs();
                }
                frame
            }
            None => self.stages.frame(device, &self.settings, viewport.size()),
        };
        let bind_group = self.bind_group(device, inputs);
        self.bound = Some(Bound { inputs: inputs.keep(), size, viewport, bind_group, frame });
        self.progress = Progress::Bound;
        Ok(())
    }

    fn bind_group(&self, device: &wgpu::Device, inputs: &SubsurfaceInputs<'_>) -> wgpu::BindGroup {
        BindGroup1 {
            subsurface_view: self.uniform.as_entire_buffer_binding(),
            irradiance_texture: inputs.irradiance,
            surface_texture: inputs.surface,
            depth_texture: inputs.depth,
            mean_free_path_scale_texture: inputs
                .mean_free_path_scale
                .unwrap_or_else(|| self.kernel.unit_scale()),
            material_id_texture: inputs.material_ids.unwrap_or_else(|| self.kernel.no_material_ids()),
        }
        .create(device, &self.layout, &self.settings.label.of("bind group"))
    }

    /// A texture that the pass can write its output to: of the inputs' size and the descriptor's format, to be read in
    /// shaders and copied from.
    ///
    /// # Errors
    /// Nothing is bound.
    pub fn create_output(&self, device: &wgpu::Device) -> Result<Target, FrameError> {
        let Some(bound) = &self.bound else { return Err(FrameError::NotBound { pass: NAME }) };
        let mut written = self.written();
        if self.debug.is_some() {
            written |= wgpu::TextureUsages::RENDER_ATTACHMENT;
        }
        let label = self.settings.label.of("output");
        Ok(Target::of_checked_size(device, bound.size, self.settings.format, written, &label))
    }

    /// How the path writes its output.
    fn written(&self) -> wgpu::TextureUsages {
        match self.path() {
            Path::Compute => wgpu::TextureUsages::STORAGE_BINDING,
            Path::Fragment => wgpu::TextureUsages::RENDER_ATTACHMENT,
        }
    }

    /// Uploads this frame's parameters.
    ///
    /// # Errors
    /// Nothing is bound.
    pub fn prepare(&mut self, queue: &wgpu::Queue, view: &SubsurfaceView) -> Result<(), FrameError> {
        let Some(bound) = &self.bound else { return Err(FrameError::NotBound { pass: NAME }) };
        let debug_view = self.debug_view.map_or(0, DebugView::number);
        let uniform = view.uniform(self.kernel.estimator().taps(), debug_view, bound.viewport);
        queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&uniform));
        self.progress = Progress::Prepared;
        Ok(())
    }

    /// Records the pass into `output`, which has the inputs' size and the descriptor's format: the diffused irradiance,
    /// where there is no material the irradiance as it was, and the alpha of the irradiance everywhere. Submits nothing.
    ///
    /// The compute path stores to the output, so its texture needs the usage `STORAGE_BINDING`; the fragment path and
    /// debug views need `RENDER_ATTACHMENT`. Outside of a viewport the output keeps what it holds.
    ///
    /// # Errors
    /// A pass that is not bound and prepared, or an output that it cannot write to.
    pub fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        output: &wgpu::TextureView,
    ) -> Result<(), FrameError> {
        self.progress.is_prepared(NAME)?;
        let Some(bound) = &self.bound else { return Err(FrameError::NotBound { pass: NAME }) };
        let debug = self.debug.as_ref().filter(|_| self.debug_view.is_some());
        let usage = if debug.is_some() { wgpu::TextureUsages::RENDER_ATTACHMENT } else { self.written() };
        let (size, format) = (bound.size, self.settings.format);
        output::Output { pass: NAME, size, format, usage }.check(output)?;
        let groups = [self.kernel.bind_group(), &bound.bind_group];
        let inputs = bound.inputs.inputs();
        let target = Output {
            view: output,
            depth_stencil: inputs.depth_stencil,
            viewport: bound.viewport,
            is_whole: bound.viewport == Viewport::whole(size),
        };
        match (debug, &self.stages, &bound.frame) {
            (Some(pipeline), ..) => self.encode_debug_view(encoder, pipeline, groups, &target),
            (None, Stages::Compute(path), Frame::Compute(frame)) => {
                path.encode(encoder, &self.settings, frame, groups, output);
            }
            (None, Stages::Fragment(path), Frame::Fragment(frame)) => {
                path.encode(encoder, &self.settings, frame, groups, &target);
            }
            // Frames are made by the stages of the pass, together with which they change.
            _ => unreachable!("the frame belongs to the other path"),
        }
        Ok(())
    }

    fn encode_debug_view(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        pipeline: &wgpu::RenderPipeline,
        groups: [&wgpu::BindGroup; 2],
        output: &Output<'_>,
    ) {
        let timestamps = self.settings.timestamps.as_ref();
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(self.settings.label.as_str()),
            color_attachments: &[output.attachment()],
            timestamp_writes: timestamps.and_then(|timestamps| timestamps.of_render_pass(true, true)),
            ..Default::default()
        });
        pass.set_bind_group(0, groups[0], &[]);
        pass.set_bind_group(BindGroup1::INDEX, groups[1], &[]);
        pass.set_pipeline(pipeline);
        output.confine(&mut pass);
        pass.draw(0..3, 0..1);
    }
}

impl Stages {
    /// The stages of the path to take, and why it is not the compute path.
    fn new(
        device: &wgpu::Device,
        kernel: &LoadedKernel,
        settings: &Settings,
        layout: &wgpu::BindGroupLayout,
    ) -> Result<(Self, Option<PassError>), PassError> {
        let (path, refusal) = path::choose(device, kernel, settings.format, settings.path)?;
        let groups = [kernel.bind_group_layout(), layout];
        let stages = match path {
            Path::Compute => Self::Compute(ComputePath::new(device, kernel, settings, groups)?),
            Path::Fragment => Self::Fragment(FragmentPath::new(device, kernel, settings, groups)),
        };
        Ok((stages, refusal))
    }

    /// What lies between the stages for a viewport of `size`.
    fn frame(&self, device: &wgpu::Device, settings: &Settings, size: Extent) -> Frame {
        match self {
            Self::Compute(path) => Frame::Compute(Box::new(path.frame(device, settings, size))),
            Self::Fragment(path) => Frame::Fragment(Box::new(path.frame(device, settings, size))),
        }
    }
}

/// The pipeline of debug views, if the kernel holds them and the device can render to the output.
fn debug_pipeline(
    device: &wgpu::Device,
    kernel: &LoadedKernel,
    settings: &Settings,
    layout: &wgpu::BindGroupLayout,
) -> Option<wgpu::RenderPipeline> {
    if !kernel.module().has_debug_views() || path::check_render(device, settings.format).is_err() {
        return None;
    }
    let pipeline = CoveringPipeline {
        label: &settings.label.of("debug view"),
        module: kernel.shader_module(),
        entries: (ENTRY_SUBSURFACE_VERTEX, ENTRY_DEBUG_FRAGMENT),
        constants: settings.constants(),
        bind_group_layouts: &[Some(kernel.bind_group_layout()), Some(layout)],
        targets: &[Some(settings.format.into())],
        depth_stencil: None,
        cache: settings.pipeline_cache.as_ref(),
    };
    Some(pipeline.create(device))
}
