//! Pass 3: light diffuses under the surface of translucent pixels.

mod compute;
mod fragment;
mod intermediate;
mod path;

use crate::bindings::kernel::{self, BindGroup1, ENTRY_DEBUG_FRAGMENT, ENTRY_SUBSURFACE_VERTEX};
use crate::error::{DebugViewError, ResizeError};
use crate::material_table::MaterialTable;
use crate::target::{Extent, Target};
use crate::view::SubsurfaceView;
use subsurface_kernel::{DebugView, KernelParts};

use compute::{ComputeFrame, ComputePath};
use fragment::{FragmentFrame, FragmentPath};

pub use path::{Path, PathError};

/// What the pass reads. All views but the scale are of one size.
#[derive(Clone, Copy, Debug)]
pub struct SubsurfaceInputs<'a> {
    /// Diffuse irradiance before the surface albedo, linear RGB: any float format.
    pub irradiance: &'a wgpu::TextureView,
    /// Surface albedo (red, green, blue) and the material number as a float; a number below 0 marks pixels that do not
    /// scatter. A format that holds such numbers: `Rgba16Float` or `Rgba32Float`.
    pub surface: &'a wgpu::TextureView,
    /// Depth: a depth texture (its depth aspect) or a single-channel float texture; [`SubsurfaceView`] says what its
    /// values mean.
    pub depth: &'a wgpu::TextureView,
    /// Depth-stencil texture whose stencil marks translucent pixels with
    /// [`TRANSLUCENT_STENCIL`](crate::TRANSLUCENT_STENCIL): saves work on the fragment path. It is only read, and may
    /// be the texture whose depth aspect is `depth`. The compute path goes by the material number alone.
    pub depth_stencil: Option<&'a wgpu::TextureView>,
    /// Factor on the mean free path per pixel, in the first component, from 0.001 to 1000: any float format. A texture
    /// of one pixel holds for all; `None` is 1 everywhere.
    pub mean_free_path_scale: Option<&'a wgpu::TextureView>,
}

/// Diffuses irradiance in screen space (Liang et al. 2023, eq. 22), on translucent pixels only, with the estimator that
/// its kernel was generated for.
///
/// ```no_run
/// # use subsurface_runtime::{Extent, SubsurfaceInputs, KernelParts, SubsurfacePass, SubsurfaceView, wgpu};
/// # fn frame(
/// #     device: &wgpu::Device, queue: &wgpu::Queue, encoder: &mut wgpu::CommandEncoder, kernel: &KernelParts,
/// #     irradiance: &wgpu::TextureView, surface: &wgpu::TextureView, depth: &wgpu::TextureView,
/// #     projection: [[f32; 4]; 4],
/// # ) -> Result<(), subsurface_runtime::ResizeError> {
/// let mut pass = SubsurfacePass::new(device, kernel, wgpu::TextureFormat::Rgba16Float, None);
/// let inputs =
///     SubsurfaceInputs { irradiance, surface, depth, depth_stencil: None, mean_free_path_scale: None };
/// pass.resize(device, Extent::new(1280, 720), &inputs)?;
/// pass.prepare(queue, &SubsurfaceView::from_projection(projection, 720, 1000.0));
/// pass.encode(encoder);
/// let diffused = pass.output().expect("resized above");
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct SubsurfacePass {
    stages: Stages,
    /// Of kernels that hold debug views.
    debug: Option<wgpu::RenderPipeline>,
    debug_view: Option<DebugView>,
    table: MaterialTable,
    uniform: wgpu::Buffer,
    layout: wgpu::BindGroupLayout,
    /// A scale of the mean free path of 1, bound if the inputs have none.
    unit_scale: Target,
    unit_scale_is_filled: bool,
    taps: u32,
    format: wgpu::TextureFormat,
    has_stencil: bool,
    bound: Option<Bound>,
}

#[derive(Debug)]
enum Stages {
    Compute(ComputePath),
    Fragment(FragmentPath),
}

#[derive(Debug)]
struct Bound {
    size: Extent,
    bind_group: wgpu::BindGroup,
    depth_stencil: Option<wgpu::TextureView>,
    output: Target,
    frame: Frame,
}

