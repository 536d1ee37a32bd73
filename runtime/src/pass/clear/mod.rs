//! What is clear, over a picture of what is not.

mod exit;
mod levels;

use crate::Vertex;
use crate::bind_error::BindError;
use crate::bindings::clear::{
    BindGroup0, BindGroup1, ClearFrame, ENTRY_CLEAR_FRAGMENT, ENTRY_CLEAR_VERTEX, WGSL,
};
use crate::environment::Environment;
use crate::extent::Extent;
use crate::frame_error::FrameError;
use crate::gbuffer::GBuffer;
use crate::input::{Holds, Input};
use crate::label::Label;
use crate::light::LightBuffer;
use crate::object::Object;
use crate::output::{Output, Progress};
use crate::target::Target;
use crate::wgpu;
use crate::wgpu_version::vertex_buffer;

use super::gbuffer::GBufferView;
use super::{attachment, uniform_buffer};
use exit::{EXIT_FORMAT, Exit};
use levels::{Halving, Levels};

const NAME: &str = "ClearPass";

/// Format of the pass's own depth.
const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// How a [`ClearPass`] is made.
#[derive(Clone, Debug, Default)]
pub struct ClearDescriptor<'a> {
    /// What the labels of its objects begin with; `None`, the default, for `ClearPass`.
    pub label: Option<&'a str>,
    /// Where compiled pipelines are kept; by default nowhere.
    pub pipeline_cache: Option<&'a wgpu::PipelineCache>,
}

/// Draws objects that are clear over a picture of linear radiance: what they reflect, and what is behind them, refracted,
/// blurred by their roughness and coloured by what they absorb.
///
/// Where several stand behind each other the nearest is drawn, and light goes from it to where it leaves the last. They
/// cast no shadow, and shadows do not fall on them.
#[derive(Debug)]
pub struct ClearPass {
    label: Label,
    device: wgpu::Device,
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    exit: Exit,
    halving: Halving,
    uniform: wgpu::Buffer,
    lights: LightBuffer,
    sampler: wgpu::Sampler,
    environment: Environment,
    has_environment: bool,
    bound: Option<Bound>,
    progress: Progress,
}

#[derive(Debug)]
struct Bound {
    behind: Levels,
    exit: Target,
    depth: Target,
    opaque_depth: wgpu::TextureView,
    group: wgpu::BindGroup,
}

impl ClearPass {
    /// Format of the picture that it draws over.
    pub const FORMAT: wgpu::TextureFormat = GBuffer::COLOUR_FORMAT;

    /// Pipelines and layouts.
    pub fn new(device: &wgpu::Device, descriptor: &ClearDescriptor<'_>) -> Self {
        let label = Label::new(descriptor.label, NAME);
        let cache = descriptor.pipeline_cache;
        let layout = BindGroup0::layout(device, &label.of("layout"));
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some(&label.of("sampler")),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        Self {
            device: device.clone(),
            pipeline: pipeline(device, &label, &layout, cache),
            layout,
            exit: Exit::new(device, &label, cache),
            halving: Halving::new(device, &label, Self::FORMAT, cache),
            uniform: uniform_buffer::<ClearFrame>(device, &label.of("frame")),
            lights: LightBuffer::new(device, label.of("lights")),
            sampler,
            environment: Environment::darkness(device),
            has_environment: false,
            bound: None,
            progress: Progress::default(),
            label,
        }
    }

    /// Binds the depth of what is opaque, [`GBuffer::depth`]; makes targets of its size.
    ///
    /// # Errors
    /// A texture that holds no depth. The old one stays.
    pub fn bind(&mut self, device: &wgpu::Device, opaque_depth: &wgpu::TextureView) -> Result<(), BindError> {
        let size = Input::new("opaque_depth", opaque_depth).check(device, Holds::Numbers)?.size();
        let target = |format, name| {
            let written = wgpu::TextureUsages::RENDER_ATTACHMENT;
            Target::of_checked_size(device, size, format, written, &self.label.of(name))
        };
        let behind = self.halving.levels(device, &self.label, size, Self::FORMAT);
        let (exit, depth) = (target(EXIT_FORMAT, "exit"), target(DEPTH_FORMAT, "depth"));
        let group = self.group(&behind, &exit, opaque_depth);
        self.bound = Some(Bound { behind, exit, depth, opaque_depth: opaque_depth.clone(), group });
        self.progress = Progress::Bound;
        Ok(())
    }

    fn group(&self, behind: &Levels, exit: &Target, opaque_depth: &wgpu::TextureView) -> wgpu::BindGroup {
        BindGroup0 {
            clear_frame: self.uniform.as_entire_buffer_binding(),
            clear_lights: self.lights.binding(),
            behind_texture: &behind.view,
            behind_sampler: &self.sampler,
            opaque_depth_texture: opaque_depth,
            exit_texture: &exit.view,
            clear_environment_radiance: self.environment.radiance(),
            clear_environment_sampler: self.environment.sampler(),
        }
        .create(&self.device, &self.layout, &self.label.of("bind group"))
    }

