//! The compute path: tiles without translucent pixels are copied and left out of all that follows.

use std::sync::{Mutex, PoisonError};

use crate::bindings::kernel::{
    BindGroup1, ENTRY_CLASSIFY_COMPUTE, ENTRY_FIRST_COMPUTE, ENTRY_SUBSURFACE_COMPUTE,
    ENTRY_SUBSURFACE_SOFTWARE_COMPUTE, SubsurfaceComputeBindGroup2, WORKGROUP_CLASSIFY_COMPUTE,
};
use crate::extent::Extent;
use crate::loaded_kernel::LoadedKernel;
use crate::pass::PassError;
use crate::target::Target;
use crate::texture_format::{output_format, texture_format};
use crate::wgpu::{self, util::DeviceExt as _};
use subsurface_kernel::{ComputeShape, Estimator, OutputFormat};

use super::descriptor::Settings;
use super::intermediate::{Intermediate, coarse_pixels, first_stage, packed_pixels};

/// Outputs whose bind groups are kept: frames in flight rarely write to more.
const OUTPUTS_KEPT: usize = 4;

/// Side of a tile, pixels: an invocation of the classification takes 2×2 of them.
const TILE_SIDE: u32 = 2 * WORKGROUP_CLASSIFY_COMPUTE[0];

/// Workgroups along x, y and z before a tile is listed.
const NO_DISPATCH: [u32; 3] = [0, 0, 1];

/// Pipelines.
#[derive(Debug)]
pub(super) struct ComputePath {
    estimator: Estimator,
    /// `None` if the estimator has one shape for all devices.
    shape: Option<ComputeShape>,
    classify: wgpu::ComputePipeline,
    first: Option<wgpu::ComputePipeline>,
    diffuse: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
    no_dispatch: wgpu::Buffer,
}

/// What depends on the frame's size.
#[derive(Debug)]
pub(super) struct ComputeFrame {
    resources: Resources,
    tile_columns: u32,
    tile_rows: u32,
    /// Bind groups of the latest outputs, the latest first. They hold on to these outputs until the pass is bound again.
    outputs: Mutex<Vec<OutputGroups>>,
}

/// Textures and lists between the stages.
#[derive(Debug)]
struct Resources {
    device: wgpu::Device,
    layout: wgpu::BindGroupLayout,
    first: Option<Target>,
    pixels: Target,
    coarse: Target,
    // A texture that is written may not be read in the same dispatch, so what is left unused has its own.
    nothing: Target,
    unused_four_words: Target,
    unused_two_words: Target,
    unused_pixels: Target,
    tiles: wgpu::Buffer,
    dispatch: wgpu::Buffer,
    unused_dispatch: wgpu::Buffer,
    labels: [String; 3],
}

/// Bind groups of the stages for one output.
#[derive(Debug)]
struct OutputGroups {
    output: wgpu::TextureView,
    classify: wgpu::BindGroup,
    first: wgpu::BindGroup,
    second: wgpu::BindGroup,
}

