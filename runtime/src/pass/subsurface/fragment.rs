//! The fragment path.

use crate::bindings::kernel::{
    BindGroup1, ENTRY_FIRST_FRAGMENT, ENTRY_PACK_FRAGMENT, ENTRY_PASSTHROUGH_FRAGMENT,
    ENTRY_SUBSURFACE_FRAGMENT, ENTRY_SUBSURFACE_VERTEX, SubsurfaceFragmentBindGroup2,
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
use super::intermediate::{Intermediate, intermediates, packed_pixels};

/// Pipelines.
#[derive(Debug)]
pub(super) struct FragmentPath {
    estimator: Estimator,
    pack: Option<wgpu::RenderPipeline>,
    first: Option<wgpu::RenderPipeline>,
    diffuse: wgpu::RenderPipeline,
    /// Copies what the stencil leaves out; without a stencil the one pipeline does both.
    passthrough: Option<wgpu::RenderPipeline>,
    layout: wgpu::BindGroupLayout,
    pack_label: String,
    first_label: String,
}

/// What depends on the frame's size.
#[derive(Debug)]
pub(super) struct FragmentFrame {
    pixels: Target,
    intermediates: Vec<Target>,
    /// Bound while pixels are packed.
    pack_group: wgpu::BindGroup,
    /// Bound while the first stage writes the intermediates.
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
        let pack = estimator
            .packs_pixels()
            .then(|| pipeline("packing", ENTRY_PACK_FRAGMENT, &[packed_pixels(estimator).format], None));
        let first = estimator.has_two_stages().then(|| {
            let formats: Vec<_> = intermediates(estimator).iter().map(|texture| texture.format).collect();
            pipeline("first stage", ENTRY_FIRST_FRAGMENT, &formats, None)
        });
        let output = &[settings.format];
        let equal = stencil(wgpu::CompareFunction::Equal);
        let diffuse = pipeline("pipeline", ENTRY_SUBSURFACE_FRAGMENT, output, equal);
        let passthrough = stencil(wgpu::CompareFunction::NotEqual).map(|not_equal| {
            pipeline("passthrough pipeline", ENTRY_PASSTHROUGH_FRAGMENT, output, Some(not_equal))
        });
        let (pack_label, first_label) = (label.of("packing"), label.of("first stage"));
        Self { estimator, pack, first, diffuse, passthrough, layout, pack_label, first_label }
    }

    /// Targets between the stages for viewports of `size`.
    pub(super) fn frame(&self, device: &wgpu::Device, settings: &Settings, size: Extent) -> FragmentFrame {
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let label = &settings.label;
        let target = |texture: &Intermediate| texture.target(device, label, size, usage);
        let intermediates: Vec<_> = intermediates(self.estimator).iter().map(target).collect();
        let pixels = target(&packed_pixels(self.estimator));
        let nothing = target(&Intermediate::single(wgpu::TextureFormat::Rg32Uint, "nothing"));
        let group = |read: [&Target; 3], name| {
            SubsurfaceFragmentBindGroup2 {
                intermediate_texture: &read[0].view,
                second_intermediate_texture: &read[1].view,
                pixel_texture: &read[2].view,
            }
            .create(device, &self.layout, &label.of(name))
        };
        let pack_group = group([&nothing; 3], "packing bind group");
        let first_group = group([&nothing, &nothing, &pixels], "first stage bind group");
        let at = |index: usize| intermediates.get(index).unwrap_or(&nothing);
        let second_group = group([at(0), at(1), &pixels], "stage bind group");
        FragmentFrame { pixels, intermediates, pack_group, first_group, second_group }
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
        if let Some(pack) = &self.pack {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some(&self.pack_label),
                color_attachments: &[cleared(&frame.pixels.view, wgpu::Color::TRANSPARENT)],
                timestamp_writes: writes(false),
                ..Default::default()
            });
            bind(&mut pass, groups, &frame.pack_group);
            pass.set_pipeline(pack);
            pass.draw(0..3, 0..1);
        }
        if let Some(first) = &self.first {
            let mut attachments = [None, None];
            for (attachment, target) in attachments.iter_mut().zip(&frame.intermediates) {
                *attachment = cleared(&target.view, wgpu::Color::TRANSPARENT);
            }
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some(&self.first_label),
                color_attachments: &attachments[..frame.intermediates.len()],
                timestamp_writes: writes(false),
                ..Default::default()
            });
            bind(&mut pass, groups, &frame.first_group);
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
