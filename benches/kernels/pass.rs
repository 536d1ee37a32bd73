//! The pipeline that all baselines share: `baseline.wgsl` with a method's own text.

use subsurface::runtime::{FrameError, Path, bytemuck, wgpu};
use subsurface_cli::failure::Failure;
use subsurface_cli::kernel_bench::{Run, Stage};
use wgpu::util::DeviceExt as _;

/// `Settings` in `baseline.wgsl`.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Settings {
    /// Burley's d per channel, mm; zeros where the method does not ask for it.
    pub(crate) scattering_distance_mm: [f64; 3],
    /// Radius beyond which nothing is read, mm.
    pub(crate) reach_mm: f64,
    /// Taps, or the most of them.
    pub(crate) taps: u32,
    /// Of methods with two passes: 0 along x, 1 along y.
    pub(crate) axis: u32,
}

impl Settings {
    /// As WGSL lays it out: a vec3f with a number behind it, a vec2f and two numbers.
    fn words(self, stage: &Stage<'_>) -> [u32; 8] {
        let view = stage.case.view();
        let offset = view.millimetres_per_pixel(0.0);
        let slope = view.millimetres_per_pixel(1.0) - offset;
        let [red, green, blue] = self.scattering_distance_mm.map(|d| (d as f32).to_bits());
        let reach = (self.reach_mm as f32).to_bits();
        [red, green, blue, reach, offset.to_bits(), slope.to_bits(), self.taps, self.axis]
    }
}

/// A method on a stage: one full-screen pass for each of the settings, each reading what the one before has written.
pub(crate) struct Pass {
    pipeline: Pipeline,
    steps: Vec<Step>,
    groups: [u32; 2],
}

enum Pipeline {
    Compute(wgpu::ComputePipeline),
    Fragment(wgpu::RenderPipeline),
}

struct Step {
    bind_group: wgpu::BindGroup,
    texture: wgpu::Texture,
    view: wgpu::TextureView,
}

/// Edge of a workgroup in `baseline.wgsl`.
const WORKGROUP: u32 = 8;

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

impl Pass {
    /// The method whose `gather` stands in `text`; `table` is what it has computed before, at least one entry.
    pub(crate) fn new(
        stage: &Stage<'_>,
        text: &str,
        table: &[[f32; 4]],
        settings: &[Settings],
    ) -> Result<Self, Failure> {
        let device = &stage.device.device;
        let path = stage.route.path.unwrap_or(Path::Compute);
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("baseline"),
            source: wgpu::ShaderSource::Wgsl(format!("{}\n{text}", include_str!("baseline.wgsl")).into()),
        });
        let layout = layout(device, path);
        let pipeline = pipeline(device, path, &module, &layout);
        let table = buffer(device, bytemuck::cast_slice(table), wgpu::BufferUsages::STORAGE);
        let size = stage.textures.size;
        let mut steps: Vec<Step> = Vec::new();
        for settings in settings {
            let words = settings.words(stage);
            let uniform = buffer(device, bytemuck::cast_slice(&words), wgpu::BufferUsages::UNIFORM);
            let texture = device.create_texture(&wgpu::TextureDescriptor {
                label: Some("baseline output"),
                size: size.into(),
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: FORMAT,
                usage: wgpu::TextureUsages::TEXTURE_BINDING
                    | wgpu::TextureUsages::STORAGE_BINDING
                    | wgpu::TextureUsages::RENDER_ATTACHMENT
                    | wgpu::TextureUsages::COPY_SRC,
                view_formats: &[],
            });
            let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
            let irradiance = steps.last().map_or(&stage.textures.irradiance.view, |step| &step.view);
            let mut entries = vec![
                entry(0, uniform.as_entire_binding()),
                entry(1, texture_view(irradiance)),
                entry(2, texture_view(&stage.textures.distance.view)),
                entry(3, texture_view(&stage.textures.surface.view)),
                entry(4, table.as_entire_binding()),
            ];
            if path == Path::Compute {
                entries.push(entry(5, texture_view(&view)));
            }
            let bind_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("baseline"),
                layout: &layout,
                entries: &entries,
            });
            steps.push(Step { bind_group, texture, view });
        }
        if steps.is_empty() {
            return Err(Failure::new("a baseline without a pass", "please report this as a defect"));
        }
        let groups = [size.width, size.height].map(|edge| edge.div_ceil(WORKGROUP));
        Ok(Self { pipeline, steps, groups })
    }
}