impl ComputePath {
    pub(super) fn new(
        device: &wgpu::Device,
        kernel: &LoadedKernel,
        settings: &Settings,
        groups: [&wgpu::BindGroupLayout; 2],
    ) -> Result<Self, PassError> {
        let format = settings.format;
        let module = output_format(format).and_then(|output| kernel.shader_module_for(device, output));
        let module = module.ok_or(PassError::Format { kernel: kernel.own_format(), output: format })?;
        let label = &settings.label;
        let layout = layout(device, &label.of("compute layout"), format);
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(&label.of("compute pipeline layout")),
            bind_group_layouts: &[Some(groups[0]), Some(groups[1]), Some(&layout)],
            immediate_size: 0,
        });
        let pipeline = |stage, entry_point| {
            device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(&label.of(stage)),
                layout: Some(&pipeline_layout),
                module,
                entry_point: Some(entry_point),
                compilation_options: wgpu::PipelineCompilationOptions {
                    constants: settings.constants(),
                    // The stages write what they read.
                    zero_initialize_workgroup_memory: false,
                },
                cache: settings.pipeline_cache.as_ref(),
            })
        };
        let estimator = kernel.estimator();
        let shape = estimator.has_software_shape().then(|| settings.shape(device));
        let diffuse = match shape {
            Some(ComputeShape::Software) => ENTRY_SUBSURFACE_SOFTWARE_COMPUTE,
            Some(ComputeShape::Hardware) | None => ENTRY_SUBSURFACE_COMPUTE,
        };
        let first = estimator.has_two_stages().then(|| pipeline("first stage", ENTRY_FIRST_COMPUTE));
        let no_dispatch = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some(&label.of("empty dispatch")),
            contents: bytemuck::cast_slice(&NO_DISPATCH),
            usage: wgpu::BufferUsages::COPY_SRC,
        });
        Ok(Self {
            estimator,
            shape,
            classify: pipeline("classification", ENTRY_CLASSIFY_COMPUTE),
            first,
            diffuse: pipeline("stage", diffuse),
            layout,
            no_dispatch,
        })
    }

    pub(super) fn shape(&self) -> Option<ComputeShape> {
        self.shape
    }

    /// Textures and lists for viewports of `size`.
    pub(super) fn frame(&self, device: &wgpu::Device, settings: &Settings, size: Extent) -> ComputeFrame {
        let usage = wgpu::TextureUsages::STORAGE_BINDING;
        let label = &settings.label;
        let target = |texture: Intermediate| texture.target(device, label, size, usage);
        let unused = |format, name| target(Intermediate::single(format, name));
        let (tile_columns, tile_rows) = (size.width.div_ceil(TILE_SIDE), size.height.div_ceil(TILE_SIDE));
        let buffer = |name, words: u32, usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(&label.of(name)),
                size: u64::from(words) * 4,
                usage: usage | wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let none = wgpu::BufferUsages::empty();
        let resources = Resources {
            device: device.clone(),
            layout: self.layout.clone(),
            first: first_stage(self.estimator).map(target),
            pixels: target(packed_pixels(self.estimator)),
            coarse: target(coarse_pixels(self.estimator)),
            nothing: unused(wgpu::TextureFormat::Rg32Uint, "nothing"),
            unused_four_words: unused(wgpu::TextureFormat::Rgba32Uint, "unused four words"),
            unused_two_words: unused(wgpu::TextureFormat::Rg32Uint, "unused two words"),
            unused_pixels: unused(wgpu::TextureFormat::Rg32Uint, "unused pixels"),
            tiles: buffer("tiles", 1 + tile_columns * tile_rows, none),
            dispatch: buffer("dispatch", 3, wgpu::BufferUsages::INDIRECT),
            unused_dispatch: buffer("unused dispatch", 3, none),
            labels: ["classification bind group", "first stage bind group", "stage bind group"]
                .map(|group| label.of(group)),
        };
        ComputeFrame { resources, tile_columns, tile_rows, outputs: Mutex::default() }
    }

    pub(super) fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        settings: &Settings,
        frame: &ComputeFrame,
        groups: [&wgpu::BindGroup; 2],
        output: &wgpu::TextureView,
    ) {
        // What a thread leaves that panicked while it held the list is still a list of groups.
        let mut outputs = frame.outputs.lock().unwrap_or_else(PoisonError::into_inner);
        let of_output = frame.resources.groups_of(&mut outputs, output);
        encoder.clear_buffer(&frame.resources.tiles, 0, None);
        encoder.copy_buffer_to_buffer(&self.no_dispatch, 0, &frame.resources.dispatch, 0, None);
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some(settings.label.as_str()),
            timestamp_writes: settings.timestamps.as_ref().map(|timestamps| timestamps.of_compute_pass()),
        });
        pass.set_bind_group(0, groups[0], &[]);
        pass.set_bind_group(BindGroup1::INDEX, groups[1], &[]);
        pass.set_pipeline(&self.classify);
        pass.set_bind_group(SubsurfaceComputeBindGroup2::INDEX, &of_output.classify, &[]);
        pass.dispatch_workgroups(frame.tile_columns, frame.tile_rows, 1);
        let first = self.first.iter().map(|first| (first, &of_output.first));
        for (pipeline, group) in first.chain([(&self.diffuse, &of_output.second)]) {
            pass.set_pipeline(pipeline);
            pass.set_bind_group(SubsurfaceComputeBindGroup2::INDEX, group, &[]);
            pass.dispatch_workgroups_indirect(&frame.resources.dispatch, 0);
        }
    }
}

