//! The compute path: tiles without translucent pixels are copied and left out of all that follows.

use wgpu::util::DeviceExt as _;

use crate::bindings::kernel::{
    BindGroup1, ENTRY_CLASSIFY_COMPUTE, ENTRY_FIRST_COMPUTE, ENTRY_SUBSURFACE_COMPUTE,
    SubsurfaceComputeBindGroup2, WORKGROUP_CLASSIFY_COMPUTE,
};
use crate::error::SizeError;
use crate::target::{Extent, Target};
use subsurface_kernel::Estimator;
use subsurface_kernel::KernelParts;

use crate::kernel_format::texture_format;

use super::intermediate::{Intermediate, intermediates, packed_pixels};

/// Side of a tile, pixels: an invocation of the classification takes 2×2 of them.
const TILE_SIDE: u32 = 2 * WORKGROUP_CLASSIFY_COMPUTE[0];

/// Workgroups along x, y and z before a tile is listed.
const NO_DISPATCH: [u32; 3] = [0, 0, 1];

/// Pipelines.
#[derive(Debug)]
pub(super) struct ComputePath {
    kind: Estimator,
    classify: wgpu::ComputePipeline,
    first: Option<wgpu::ComputePipeline>,
    diffuse: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
    no_dispatch: wgpu::Buffer,
}

/// What depends on the frame's size.
#[derive(Debug)]
pub(super) struct ComputeFrame {
    tiles: wgpu::Buffer,
    dispatch: wgpu::Buffer,
    tile_columns: u32,
    tile_rows: u32,
    classify_group: wgpu::BindGroup,
    first_group: wgpu::BindGroup,
    second_group: wgpu::BindGroup,
}

