//! Bind group 0 of a kernel module: the parameter table, the tables of tabulated profiles where there are some, and the
//! curves of all profiles.

use crate::wgpu::{self, util::DeviceExt as _};

use subsurface_kernel::{KernelParts, RowBinding};

use crate::load_error::LoadError;

/// Binding of the curves.
const CURVES_BINDING: u32 = 2;

/// The tables on the device.
#[derive(Debug)]
pub(crate) struct MaterialTable {
    pub(crate) layout: wgpu::BindGroupLayout,
    pub(crate) bind_group: wgpu::BindGroup,
}

/// A table that is a buffer.
struct Table<'a> {
    label: &'static str,
    /// What it holds, for people.
    name: &'static str,
    contents: &'a [u8],
    /// Bytes that must be bound at least.
    least: usize,
    ty: wgpu::BufferBindingType,
}

impl MaterialTable {
    pub(crate) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        kernel: &KernelParts,
    ) -> Result<Self, LoadError> {
        let tables = tables(kernel);
        check(&device.limits(), kernel, &tables)?;
        let visibility = wgpu::ShaderStages::FRAGMENT.union(wgpu::ShaderStages::COMPUTE);
        let mut layout_entries: Vec<_> = (0..)
            .zip(&tables)
            .map(|(binding, table)| wgpu::BindGroupLayoutEntry {
                binding,
                visibility,
                ty: wgpu::BindingType::Buffer {
                    ty: table.ty,
                    has_dynamic_offset: false,
                    min_binding_size: wgpu::BufferSize::new(table.least as u64),
                },
                count: None,
            })
            .collect();
        layout_entries.push(wgpu::BindGroupLayoutEntry {
            binding: CURVES_BINDING,
            visibility,
            ty: wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Float { filterable: false },
                view_dimension: wgpu::TextureViewDimension::D2,
                multisampled: false,
            },
            count: None,
        });
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("LoadedKernel layout"),
            entries: &layout_entries,
        });
        let buffers: Vec<_> = tables.iter().map(|table| table.buffer(device)).collect();
        let curves = curves(device, queue, kernel);
        let mut entries: Vec<_> = (0..)
            .zip(&buffers)
            .map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
            .collect();
        let resource = wgpu::BindingResource::TextureView(&curves);
        entries.push(wgpu::BindGroupEntry { binding: CURVES_BINDING, resource });
        let bind_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("LoadedKernel bind group"),
            layout: &layout,
            entries: &entries,
        });
        Ok(Self { layout, bind_group })
    }
}

/// The buffers of the group, by binding.
fn tables(kernel: &KernelParts) -> Vec<Table<'_>> {
    let contents = kernel.material_rows();
    let storage = wgpu::BufferBindingType::Storage { read_only: true };
    let (ty, least) = match kernel.module().row_binding() {
        // The array in the WGSL has a length, so all of it must be bound.
        RowBinding::Uniform => (wgpu::BufferBindingType::Uniform, contents.len()),
        RowBinding::Storage => (storage, kernel.module().row_stride() as usize),
    };
    let mut tables = vec![Table { label: "LoadedKernel rows", name: "material rows", contents, least, ty }];
    let contents = kernel.profile_tables();
    if !contents.is_empty() {
        // Indices reach all of it.
        let least = contents.len();
        let (label, name) = ("LoadedKernel profile tables", "profile tables");
        tables.push(Table { label, name, contents, least, ty: storage });
    }
    tables
}

/// Whether the device can hold the kernel.
fn check(limits: &wgpu::Limits, kernel: &KernelParts, tables: &[Table<'_>]) -> Result<(), LoadError> {
    let needed = storage_buffers(kernel.module().row_binding(), !kernel.profile_tables().is_empty());
    let limit = limits.max_storage_buffers_per_shader_stage;
    if needed > limit {
        return Err(LoadError::StorageBuffers { needed, limit });
    }
    for table in tables {
        let (limit, limit_name) = match table.ty {
            wgpu::BufferBindingType::Uniform => {
                (limits.max_uniform_buffer_binding_size, "max_uniform_buffer_binding_size")
            }
            wgpu::BufferBindingType::Storage { .. } => {
                (limits.max_storage_buffer_binding_size, "max_storage_buffer_binding_size")
            }
        };
        let bytes = table.contents.len() as u64;
        if bytes > limit {
            return Err(LoadError::Table { table: table.name, bytes, limit, limit_name });
        }
    }
    let ([width, height], limit) = (kernel.curve_size(), limits.max_texture_dimension_2d);
    if width > limit || height > limit {
        return Err(LoadError::Curves { width, height, limit });
    }
    Ok(())
}

impl Table<'_> {
    fn buffer(&self, device: &wgpu::Device) -> wgpu::Buffer {
        let usage = match self.ty {
            wgpu::BufferBindingType::Uniform => wgpu::BufferUsages::UNIFORM,
            wgpu::BufferBindingType::Storage { .. } => wgpu::BufferUsages::STORAGE,
        };
        device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some(self.label),
            contents: self.contents,
            usage,
        })
    }
}

fn curves(device: &wgpu::Device, queue: &wgpu::Queue, kernel: &KernelParts) -> wgpu::TextureView {
    let [width, height] = kernel.curve_size();
    let descriptor = wgpu::TextureDescriptor {
        label: Some("LoadedKernel curves"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba32Float,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    };
    let order = wgpu::util::TextureDataOrder::LayerMajor;
    let texture = device.create_texture_with_data(queue, &descriptor, order, kernel.profile_curves());
    texture.create_view(&wgpu::TextureViewDescriptor {
        label: Some("LoadedKernel curves"),
        ..Default::default()
    })
}

/// Storage buffers of group 0.
pub(crate) fn storage_buffers(rows: RowBinding, has_profile_tables: bool) -> u32 {
    u32::from(rows == RowBinding::Storage) + u32::from(has_profile_tables)
}
