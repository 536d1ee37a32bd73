//! The fragment path.

use crate::bindings::kernel::{
    BindGroup1, ENTRY_BLOCK_FRAGMENT, ENTRY_FIRST_FRAGMENT, ENTRY_PACK_FRAGMENT, ENTRY_PASSTHROUGH_FRAGMENT,
    ENTRY_SQUARE_FRAGMENT, ENTRY_SUBSURFACE_FRAGMENT, ENTRY_SUBSURFACE_VERTEX, SubsurfaceFragmentBindGroup2,
};
use crate::extent::Extent;
use crate::gbuffer::TRANSLUCENT_STENCIL;
use crate::loaded_kernel::LoadedKernel;
use crate::pass::covering_pipeline::CoveringPipeline;
use crate::pass::{attachment, cleared};
use crate::target::Target;
use crate::viewport::Viewport;
use crate::wgpu;
use subsurface_kernel::Estimator;

use super::descriptor::Settings;
use super::intermediate::{Intermediate, coarse_parts, coarse_pixels, first_stage, packed_pixels};

/// Pipelines.
#[derive(Debug)]
pub(super) struct FragmentPath {
    estimator: Estimator,
    pack: Option<wgpu::RenderPipeline>,
    /// Packs blocks, and squares of them.
    coarse: Option<[wgpu::RenderPipeline; 2]>,
    first: Option<wgpu::RenderPipeline>,
    diffuse: wgpu::RenderPipeline,
    /// Copies what the stencil leaves out; without a stencil the one pipeline does both.
    passthrough: Option<wgpu::RenderPipeline>,
    layout: wgpu::BindGroupLayout,
    pack_label: String,
    coarse_label: String,
    first_label: String,
}

/// What depends on the frame's size.
#[derive(Debug)]
pub(super) struct FragmentFrame {
    pixels: Target,
    coarse: Target,
    coarse_parts: [Viewport; 2],
    first: Target,
    /// Bound while pixels are packed.
    pack_group: wgpu::BindGroup,
    /// Bound while squares are packed.
    coarse_group: wgpu::BindGroup,
    /// Bound while the first stage writes its result.
    first_group: wgpu::BindGroup,
    second_group: wgpu::BindGroup,
}

impl FragmentPath {
    pub(super) fn new(
        device: &wgpu::Device,
        kernel: &LoadedKernel,
        settings: &Settings,
        groups: [&wgpu::BindGroupLayout; 2],
    ) -> Self {
        let label = &settings.label;
        let layout = SubsurfaceFragmentBindGroup2::layout(device, &label.of("fragment layout"));
        let layouts = [Some(groups[0]), Some(groups[1]), Some(&layout)];
        let pipeline = |name, entry, targets: &[wgpu::TextureFormat], depth_stencil| {
            let targets: Vec<_> = targets.iter().map(|format| Some((*format).into())).collect();
            CoveringPipeline {
                label: &label.of(name),
                module: kernel.shader_module(),
                entries: (ENTRY_SUBSURFACE_VERTEX, entry),
                constants: settings.constants(),
                bind_group_layouts: &layouts,
                targets: &targets,
                depth_stencil,
                cache: settings.pipeline_cache.as_ref(),
            }
            .create(device)
        };
        let stencil = |compare| settings.stencil.map(|format| read_only_stencil(format, compare));
        let estimator = kernel.estimator();
        let stage = |name, entry, texture: Intermediate| pipeline(name, entry, &[texture.format], None);
        let packs = estimator.packs_pixels();
        let pack = packs.then(|| stage("packing", ENTRY_PACK_FRAGMENT, packed_pixels(estimator)));
        let coarse = packs.then(|| {
            [("block packing", ENTRY_BLOCK_FRAGMENT), ("square packing", ENTRY_SQUARE_FRAGMENT)]
                .map(|(name, entry)| stage(name, entry, coarse_pixels(estimator)))
        });
        let first = first_stage(estimator).map(|first| stage("first stage", ENTRY_FIRST_FRAGMENT, first));
        let output = &[settings.format];
        let equal = stencil(wgpu::CompareFunction::Equal);
        let diffuse = pipeline("pipeline", ENTRY_SUBSURFACE_FRAGMENT, output, equal);
        let passthrough = stencil(wgpu::CompareFunction::NotEqual).map(|not_equal| {
            pipeline("passthrough pipeline", ENTRY_PASSTHROUGH_FRAGMENT, output, Some(not_equal))
        });
        Self {
            estimator,
            pack,
            coarse,
            first,
            diffuse,
            passthrough,
            layout,
            pack_label: label.of("packing"),
            coarse_label: label.of("coarse packing"),
            first_label: label.of("first stage"),
        }
    }

