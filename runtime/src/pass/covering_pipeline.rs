//! Pipelines that draw one triangle over the whole target.

use crate::wgpu;

/// What such a pipeline is made of.
pub(super) struct CoveringPipeline<'a> {
    pub(super) label: &'a str,
    pub(super) module: &'a wgpu::ShaderModule,
    /// Vertex and fragment entry points.
    pub(super) entries: (&'a str, &'a str),
    /// Values of the module's `override`s.
    pub(super) constants: &'a [(&'a str, f64)],
    pub(super) bind_group_layouts: &'a [Option<&'a wgpu::BindGroupLayout>],
    pub(super) targets: &'a [Option<wgpu::ColorTargetState>],
    pub(super) depth_stencil: Option<wgpu::DepthStencilState>,
    pub(super) cache: Option<&'a wgpu::PipelineCache>,
}

impl CoveringPipeline<'_> {
    pub(super) fn create(self, device: &wgpu::Device) -> wgpu::RenderPipeline {
        let Self { label, module, constants, .. } = self;
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(&format!("{label} layout")),
            bind_group_layouts: self.bind_group_layouts,
            immediate_size: 0,
        });
        let compilation_options = wgpu::PipelineCompilationOptions { constants, ..Default::default() };
        device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(label),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module,
                entry_point: Some(self.entries.0),
                compilation_options: compilation_options.clone(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: self.depth_stencil,
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module,
                entry_point: Some(self.entries.1),
                compilation_options,
                targets: self.targets,
            }),
            multiview_mask: None,
            cache: self.cache,
        })
    }
}
