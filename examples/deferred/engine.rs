//! The renderer that the pass is put into. None of it knows of subsurface scattering.

use subsurface::runtime::wgpu::{self, util::DeviceExt as _};
use subsurface::runtime::{Extent, Target, bytemuck};

const RINGS: u32 = 96;
const FOV_Y_RADIANS: f32 = 0.3;
const NEAR_CENTIMETRES: f32 = 1.0;

/// A sphere in view space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ball {
    pub(crate) centre: [f32; 3],
    pub(crate) radius: f32,
    pub(crate) albedo: [f32; 3],
    pub(crate) material: u32,
}

/// Targets and pipelines.
#[derive(Debug)]
pub(crate) struct Engine {
    size: Extent,
    pub(crate) albedo: Target,
    normal: Target,
    pub(crate) material: Target,
    pub(crate) depth_stencil: Target,
    pub(crate) depth: wgpu::TextureView,
    pub(crate) irradiance: Target,
    balls: [Ball; 3],
    gbuffer_pipeline: wgpu::RenderPipeline,
    gbuffer_scene: wgpu::BindGroup,
    light_pipeline: wgpu::RenderPipeline,
    light_scene: wgpu::BindGroup,
    light_group: wgpu::BindGroup,
    resolve_pipeline: wgpu::RenderPipeline,
}

impl Engine {
    /// Marks what no material of the kernel covers.
    pub(crate) const NO_MATERIAL: u32 = 255;
    pub(crate) const DEPTH_STENCIL_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth24PlusStencil8;
    pub(crate) const LIGHT_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
    pub(crate) const PICTURE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;
    const ALBEDO_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
    const NORMAL_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
    const MATERIAL_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R8Uint;

    pub(crate) fn new(device: &wgpu::Device, size: Extent, balls: [Ball; 3]) -> Self {
        let target = |format, label| Target::new(device, size, format, label).expect("a small frame");
        let depth_stencil = target(Self::DEPTH_STENCIL_FORMAT, "engine depth-stencil");
        let depth = depth_stencil.texture.create_view(&wgpu::TextureViewDescriptor {
            aspect: wgpu::TextureAspect::DepthOnly,
            ..Default::default()
        });
        let (albedo, normal) =
            (target(Self::ALBEDO_FORMAT, "engine albedo"), target(Self::NORMAL_FORMAT, "engine normal"));
        let module = device.create_shader_module(wgpu::include_wgsl!("engine.wgsl"));
        let pipeline = |entries: [&str; 2], targets: &[wgpu::TextureFormat], depth_stencil| {
            let targets: Vec<_> = targets.iter().map(|format| Some((*format).into())).collect();
            device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some(entries[1]),
                layout: None,
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some(entries[0]),
                    compilation_options: Default::default(),
                    buffers: &[],
                },
                primitive: Default::default(),
                depth_stencil,
                multisample: Default::default(),
                fragment: Some(wgpu::FragmentState {
                    module: &module,
                    entry_point: Some(entries[1]),
                    compilation_options: Default::default(),
                    targets: &targets,
                }),
                multiview_mask: None,
                cache: None,
            })
        };
        let gbuffer = [Self::ALBEDO_FORMAT, Self::NORMAL_FORMAT, Self::MATERIAL_FORMAT];
        let gbuffer_pipeline = pipeline(["ball_vertex", "ball_fragment"], &gbuffer, Some(marking_stencil()));
        let light_pipeline = pipeline(["screen_vertex", "light_fragment"], &[Self::LIGHT_FORMAT], None);
        let resolve_pipeline = pipeline(["screen_vertex", "resolve_fragment"], &[Self::PICTURE_FORMAT], None);
        let scene = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("engine scene"),
            contents: bytemuck::cast_slice(&scene(size, &balls)),
            usage: wgpu::BufferUsages::UNIFORM,
        });
        let [gbuffer_scene, light_scene] = [&gbuffer_pipeline, &light_pipeline]
            .map(|pipeline| group(device, pipeline, 0, &[scene.as_entire_binding()]));
        let light_group = group(device, &light_pipeline, 1, &[view(&albedo.view), view(&normal.view)]);
        Self {
            size,
            albedo,
            normal,
            material: target(Self::MATERIAL_FORMAT, "engine material"),
            depth_stencil,
            depth,
            irradiance: target(Self::LIGHT_FORMAT, "engine irradiance"),
            balls,
            gbuffer_pipeline,
            gbuffer_scene,
            light_pipeline,
            light_scene,
            light_group,
            resolve_pipeline,
        }
    }

    /// Columns of an infinite projection whose depth runs from 1 at the near plane to 0.
    pub(crate) fn clip_from_view(&self) -> [[f32; 4]; 4] {
        projection(self.size)
    }

    pub(crate) fn draw_gbuffer(&self, encoder: &mut wgpu::CommandEncoder) {
        let nothing = wgpu::Color { r: f64::from(Self::NO_MATERIAL), ..wgpu::Color::TRANSPARENT };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("engine G-buffer"),
            color_attachments: &[
                cleared(&self.albedo.view, wgpu::Color::TRANSPARENT),
                cleared(&self.normal.view, wgpu::Color::TRANSPARENT),
                cleared(&self.material.view, nothing),
            ],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depth_stencil.view,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(0.0),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(0),
                    store: wgpu::StoreOp::Store,
                }),
            }),
            ..Default::default()
        });
        pass.set_pipeline(&self.gbuffer_pipeline);
        pass.set_bind_group(0, &self.gbuffer_scene, &[]);
        for (index, ball) in (0..).zip(&self.balls) {
            // The stencil's first bit marks what scatters; the others are the engine's own.
            pass.set_stencil_reference(if ball.material == Self::NO_MATERIAL { 0b10 } else { 0b11 });
            pass.draw(0..6 * RINGS * RINGS, index..index + 1);
        }
    }

    pub(crate) fn draw_light(&self, encoder: &mut wgpu::CommandEncoder) {
        let mut pass = screen_pass(encoder, &self.irradiance.view);
        pass.set_pipeline(&self.light_pipeline);
        pass.set_bind_group(0, &self.light_scene, &[]);
        pass.set_bind_group(1, &self.light_group, &[]);
        pass.draw(0..3, 0..1);
    }

    pub(crate) fn resolve(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        light: &wgpu::TextureView,
        picture: &wgpu::TextureView,
    ) {
        let layout = self.resolve_pipeline.get_bind_group_layout(1);
        let entries = [(0, &self.albedo.view), (2, light)].map(|(binding, view)| wgpu::BindGroupEntry {
            binding,
            resource: wgpu::BindingResource::TextureView(view),
        });
        let descriptor =
            wgpu::BindGroupDescriptor { label: Some("engine"), layout: &layout, entries: &entries };
        let group = device.create_bind_group(&descriptor);
        let mut pass = screen_pass(encoder, picture);
        pass.set_pipeline(&self.resolve_pipeline);
        pass.set_bind_group(1, &group, &[]);
        pass.draw(0..3, 0..1);
    }
}