#[derive(Debug)]
enum Frame {
    Compute(ComputeFrame),
    Fragment(FragmentFrame),
}

impl SubsurfacePass {
    /// Pipelines and layouts: all that does not depend on the frame's size. Takes the compute path where the device has
    /// one and the kernel's writes `format`, else the fragment path.
    ///
    /// `format` is the output's; `stencil` the format of [`SubsurfaceInputs::depth_stencil`], if there will be one.
    pub fn new(
        device: &wgpu::Device,
        kernel: &KernelParts,
        format: wgpu::TextureFormat,
        stencil: Option<wgpu::TextureFormat>,
    ) -> Self {
        let path = match path::check_compute(device, kernel, format) {
            Ok(()) => Path::Compute,
            Err(_) => Path::Fragment,
        };
        Self::of_path(device, kernel, format, stencil, path)
    }

    /// The same on a path of the caller's choice.
    ///
    /// # Errors
    /// The compute path on a device without compute shaders, or to a format that the kernel's does not write.
    pub fn with_path(
        device: &wgpu::Device,
        kernel: &KernelParts,
        format: wgpu::TextureFormat,
        stencil: Option<wgpu::TextureFormat>,
        path: Path,
    ) -> Result<Self, PathError> {
        if path == Path::Compute {
            path::check_compute(device, kernel, format)?;
        }
        Ok(Self::of_path(device, kernel, format, stencil, path))
    }

    fn of_path(
        device: &wgpu::Device,
        kernel: &KernelParts,
        format: wgpu::TextureFormat,
        stencil: Option<wgpu::TextureFormat>,
        path: Path,
    ) -> Self {
        let table = MaterialTable::new(device, kernel);
        let layout = BindGroup1::layout(device, "SubsurfacePass layout");
        let module = crate::material_table::shader_module(device, kernel);
        let groups = [&table.layout, &layout];
        let stages = match path {
            Path::Compute => Stages::Compute(ComputePath::new(device, kernel, &module, groups)),
            Path::Fragment => {
                Stages::Fragment(FragmentPath::new(device, kernel, &module, groups, format, stencil))
            }
        };
        let debug = kernel.module().has_debug_views().then(|| {
            super::covering_pipeline(
                device,
                "SubsurfacePass debug view",
                &module,
                (ENTRY_SUBSURFACE_VERTEX, ENTRY_DEBUG_FRAGMENT),
                &groups.map(Some),
                &[Some(format.into())],
                None,
            )
        });
        let uniform = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("SubsurfacePass view"),
            size: size_of::<kernel::SubsurfaceView>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let unit_scale =
            Target::single_pixel(device, wgpu::TextureFormat::R32Float, "SubsurfacePass scale of 1");
        Self {
            stages,
            debug,
            debug_view: None,
            table,
            uniform,
            layout,
            unit_scale,
            unit_scale_is_filled: false,
            taps: kernel.module().estimator().taps(),
            format,
            has_stencil: stencil.is_some(),
            bound: None,
        }
    }

    /// The path that the pass takes.
    pub fn path(&self) -> Path {
        match self.stages {
            Stages::Compute(_) => Path::Compute,
            Stages::Fragment(_) => Path::Fragment,
        }
    }

    /// Shows how light is gathered in place of the diffused irradiance, or that again for `None`. Takes effect with the
    /// next [`prepare`](Self::prepare) and the [`encode`](Self::encode) after it, so call it before both.
    ///
    /// # Errors
    /// A view of a kernel that was compiled without debug views; what is shown stays.
    pub fn set_debug_view(&mut self, view: Option<DebugView>) -> Result<(), DebugViewError> {
        match view {
            Some(view) if self.debug.is_none() => Err(DebugViewError::NotLinked { view }),
            _ => {
                self.debug_view = view;
                Ok(())
            }
        }
    }

