//! The fragment path.

use crate::bindings::kernel::{
    BindGroup1, ENTRY_FIRST_FRAGMENT, ENTRY_PACK_FRAGMENT, ENTRY_PASSTHROUGH_FRAGMENT,
    ENTRY_SUBSURFACE_FRAGMENT, ENTRY_SUBSURFACE_VERTEX, SubsurfaceFragmentBindGroup2,
};
use crate::error::SizeError;
use crate::pass::{cleared, covering_pipeline};
use crate::target::{Extent, TRANSLUCENT_STENCIL, Target};
use subsurface_kernel::Estimator;
use subsurface_kernel::KernelParts;

use super::intermediate::{Intermediate, intermediates, packed_pixels};

/// Pipelines.
#[derive(Debug)]
pub(super) struct FragmentPath {
    kind: Estimator,
    pack: Option<wgpu::RenderPipeline>,
    first: Option<wgpu::RenderPipeline>,
    diffuse: wgpu::RenderPipeline,
    /// Copies what the stencil leaves out; without a stencil the one pipeline does both.
    passthrough: Option<wgpu::RenderPipeline>,
    layout: wgpu::BindGroupLayout,
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
        kernel: &KernelParts,
        module: &wgpu::ShaderModule,
        groups: [&wgpu::BindGroupLayout; 2],
        format: wgpu::TextureFormat,
        stencil: Option<wgpu::TextureFormat>,
    ) -> Self {
        let layout = SubsurfaceFragmentBindGroup2::layout(device, "SubsurfacePass fragment layout");
        let layouts = [Some(groups[0]), Some(groups[1]), Some(&layout)];
        let pipeline = |label, entry, compare| {
            let stencil = stencil.map(|format| read_only_stencil(format, compare));
            covering_pipeline(
                device,
                label,
                module,
                (ENTRY_SUBSURFACE_VERTEX, entry),
                &layouts,
                &[Some(format.into())],
                stencil,
            )
        };
        let kind = kernel.module().estimator();
        let before = |label, entry, targets: &[Intermediate]| {
            let targets: Vec<_> = targets.iter().map(|target| Some(target.format.into())).collect();
            let entries = (ENTRY_SUBSURFACE_VERTEX, entry);
            covering_pipeline(device, label, module, entries, &layouts, &targets, None)
        };
        let pack = kind
            .packs_pixels()
            .then(|| before("SubsurfacePass packing", ENTRY_PACK_FRAGMENT, &[packed_pixels(kind)]));
        let first = kind
            .has_two_stages()
            .then(|| before("SubsurfacePass first stage", ENTRY_FIRST_FRAGMENT, intermediates(kind)));
        let diffuse =
            pipeline("SubsurfacePass pipeline", ENTRY_SUBSURFACE_FRAGMENT, wgpu::CompareFunction::Equal);
        let passthrough = stencil.map(|_| {
            let label = "SubsurfacePass passthrough pipeline";
            pipeline(label, ENTRY_PASSTHROUGH_FRAGMENT, wgpu::CompareFunction::NotEqual)
        });
        Self { kind, pack, first, diffuse, passthrough, layout }
    }

    /// Targets between the stages for frames of `size`.
    pub(super) fn frame(&self, device: &wgpu::Device, size: Extent) -> Result<FragmentFrame, SizeError> {
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let intermediates = intermediates(self.kind)
            .iter()
            .map(|intermediate| intermediate.target(device, size, usage))
            .collect::<Result<Vec<_>, _>>()?;
        let pixels = packed_pixels(self.kind).target(device, size, usage)?;
        let nothing = Intermediate::single(wgpu::TextureFormat::Rg32Uint, "SubsurfacePass nothing");
        let nothing = nothing.target(device, size, usage)?;
        let group = |read: [&Target; 3], label| {
            SubsurfaceFragmentBindGroup2 {
                intermediate_texture: &read[0].view,
                second_intermediate_texture: &read[1].view,
                pixel_texture: &read[2].view,
            }
            .create(device, &self.layout, label)
        };
        let pack_group = group([&nothing; 3], "SubsurfacePass packing bind group");
        let first_group = group([&nothing, &nothing, &pixels], "SubsurfacePass first stage bind group");
        let at = |index: usize| intermediates.get(index).unwrap_or(&nothing);
        let second_group = group([at(0), at(1), &pixels], "SubsurfacePass stage bind group");
        Ok(FragmentFrame { pixels, intermediates, pack_group, first_group, second_group })
    }

    pub(super) fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        frame: &FragmentFrame,
        groups: [&wgpu::BindGroup; 2],
        output: &wgpu::TextureView,
        depth_stencil: Option<&wgpu::TextureView>,
    ) {
        if let Some(pack) = &self.pack {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("SubsurfacePass packing"),
                color_attachments: &[cleared(&frame.pixels.view, wgpu::Color::TRANSPARENT)],
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
                label: Some("SubsurfacePass first stage"),
                color_attachments: &attachments[..frame.intermediates.len()],
                ..Default::default()
            });
            bind(&mut pass, groups, &frame.first_group);
            pass.set_pipeline(first);
            pass.draw(0..3, 0..1);
        }
        let depth_stencil_attachment = depth_stencil.map(|view| {
            // No operations: both aspects are read-only, so the depth may be sampled meanwhile.
            wgpu::RenderPassDepthStencilAttachment { view, depth_ops: None, stencil_ops: None }
        });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("SubsurfacePass"),
            color_attachments: &[cleared(output, wgpu::Color::TRANSPARENT)],
            depth_stencil_attachment,
            ..Default::default()
        });
        bind(&mut pass, groups, &frame.second_group);
        if self.passthrough.is_some() {
            pass.set_stencil_reference(TRANSLUCENT_STENCIL);
        }
        for pipeline in std::iter::once(&self.diffuse).chain(&self.passthrough) {
            pass.set_pipeline(pipeline);
            pass.draw(0..3, 0..1);
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
