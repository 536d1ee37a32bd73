//! Pass 3: light diffuses under the surface of translucent pixels.

use crate::bindings::kernel::{
    self, BindGroup1, ENTRY_PASSTHROUGH_FRAGMENT, ENTRY_SUBSURFACE_FRAGMENT, ENTRY_SUBSURFACE_VERTEX,
};
use crate::error::ResizeError;
use crate::kernel::SubsurfaceKernel;
use crate::material_table::MaterialTable;
use crate::target::{Extent, TRANSLUCENT_STENCIL, Target};
use crate::view::SubsurfaceView;

/// What the pass reads. All views are of one size.
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
    /// Depth-stencil view with [`TRANSLUCENT_STENCIL`] on translucent pixels: others are then not even shaded. Must be
    /// given if and only if the pass was made for a stencil format; it is only read, so it may be the view whose depth
    /// is `depth`.
    pub depth_stencil: Option<&'a wgpu::TextureView>,
}

/// Diffuses irradiance in screen space (Liang et al. 2023, eq. 22), on translucent pixels only.
///
/// ```no_run
/// # use subsurface_runtime::{Extent, SubsurfaceInputs, SubsurfaceKernel, SubsurfacePass, SubsurfaceView, wgpu};
/// # fn frame(
/// #     device: &wgpu::Device, queue: &wgpu::Queue, encoder: &mut wgpu::CommandEncoder, kernel: &SubsurfaceKernel,
/// #     irradiance: &wgpu::TextureView, surface: &wgpu::TextureView, depth: &wgpu::TextureView,
/// #     projection: [[f32; 4]; 4],
/// # ) -> Result<(), subsurface_runtime::ResizeError> {
/// let mut pass = SubsurfacePass::new(device, kernel, wgpu::TextureFormat::Rgba16Float, None);
/// let inputs = SubsurfaceInputs { irradiance, surface, depth, depth_stencil: None };
/// pass.resize(device, Extent::new(1280, 720), &inputs)?;
/// pass.prepare(queue, &SubsurfaceView::from_projection(projection, 720, 1000.0));
/// pass.encode(encoder);
/// let diffused = pass.output().expect("resized above");
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct SubsurfacePass {
    diffuse: wgpu::RenderPipeline,
    /// Copies what the stencil leaves out; without a stencil the one pipeline does both.
    passthrough: Option<wgpu::RenderPipeline>,
    table: MaterialTable,
    uniform: wgpu::Buffer,
    layout: wgpu::BindGroupLayout,
    format: wgpu::TextureFormat,
    bound: Option<Bound>,
}

#[derive(Debug)]
struct Bound {
    size: Extent,
    bind_group: wgpu::BindGroup,
    depth_stencil: Option<wgpu::TextureView>,
    output: Target,
}

impl SubsurfacePass {
    /// Pipelines and layouts: all that does not depend on the frame's size.
    ///
    /// `format` is the output's; `stencil` the format of [`SubsurfaceInputs::depth_stencil`], if there will be one.
    pub fn new(
        device: &wgpu::Device,
        kernel: &SubsurfaceKernel,
        format: wgpu::TextureFormat,
        stencil: Option<wgpu::TextureFormat>,
    ) -> Self {
        let table = MaterialTable::new(device, kernel);
        let layout = BindGroup1::layout(device, "SubsurfacePass layout");
        let module = kernel.shader_module(device);
        let pipeline = |label, entry_point, compare| {
            let entries = (ENTRY_SUBSURFACE_VERTEX, entry_point);
            let layouts = [Some(&table.layout), Some(&layout)];
            let stencil = stencil.map(|format| read_only_stencil(format, compare));
            super::covering_pipeline(device, label, &module, entries, &layouts, format, stencil)
        };
        let diffuse =
            pipeline("SubsurfacePass pipeline", ENTRY_SUBSURFACE_FRAGMENT, wgpu::CompareFunction::Equal);
        let passthrough = stencil.map(|_| {
            let label = "SubsurfacePass passthrough pipeline";
            pipeline(label, ENTRY_PASSTHROUGH_FRAGMENT, wgpu::CompareFunction::NotEqual)
        });
        let uniform = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("SubsurfacePass view"),
            size: size_of::<kernel::SubsurfaceView>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { diffuse, passthrough, table, uniform, layout, format, bound: None }
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
        match (&self.passthrough, inputs.depth_stencil) {
            (Some(_), None) => return Err(ResizeError::StencilMissing),
            (None, Some(_)) => return Err(ResizeError::StencilUnexpected),
            _ => {}
        }
        let output = match self.bound.take_if(|bound| bound.size == size) {
            Some(bound) => bound.output,
            None => Target::new(device, size, self.format, "SubsurfacePass output")?,
        };
        let bind_group = BindGroup1 {
            subsurface_view: self.uniform.as_entire_buffer_binding(),
            irradiance_texture: inputs.irradiance,
            surface_texture: inputs.surface,
            depth_texture: inputs.depth,
        }
        .create(device, &self.layout, "SubsurfacePass bind group");
        self.bound = Some(Bound { size, bind_group, depth_stencil: inputs.depth_stencil.cloned(), output });
        Ok(())
    }

    /// Uploads this frame's parameters.
    pub fn prepare(&mut self, queue: &wgpu::Queue, view: &SubsurfaceView) {
        queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&view.uniform()));
    }

    /// Records the pass. Submits nothing; before the first [`resize`](Self::resize) there is nothing to record.
    pub fn encode(&self, encoder: &mut wgpu::CommandEncoder) {
        let Some(bound) = &self.bound else { return };
        let depth_stencil_attachment = bound.depth_stencil.as_ref().map(|view| {
            // No operations: both aspects are read-only, so the depth may be sampled meanwhile.
            wgpu::RenderPassDepthStencilAttachment { view, depth_ops: None, stencil_ops: None }
        });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("SubsurfacePass"),
            color_attachments: &[super::cleared(&bound.output.view, wgpu::Color::TRANSPARENT)],
            depth_stencil_attachment,
            ..Default::default()
        });
        pass.set_bind_group(0, &self.table.bind_group, &[]);
        pass.set_bind_group(BindGroup1::INDEX, &bound.bind_group, &[]);
        if self.passthrough.is_some() {
            pass.set_stencil_reference(TRANSLUCENT_STENCIL);
        }
        for pipeline in std::iter::once(&self.diffuse).chain(&self.passthrough) {
            pass.set_pipeline(pipeline);
            pass.draw(0..3, 0..1);
        }
    }

    /// The diffused irradiance; `None` before the first [`resize`](Self::resize).
    pub fn output(&self) -> Option<&Target> {
        self.bound.as_ref().map(|bound| &bound.output)
    }
}

/// Tests the translucent bit and writes nothing.
fn read_only_stencil(format: wgpu::TextureFormat, compare: wgpu::CompareFunction) -> wgpu::DepthStencilState {
    let face = wgpu::StencilFaceState {
        compare,
        fail_op: wgpu::StencilOperation::Keep,
        depth_fail_op: wgpu::StencilOperation::Keep,
        pass_op: wgpu::StencilOperation::Keep,
    };
    wgpu::DepthStencilState {
        format,
        depth_write_enabled: Some(false),
        depth_compare: Some(wgpu::CompareFunction::Always),
        stencil: wgpu::StencilState {
            front: face,
            back: face,
            read_mask: TRANSLUCENT_STENCIL,
            write_mask: 0,
        },
        bias: Default::default(),
    }
}