impl ComputeFrame {
    /// Lets go of the outputs.
    pub(super) fn forget_outputs(&mut self) {
        self.outputs.get_mut().unwrap_or_else(PoisonError::into_inner).clear();
    }
}

impl Resources {
    /// The groups of `output`, which come to the front of the list.
    fn groups_of<'a>(
        &self,
        known: &'a mut Vec<OutputGroups>,
        output: &wgpu::TextureView,
    ) -> &'a OutputGroups {
        match known.iter().position(|groups| groups.output == *output) {
            Some(place) => known[..=place].rotate_right(1),
            None => {
                known.truncate(OUTPUTS_KEPT - 1);
                known.insert(0, self.groups(output));
            }
        }
        &known[0]
    }

    fn groups(&self, output: &wgpu::TextureView) -> OutputGroups {
        let of_format = |format| self.first.as_ref().filter(|target| target.texture.format() == format);
        let four_words = of_format(wgpu::TextureFormat::Rgba32Uint).unwrap_or(&self.unused_four_words);
        let two_words = of_format(wgpu::TextureFormat::Rg32Uint).unwrap_or(&self.unused_two_words);
        let group = |read: [&Target; 3], written: [&Target; 3], arguments: &wgpu::Buffer, label: &str| {
            SubsurfaceComputeBindGroup2 {
                intermediate_source: &read[0].view,
                coarse_source: &read[1].view,
                pixel_source: &read[2].view,
                four_word_target: &written[0].view,
                two_word_target: &written[1].view,
                pixel_target: &written[2].view,
                tiles: self.tiles.as_entire_buffer_binding(),
                dispatch_arguments: arguments.as_entire_buffer_binding(),
                diffused_target: output,
            }
            .create(&self.device, &self.layout, label)
        };
        let nothing = &self.nothing;
        let [classify, first, second] = &self.labels;
        OutputGroups {
            output: output.clone(),
            classify: group(
                [nothing; 3],
                [&self.unused_four_words, &self.coarse, &self.pixels],
                &self.dispatch,
                classify,
            ),
            first: group(
                [nothing, &self.coarse, &self.pixels],
                [four_words, two_words, &self.unused_pixels],
                &self.unused_dispatch,
                first,
            ),
            second: group(
                [self.first.as_ref().unwrap_or(nothing), &self.coarse, &self.pixels],
                [&self.unused_four_words, &self.unused_two_words, &self.unused_pixels],
                &self.unused_dispatch,
                second,
            ),
        }
    }
}

/// The layout of the stages' textures and lists, with a result of `format`: the bindings know that of a sample.
fn layout(device: &wgpu::Device, label: &str, format: wgpu::TextureFormat) -> wgpu::BindGroupLayout {
    let of_sample = texture_format(OutputFormat::default());
    let mut entries = SubsurfaceComputeBindGroup2::LAYOUT_ENTRIES;
    for entry in &mut entries {
        if let wgpu::BindingType::StorageTexture { format: stored, .. } = &mut entry.ty
            && Some(*stored) == of_sample
        {
            *stored = format;
        }
    }
    device
        .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries: &entries })
}
