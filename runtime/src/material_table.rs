//! Bind group 0 of a kernel module: the parameter table, and the tables of tabulated profiles where there are some.

use wgpu::util::DeviceExt as _;

use crate::kernel::SubsurfaceKernel;

/// The tables on the device.
#[derive(Debug)]
pub(crate) struct MaterialTable {
    pub(crate) layout: wgpu::BindGroupLayout,
    pub(crate) bind_group: wgpu::BindGroup,
}

impl MaterialTable {
    pub(crate) fn new(device: &wgpu::Device, kernel: &SubsurfaceKernel) -> Self {
        // At least one row: its size differs from set to set, so no generated constant can say it.
        let mut tables = vec![("MaterialTable buffer", kernel.material_table(), kernel.material_stride())];
        let profile_tables = kernel.profile_tables();
        if !profile_tables.is_empty() {
            // Indices reach all of it.
            tables.push(("MaterialTable profile tables", profile_tables, profile_tables.len()));
        }
        let layout_entries: Vec<_> = (0..)
            .zip(&tables)
            .map(|(binding, (_, _, least))| wgpu::BindGroupLayoutEntry {
                binding,
                visibility: wgpu::ShaderStages::FRAGMENT,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Storage { read_only: true },
                    has_dynamic_offset: false,
                    min_binding_size: wgpu::BufferSize::new(*least as u64),
                },
                count: None,
            })
            .collect();
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("MaterialTable layout"),
            entries: &layout_entries,
        });
        let buffer = |(label, contents, _): &(&str, &[u8], usize)| {
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some(label),
                contents,
                usage: wgpu::BufferUsages::STORAGE,
            })
        };
        let buffers: Vec<_> = tables.iter().map(buffer).collect();
        let entries: Vec<_> = (0..)
            .zip(&buffers)
            .map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
            .collect();
        let bind_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("MaterialTable bind group"),
            layout: &layout,
            entries: &entries,
        });
        Self { layout, bind_group }
    }
}
