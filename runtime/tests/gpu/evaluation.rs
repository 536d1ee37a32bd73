//! Functions of a kernel module, evaluated on the device.

use super::Gpu;
use subsurface_codegen::Compilation;
use subsurface_runtime::wgpu;
use wgpu::util::DeviceExt as _;

impl Gpu {
    /// Answers of the compute shader `entry_point` of a compilation, which takes queries in group 1, binding 0, and puts
    /// answers into binding 1. It must read all that group 0 has: the table, the tables of tabulated profiles and the
    /// curves.
    pub fn evaluate<Query: bytemuck::Pod, Answer: bytemuck::Pod>(
        &self,
        compilation: &Compilation,
        entry_point: &str,
        queries: &[Query],
    ) -> Vec<Answer> {
        let device = &self.device;
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(entry_point),
            source: wgpu::ShaderSource::Wgsl(compilation.wgsl().into()),
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(entry_point),
            layout: None,
            module: &module,
            entry_point: Some(entry_point),
            compilation_options: Default::default(),
            cache: None,
        });
        let buffer = |contents: &[u8], usage| {
            let label = Some(entry_point);
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label, contents, usage })
        };
        let storage = wgpu::BufferUsages::STORAGE;
        // The rows of a few materials fit what a uniform buffer holds.
        let table = buffer(compilation.parts.material_rows(), wgpu::BufferUsages::UNIFORM);
        let tables = buffer(compilation.parts.profile_tables(), storage);
        let curves = self.texture(
            compilation.parts.curve_size(),
            wgpu::TextureFormat::Rgba32Float,
            compilation.parts.profile_curves(),
        );
        let asked = buffer(bytemuck::cast_slice(queries), storage);
        let empty = vec![0; queries.len() * size_of::<Answer>()];
        let answered = buffer(&empty, storage | wgpu::BufferUsages::COPY_SRC);
        let readback = buffer(&empty, wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ);
        let group = |index, resources: Vec<wgpu::BindingResource<'_>>| {
            let entries: Vec<_> = (0..)
                .zip(resources)
                .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource })
                .collect();
            let layout = pipeline.get_bind_group_layout(index);
            device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some(entry_point),
                layout: &layout,
                entries: &entries,
            })
        };
        let curves = wgpu::BindingResource::TextureView(&curves);
        let materials = group(0, vec![table.as_entire_binding(), tables.as_entire_binding(), curves]);
        let points = group(1, vec![asked.as_entire_binding(), answered.as_entire_binding()]);
        let mut encoder = device.create_command_encoder(&Default::default());
        {
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(&pipeline);
            pass.set_bind_group(0, &materials, &[]);
            pass.set_bind_group(1, &points, &[]);
            pass.dispatch_workgroups((queries.len() as u32).div_ceil(64), 1, 1);
        }
        encoder.copy_buffer_to_buffer(&answered, 0, &readback, 0, empty.len() as u64);
        self.queue.submit([encoder.finish()]);
        bytemuck::pod_collect_to_vec(&self.map(&readback))
    }
}