    /// Binds the inputs and makes the output anew if `size` changed. Call it again when an input view is replaced.
    ///
    /// # Errors
    /// A size of 0 or beyond the device's limit; a stencil where the pass was made without, or the reverse. The old
    /// bindings stay.
    pub fn resize(
        &mut self,
        device: &wgpu::Device,
        size: Extent,
        inputs: &SubsurfaceInputs<'_>,
    ) -> Result<(), ResizeError> {
        match (self.has_stencil, inputs.depth_stencil) {
            (true, None) => return Err(ResizeError::StencilMissing),
            (false, Some(_)) => return Err(ResizeError::StencilUnexpected),
            _ => {}
        }
        let (output, frame) = match self.bound.take_if(|bound| bound.size == size) {
            Some(bound) => (bound.output, bound.frame),
            None => {
                let mut filled = wgpu::TextureUsages::RENDER_ATTACHMENT;
                if self.path() == Path::Compute {
                    filled |= wgpu::TextureUsages::STORAGE_BINDING;
                }
                let output = Target::filled_by(device, size, self.format, filled, "SubsurfacePass output")?;
                let frame = match &self.stages {
                    Stages::Compute(path) => Frame::Compute(path.frame(device, size, &output.view)?),
                    Stages::Fragment(path) => Frame::Fragment(path.frame(device, size)?),
                };
                (output, frame)
            }
        };
        let bind_group = BindGroup1 {
            subsurface_view: self.uniform.as_entire_buffer_binding(),
            irradiance_texture: inputs.irradiance,
            surface_texture: inputs.surface,
            depth_texture: inputs.depth,
            mean_free_path_scale_texture: inputs.mean_free_path_scale.unwrap_or(&self.unit_scale.view),
        }
        .create(device, &self.layout, "SubsurfacePass bind group");
        let depth_stencil = inputs.depth_stencil.cloned();
        self.bound = Some(Bound { size, bind_group, depth_stencil, output, frame });
        Ok(())
    }

    /// Uploads this frame's parameters.
    pub fn prepare(&mut self, queue: &wgpu::Queue, view: &SubsurfaceView) {
        self.table.prepare(queue);
        if !std::mem::replace(&mut self.unit_scale_is_filled, true) {
            let layout =
                wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4), rows_per_image: None };
            let texture = &self.unit_scale.texture;
            queue.write_texture(
                texture.as_image_copy(),
                bytemuck::bytes_of(&1.0_f32),
                layout,
                texture.size(),
            );
        }
        let debug_view = self.debug_view.map_or(0, DebugView::number);
        queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&view.uniform(self.taps, debug_view)));
    }

    /// Records the pass. Submits nothing; before the first [`resize`](Self::resize) there is nothing to record.
    pub fn encode(&self, encoder: &mut wgpu::CommandEncoder) {
        let Some(bound) = &self.bound else { return };
        let groups = [&self.table.bind_group, &bound.bind_group];
        let output = &bound.output.view;
        if let (Some(_), Some(pipeline)) = (self.debug_view, &self.debug) {
            encode_debug_view(encoder, pipeline, groups, output);
            return;
        }
        match (&self.stages, &bound.frame) {
            (Stages::Compute(path), Frame::Compute(frame)) => path.encode(encoder, frame, groups),
            (Stages::Fragment(path), Frame::Fragment(frame)) => {
                path.encode(encoder, frame, groups, output, bound.depth_stencil.as_ref());
            }
            // Frames are made by the stages of the pass, which never change.
            _ => unreachable!("the frame belongs to the other path"),
        }
    }

    /// The diffused irradiance; `None` before the first [`resize`](Self::resize).
    pub fn output(&self) -> Option<&Target> {
        self.bound.as_ref().map(|bound| &bound.output)
    }
}

fn encode_debug_view(
    encoder: &mut wgpu::CommandEncoder,
    pipeline: &wgpu::RenderPipeline,
    groups: [&wgpu::BindGroup; 2],
    output: &wgpu::TextureView,
) {
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("SubsurfacePass debug view"),
        color_attachments: &[super::cleared(output, wgpu::Color::TRANSPARENT)],
        ..Default::default()
    });
    pass.set_bind_group(0, groups[0], &[]);
    pass.set_bind_group(BindGroup1::INDEX, groups[1], &[]);
    pass.set_pipeline(pipeline);
    pass.draw(0..3, 0..1);
}
