//! How much of the surface albedo comes before the light diffuses, by material.

use subsurface_kernel::KernelParts;
use subsurface_kernel::constants::MOST_MATERIALS;

use crate::bindings::kernel::SURFACE_ALBEDO_MIX_OFFSET;
use crate::wgpu::{self, util::DeviceExt as _};

/// `surface_albedo_mix` of all materials, on the device.
#[derive(Clone, Debug)]
pub(crate) struct AlbedoMixes {
    buffer: wgpu::Buffer,
    is_used: bool,
}

impl AlbedoMixes {
    /// Those of a kernel.
    pub(crate) fn of(device: &wgpu::Device, kernel: &KernelParts) -> Self {
        // What all materials have stands first in each row.
        let rows = kernel.material_rows().chunks_exact(kernel.module().row_stride() as usize);
        let of_row = |row: &[u8]| {
            bytemuck::pod_read_unaligned::<f32>(&row[SURFACE_ALBEDO_MIX_OFFSET..][..size_of::<f32>()])
        };
        Self::with(device, rows.map(of_row))
    }

    /// All of it comes afterwards.
    pub(crate) fn none(device: &wgpu::Device) -> Self {
        Self::with(device, std::iter::empty())
    }

    fn with(device: &wgpu::Device, mixes: impl Iterator<Item = f32>) -> Self {
        let mut table: Vec<f32> = mixes.collect();
        let is_used = table.iter().any(|mix| *mix > 0.0);
        table.resize(MOST_MATERIALS as usize, 0.0);
        let buffer = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("albedo mixes"),
            contents: bytemuck::cast_slice(&table),
            usage: wgpu::BufferUsages::UNIFORM,
        });
        Self { buffer, is_used }
    }

    pub(crate) fn buffer(&self) -> wgpu::BufferBinding<'_> {
        self.buffer.as_entire_buffer_binding()
    }

    /// Whether some of it comes before.
    pub(crate) fn is_used(&self) -> bool {
        self.is_used
    }
}