fn entry(binding: u32, resource: wgpu::BindingResource<'_>) -> wgpu::BindGroupEntry<'_> {
    wgpu::BindGroupEntry { binding, resource }
}

fn texture_view(view: &wgpu::TextureView) -> wgpu::BindingResource<'_> {
    wgpu::BindingResource::TextureView(view)
}

fn buffer(device: &wgpu::Device, contents: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
    device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some("baseline"), contents, usage })
}

fn layout(device: &wgpu::Device, path: Path) -> wgpu::BindGroupLayout {
    let visibility = match path {
        Path::Compute => wgpu::ShaderStages::COMPUTE,
        Path::Fragment => wgpu::ShaderStages::FRAGMENT,
    };
    let entry = |binding, ty| wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None };
    let buffer = |ty| wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None };
    let texture = wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: false },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    let mut entries = vec![
        entry(0, buffer(wgpu::BufferBindingType::Uniform)),
        entry(1, texture),
        entry(2, texture),
        entry(3, texture),
        entry(4, buffer(wgpu::BufferBindingType::Storage { read_only: true })),
    ];
    if path == Path::Compute {
        let target = wgpu::BindingType::StorageTexture {
            access: wgpu::StorageTextureAccess::WriteOnly,
            format: FORMAT,
            view_dimension: wgpu::TextureViewDimension::D2,
        };
        entries.push(entry(5, target));
    }
    let label = Some("baseline");
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label, entries: &entries })
}

fn pipeline(
    device: &wgpu::Device,
    path: Path,
    module: &wgpu::ShaderModule,
    layout: &wgpu::BindGroupLayout,
) -> Pipeline {
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("baseline"),
        bind_group_layouts: &[Some(layout)],
        immediate_size: 0,
    });
    if path == Path::Compute {
        return Pipeline::Compute(device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("baseline"),
            layout: Some(&layout),
            module,
            entry_point: Some("baseline_compute"),
            compilation_options: Default::default(),
            cache: None,
        }));
    }
    Pipeline::Fragment(device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("baseline"),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some("baseline_vertex"),
            compilation_options: Default::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some("baseline_fragment"),
            compilation_options: Default::default(),
            targets: &[Some(FORMAT.into())],
        }),
        multiview_mask: None,
        cache: None,
    }))
}

impl Run for Pass {
    fn encode(&self, encoder: &mut wgpu::CommandEncoder) -> Result<(), FrameError> {
        for step in &self.steps {
            match &self.pipeline {
                Pipeline::Compute(pipeline) => {
                    let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
                    pass.set_pipeline(pipeline);
                    pass.set_bind_group(0, &step.bind_group, &[]);
                    pass.dispatch_workgroups(self.groups[0], self.groups[1], 1);
                }
                Pipeline::Fragment(pipeline) => {
                    let load = wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT);
                    let attachment = wgpu::RenderPassColorAttachment {
                        view: &step.view,
                        depth_slice: None,
                        resolve_target: None,
                        ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
                    };
                    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                        label: Some("baseline"),
                        color_attachments: &[Some(attachment)],
                        ..Default::default()
                    });
                    pass.set_pipeline(pipeline);
                    pass.set_bind_group(0, &step.bind_group, &[]);
                    pass.draw(0..3, 0..1);
                }
            }
        }
        Ok(())
    }

    fn output(&self) -> &wgpu::Texture {
        // `new` makes at least one step.
        &self.steps[self.steps.len() - 1].texture
    }

    fn path(&self) -> Path {
        match self.pipeline {
            Pipeline::Compute(_) => Path::Compute,
            Pipeline::Fragment(_) => Path::Fragment,
        }
    }
}