fn screen_pass<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    target: &wgpu::TextureView,
) -> wgpu::RenderPass<'a> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("engine screen"),
        color_attachments: &[cleared(target, wgpu::Color::TRANSPARENT)],
        ..Default::default()
    })
}

/// The uniform of the shaders.
fn scene(size: Extent, balls: &[Ball; 3]) -> Vec<f32> {
    let mut words: Vec<f32> = projection(size).into_iter().flatten().collect();
    // Light from the upper left and behind, so that most of what is seen is its border with the shadow.
    let (towards_light, light, ambient) = ([-0.80, 0.36, -0.48], 8.0, 0.05);
    words.extend(towards_light);
    words.extend([light, ambient, 0.0, 0.0, 0.0]);
    for ball in balls {
        words.extend(ball.centre);
        words.push(ball.radius);
        words.extend(ball.albedo);
        words.push(f32::from_bits(ball.material));
    }
    words
}

fn projection(size: Extent) -> [[f32; 4]; 4] {
    let focal = 1.0 / (0.5 * FOV_Y_RADIANS).tan();
    [
        [focal / size.aspect(), 0.0, 0.0, 0.0],
        [0.0, focal, 0.0, 0.0],
        [0.0, 0.0, 0.0, -1.0],
        [0.0, 0.0, NEAR_CENTIMETRES, 0.0],
    ]
}

/// Nearer is more, and the stencil takes the reference.
fn marking_stencil() -> wgpu::DepthStencilState {
    let face =
        wgpu::StencilFaceState { pass_op: wgpu::StencilOperation::Replace, ..wgpu::StencilFaceState::IGNORE };
    wgpu::DepthStencilState {
        format: Engine::DEPTH_STENCIL_FORMAT,
        depth_write_enabled: Some(true),
        depth_compare: Some(wgpu::CompareFunction::Greater),
        stencil: wgpu::StencilState { front: face, back: face, read_mask: !0, write_mask: !0 },
        bias: Default::default(),
    }
}

fn cleared(view: &wgpu::TextureView, colour: wgpu::Color) -> Option<wgpu::RenderPassColorAttachment<'_>> {
    Some(wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations { load: wgpu::LoadOp::Clear(colour), store: wgpu::StoreOp::Store },
    })
}

fn view(view: &wgpu::TextureView) -> wgpu::BindingResource<'_> {
    wgpu::BindingResource::TextureView(view)
}

/// A group of the resources at bindings 0, 1, …
fn group(
    device: &wgpu::Device,
    pipeline: &wgpu::RenderPipeline,
    index: u32,
    resources: &[wgpu::BindingResource<'_>],
) -> wgpu::BindGroup {
    let layout = pipeline.get_bind_group_layout(index);
    let entries: Vec<_> = (0..)
        .zip(resources)
        .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource: resource.clone() })
        .collect();
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("engine"),
        layout: &layout,
        entries: &entries,
    })
}