impl ComputePath {
    pub(super) fn new(
        device: &wgpu::Device,
        kernel: &KernelParts,
        module: &wgpu::ShaderModule,
        groups: [&wgpu::BindGroupLayout; 2],
    ) -> Self {
        let layout = layout(device, kernel);
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("SubsurfacePass compute pipeline layout"),
            bind_group_layouts: &[Some(groups[0]), Some(groups[1]), Some(&layout)],
            immediate_size: 0,
        });
        let pipeline = |label, entry_point| {
            device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(label),
                layout: Some(&pipeline_layout),
                module,
                entry_point: Some(entry_point),
                compilation_options: Default::default(),
                cache: None,
            })
        };
        let kind = kernel.module().estimator();
        let first =
            kind.has_two_stages().then(|| pipeline("SubsurfacePass first stage", ENTRY_FIRST_COMPUTE));
        let no_dispatch = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("SubsurfacePass empty dispatch"),
            contents: bytemuck::cast_slice(&NO_DISPATCH),
            usage: wgpu::BufferUsages::COPY_SRC,
        });
        Self {
            kind,
            classify: pipeline("SubsurfacePass classification", ENTRY_CLASSIFY_COMPUTE),
            first,
            diffuse: pipeline("SubsurfacePass stage", ENTRY_SUBSURFACE_COMPUTE),
            layout,
            no_dispatch,
        }
    }

    /// Textures and lists for frames of `size` whose result goes to `output`.
    pub(super) fn frame(
        &self,
        device: &wgpu::Device,
        size: Extent,
        output: &wgpu::TextureView,
    ) -> Result<ComputeFrame, SizeError> {
        let usage = wgpu::TextureUsages::STORAGE_BINDING;
        let intermediates = intermediates(self.kind)
            .iter()
            .map(|intermediate| intermediate.target(device, size, usage))
            .collect::<Result<Vec<_>, _>>()?;
        let pixels = packed_pixels(self.kind).target(device, size, usage)?;
        // A texture that is written may not be read in the same dispatch, so what is left unused has its own.
        let unused = |format, label| Intermediate::single(format, label).target(device, size, usage);
        let nothing = unused(wgpu::TextureFormat::Rg32Uint, "SubsurfacePass nothing")?;
        let unused_four_words = unused(wgpu::TextureFormat::Rgba32Uint, "SubsurfacePass unused four words")?;
        let unused_two_words = unused(wgpu::TextureFormat::Rg32Uint, "SubsurfacePass unused two words")?;
        let unused_pixels = unused(wgpu::TextureFormat::Rg32Uint, "SubsurfacePass unused pixels")?;
        let find = |format| intermediates.iter().find(|target| target.texture.format() == format);
        let four_words = find(wgpu::TextureFormat::Rgba32Uint).unwrap_or(&unused_four_words);
        let two_words = find(wgpu::TextureFormat::Rg32Uint).unwrap_or(&unused_two_words);

        let (tile_columns, tile_rows) = (size.width.div_ceil(TILE_SIDE), size.height.div_ceil(TILE_SIDE));
        let buffer = |label, words: u32, usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: u64::from(words) * 4,
                usage: usage | wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let none = wgpu::BufferUsages::empty();
        let tiles = buffer("SubsurfacePass tiles", 1 + tile_columns * tile_rows, none);
        let dispatch = buffer("SubsurfacePass dispatch", 3, wgpu::BufferUsages::INDIRECT);
        let unused_dispatch = buffer("SubsurfacePass unused dispatch", 3, none);

        let group = |read: [&Target; 3], written: [&Target; 3], arguments: &wgpu::Buffer, label| {
            SubsurfaceComputeBindGroup2 {
                intermediate_source: &read[0].view,
                second_intermediate_source: &read[1].view,
                pixel_source: &read[2].view,
                four_word_target: &written[0].view,
                two_word_target: &written[1].view,
                pixel_target: &written[2].view,
                tiles: tiles.as_entire_buffer_binding(),
                dispatch_arguments: arguments.as_entire_buffer_binding(),
                diffused_target: output,
            }
            .create(device, &self.layout, label)
        };
        let unread = [&nothing; 3];
        let classify_group = group(
            unread,
            [four_words, &unused_two_words, &pixels],
            &dispatch,
            "SubsurfacePass classification bind group",
        );
        let first_group = group(
            [&nothing, &nothing, &pixels],
            [four_words, two_words, &unused_pixels],
            &unused_dispatch,
            "SubsurfacePass first stage bind group",
        );
        let at = |index: usize| intermediates.get(index).unwrap_or(&nothing);
        let second_group = group(
            [at(0), at(1), &pixels],
            [&unused_four_words, &unused_two_words, &unused_pixels],
            &unused_dispatch,
            "SubsurfacePass stage bind group",
        );
        Ok(ComputeFrame {
            tiles,
            dispatch,
            tile_columns,
            tile_rows,
            classify_group,
            first_group,
            second_group,
        })
    }

    pub(super) fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        frame: &ComputeFrame,
        groups: [&wgpu::BindGroup; 2],
    ) {
        encoder.clear_buffer(&frame.tiles, 0, None);
        encoder.copy_buffer_to_buffer(&self.no_dispatch, 0, &frame.dispatch, 0, None);
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("SubsurfacePass"),
            timestamp_writes: None,
        });
        pass.set_bind_group(0, groups[0], &[]);
        pass.set_bind_group(BindGroup1::INDEX, groups[1], &[]);
        pass.set_pipeline(&self.classify);
        pass.set_bind_group(SubsurfaceComputeBindGroup2::INDEX, &frame.classify_group, &[]);
        pass.dispatch_workgroups(frame.tile_columns, frame.tile_rows, 1);
        for (pipeline, group) in self
            .first
            .iter()
            .map(|first| (first, &frame.first_group))
            .chain([(&self.diffuse, &frame.second_group)])
        {
            pass.set_pipeline(pipeline);
            pass.set_bind_group(SubsurfaceComputeBindGroup2::INDEX, group, &[]);
            pass.dispatch_workgroups_indirect(&frame.dispatch, 0);
        }
    }
}

/// The layout of the stages' textures and lists. The bindings know the result's format of a sample; a kernel has its
/// own.
fn layout(device: &wgpu::Device, kernel: &KernelParts) -> wgpu::BindGroupLayout {
    let mut entries = SubsurfaceComputeBindGroup2::LAYOUT_ENTRIES;
    for entry in &mut entries {
        if let (
            wgpu::BindingType::StorageTexture {
                format: wgpu::TextureFormat::Rgba16Float,
                access,
                view_dimension,
            },
            Some(format),
        ) = (entry.ty, texture_format(kernel.module().output_format()))
        {
            entry.ty = wgpu::BindingType::StorageTexture { format, access, view_dimension };
        }
    }
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("SubsurfacePass compute layout"),
        entries: &entries,
    })
}