    /// Targets between the stages for viewports of `size`.
    pub(super) fn frame(&self, device: &wgpu::Device, settings: &Settings, size: Extent) -> FragmentFrame {
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let label = &settings.label;
        let target = |texture: &Intermediate| texture.target(device, label, size, usage);
        let nothing = Intermediate::single(wgpu::TextureFormat::Rg32Uint, "nothing");
        let first = target(&first_stage(self.estimator).unwrap_or(nothing));
        let pixels = target(&packed_pixels(self.estimator));
        let coarse = target(&coarse_pixels(self.estimator));
        let nothing = target(&nothing);
        let group = |read: [&Target; 3], name| {
            SubsurfaceFragmentBindGroup2 {
                intermediate_texture: &read[0].view,
                coarse_texture: &read[1].view,
                pixel_texture: &read[2].view,
            }
            .create(device, &self.layout, &label.of(name))
        };
        let pack_group = group([&nothing; 3], "packing bind group");
        let coarse_group = group([&nothing, &nothing, &pixels], "coarse packing bind group");
        let first_group = group([&nothing, &coarse, &pixels], "first stage bind group");
        let second_group = group([&first, &coarse, &pixels], "stage bind group");
        let coarse_parts = coarse_parts(size);
        FragmentFrame {
            pixels,
            coarse,
            coarse_parts,
            first,
            pack_group,
            coarse_group,
            first_group,
            second_group,
        }
    }

    pub(super) fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        settings: &Settings,
        frame: &FragmentFrame,
        groups: [&wgpu::BindGroup; 2],
        output: &Output<'_>,
    ) {
        let timestamps = settings.timestamps.as_ref();
        let mut is_first = true;
        let mut writes = |is_last| {
            let is_first = std::mem::replace(&mut is_first, false);
            timestamps.and_then(|timestamps| timestamps.of_render_pass(is_first, is_last))
        };
        let mut begin = |encoder: &mut wgpu::CommandEncoder, label, target: &Target, group| {
            let mut pass = encoder
                .begin_render_pass(&wgpu::RenderPassDescriptor {
                    label: Some(label),
                    color_attachments: &[cleared(&target.view, wgpu::Color::TRANSPARENT)],
                    timestamp_writes: writes(false),
                    ..Default::default()
                })
                .forget_lifetime();
            bind(&mut pass, groups, group);
            pass
        };
        if let Some(pack) = &self.pack {
            let mut pass = begin(encoder, &self.pack_label, &frame.pixels, &frame.pack_group);
            pass.set_pipeline(pack);
            pass.draw(0..3, 0..1);
        }
        if let Some(coarse) = &self.coarse {
            let mut pass = begin(encoder, &self.coarse_label, &frame.coarse, &frame.coarse_group);
            for (pipeline, Viewport { x, y, width, height }) in coarse.iter().zip(frame.coarse_parts) {
                pass.set_pipeline(pipeline);
                pass.set_scissor_rect(x, y, width, height);
                pass.draw(0..3, 0..1);
            }
        }
        if let Some(first) = &self.first {
            let mut pass = begin(encoder, &self.first_label, &frame.first, &frame.first_group);
            pass.set_pipeline(first);
            pass.draw(0..3, 0..1);
        }
        let depth_stencil_attachment = output.depth_stencil.map(|view| {
            // No operations: both aspects are read-only, so the depth may be sampled meanwhile.
            wgpu::RenderPassDepthStencilAttachment { view, depth_ops: None, stencil_ops: None }
        });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(settings.label.as_str()),
            color_attachments: &[output.attachment()],
            depth_stencil_attachment,
            timestamp_writes: writes(true),
            ..Default::default()
        });
        bind(&mut pass, groups, &frame.second_group);
        output.confine(&mut pass);
        if self.passthrough.is_some() {
            pass.set_stencil_reference(TRANSLUCENT_STENCIL);
        }
        for pipeline in std::iter::once(&self.diffuse).chain(&self.passthrough) {
            pass.set_pipeline(pipeline);
            pass.draw(0..3, 0..1);
        }
    }
}

/// Where a render pass writes its result.
#[derive(Clone, Copy, Debug)]
pub(super) struct Output<'a> {
    pub(super) view: &'a wgpu::TextureView,
    pub(super) depth_stencil: Option<&'a wgpu::TextureView>,
    pub(super) viewport: Viewport,
    /// Whether the viewport is all of the output.
    pub(super) is_whole: bool,
}

impl<'a> Output<'a> {
    /// Cleared, unless what lies outside of the viewport is somebody else's.
    pub(super) fn attachment(&self) -> Option<wgpu::RenderPassColorAttachment<'a>> {
        let clear = wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT);
        attachment(self.view, if self.is_whole { clear } else { wgpu::LoadOp::Load })
    }

    /// Keeps fragments to the viewport.
    pub(super) fn confine(&self, pass: &mut wgpu::RenderPass<'_>) {
        if !self.is_whole {
            let Viewport { x, y, width, height } = self.viewport;
            pass.set_scissor_rect(x, y, width, height);
        }
    }
}

fn bind(pass: &mut wgpu::RenderPass<'_>, groups: [&wgpu::BindGroup; 2], stage: &wgpu::BindGroup) {
    pass.set_bind_group(0, groups[0], &[]);
    pass.set_bind_group(BindGroup1::INDEX, groups[1], &[]);
    pass.set_bind_group(SubsurfaceFragmentBindGroup2::INDEX, stage, &[]);
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
