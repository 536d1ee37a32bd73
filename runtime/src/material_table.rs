//! Bind group 0 of a kernel module: the parameter table.

use wgpu::util::DeviceExt as _;

use crate::kernel::SubsurfaceKernel;

/// The table on the device.
#[derive(Debug)]
pub(crate) struct MaterialTable {
    pub(crate) layout: wgpu::BindGroupLayout,
    pub(crate) bind_group: wgpu::BindGroup,
}

impl MaterialTable {
    pub(crate) fn new(device: &wgpu::Device, kernel: &SubsurfaceKernel) -> Self {
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("MaterialTable layout"),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::FRAGMENT,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Storage { read_only: true },
                    has_dynamic_offset: false,
                    // One row: its size differs from set to set, so no generated constant can say it.
                    min_binding_size: wgpu::BufferSize::new(kernel.material_stride() as u64),
                },
                count: None,
            }],
        });
        let buffer = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("MaterialTable buffer"),
            contents: kernel.material_table(),
            usage: wgpu::BufferUsages::STORAGE,
        });
        let bind_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("MaterialTable bind group"),
            layout: &layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: buffer.as_entire_binding() }],
        });
        Self { layout, bind_group }
    }
}