    fn rebind(&mut self) {
        if let Some(bound) = self.bound.take() {
            let group = self.group(&bound.behind, &bound.exit, &bound.opaque_depth);
            self.bound = Some(Bound { group, ..bound });
        }
    }

    /// Reflects an environment and shows it where nothing else is behind, or none.
    pub fn set_environment(&mut self, environment: Option<Environment>) {
        self.has_environment = environment.is_some();
        self.environment = environment.unwrap_or_else(|| Environment::darkness(&self.device));
        self.rebind();
    }

    /// Uploads this frame's camera and lights: the view of the G-buffer pass.
    ///
    /// # Errors
    /// Nothing is bound.
    pub fn prepare(&mut self, queue: &wgpu::Queue, view: &GBufferView<'_>) -> Result<(), FrameError> {
        if self.bound.is_none() {
            return Err(FrameError::NotBound { pass: NAME });
        }
        if self.lights.upload(&self.device, queue, view) {
            self.rebind();
        }
        let projection =
            glam::Mat4::from_cols_array_2d(&view.camera.projection(view.size.aspect(), &view.bounds));
        let view_from_world = view.camera.view_from_world();
        let clip_from_world = (projection * view_from_world).to_cols_array_2d();
        // Darkness would be seen through what is clear, in place of the background.
        let intensity = if self.has_environment { view.environment_intensity } else { 0.0 };
        let environment = self.environment.uniform(intensity, view.environment_turn_radians);
        let frame = ClearFrame {
            clip_from_world,
            camera_position: view.camera.position,
            light_count: view.lights.len() as u32,
            forward: (-view_from_world.row(2).truncate()).to_array(),
            // Reversed and infinite: depth = near/distance.
            near: projection.w_axis.z,
            ambient_irradiance: view.ambient_irradiance,
            millimetres_per_world_unit: view.millimetres_per_world_unit,
            // One type by two names: each module has its own.
            environment: bytemuck::cast(environment),
            pixels_at_one: 0.5 * projection.y_axis.y * view.size.height as f32,
            padding_276: [0; 12],
        };
        queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&frame));
        self.exit.prepare(queue, clip_from_world, view.camera.position);
        self.progress = Progress::Prepared;
        Ok(())
    }

    /// Records the pass over `picture`: linear radiance of the format [`FORMAT`](Self::FORMAT) and of the depth's size,
    /// which can be copied. Does nothing where no object is clear.
    ///
    /// # Errors
    /// A pass that is not bound and prepared, or a picture that it cannot draw over.
    pub fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        objects: &[Object],
        picture: &Target,
    ) -> Result<(), FrameError> {
        self.progress.is_prepared(NAME)?;
        let Some(bound) = &self.bound else { return Err(FrameError::NotBound { pass: NAME }) };
        let size = Extent::of(&bound.exit.texture);
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC;
        Output { pass: NAME, size, format: Self::FORMAT, usage }.check(&picture.view)?;
        if !objects.iter().any(Object::is_clear) {
            return Ok(());
        }
        let first_level = bound.behind.texture.as_image_copy();
        let extent = wgpu::Extent3d { width: size.width, height: size.height, depth_or_array_layers: 1 };
        encoder.copy_texture_to_texture(picture.texture.as_image_copy(), first_level, extent);
        let label = self.label.as_str();
        self.halving.encode(encoder, label, &bound.behind);
        self.exit.encode(encoder, label, objects, [&bound.exit, &bound.depth]);
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(label),
            color_attachments: &[attachment(&picture.view, wgpu::LoadOp::Load)],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &bound.depth.view,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(0.0),
                    store: wgpu::StoreOp::Discard,
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &bound.group, &[]);
        for object in objects {
            let Some(group) = &object.clear_group else { continue };
            pass.set_bind_group(BindGroup1::INDEX, group, &[]);
            object.geometry.draw(&mut pass);
        }
        Ok(())
    }
}

fn pipeline(
    device: &wgpu::Device,
    label: &Label,
    layout: &wgpu::BindGroupLayout,
    cache: Option<&wgpu::PipelineCache>,
) -> wgpu::RenderPipeline {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(&label.of("module")),
        source: wgpu::ShaderSource::Wgsl(WGSL.into()),
    });
    let object_layout = BindGroup1::layout(device, &label.of("object layout"));
    let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(&label.of("pipeline layout")),
        bind_group_layouts: &[Some(layout), Some(&object_layout)],
        immediate_size: 0,
    });
    let vertices = wgpu::VertexBufferLayout { attributes: &Vertex::LAYOUT.attributes[..2], ..Vertex::LAYOUT };
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(&label.of("pipeline")),
        layout: Some(&pipeline_layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some(ENTRY_CLEAR_VERTEX),
            compilation_options: Default::default(),
            buffers: &[vertex_buffer(vertices)],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH_FORMAT,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Greater),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some(ENTRY_CLEAR_FRAGMENT),
            compilation_options: Default::default(),
            targets: &[Some(ClearPass::FORMAT.into())],
        }),
        multiview_mask: None,
        cache,
    })
}
