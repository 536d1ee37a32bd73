//! Bind group 0 of a kernel module: the parameter table, the tables of tabulated profiles where there are some, and the
//! curves of all profiles.

use wgpu::util::DeviceExt as _;

use subsurface_kernel::constants::CURVE_TEXEL_BYTES;
use subsurface_kernel::{KernelParts, RowBinding};

/// Binding of the curves.
const CURVES_BINDING: u32 = 2;

/// The tables on the device.
#[derive(Debug)]
pub(crate) struct MaterialTable {
    pub(crate) layout: wgpu::BindGroupLayout,
    pub(crate) bind_group: wgpu::BindGroup,
    /// The curves until a queue has taken them.
    pending: Option<PendingCurves>,
}

/// Texels on their way to the device: a texture is made without a queue, but filled by one.
#[derive(Debug)]
struct PendingCurves {
    texture: wgpu::Texture,
    texels: Vec<u8>,
}

/// A table that is a buffer.
struct Table<'a> {
    label: &'static str,
    contents: &'a [u8],
    /// Bytes that must be bound at least.
    least: usize,
    ty: wgpu::BufferBindingType,
}

impl MaterialTable {
    pub(crate) fn new(device: &wgpu::Device, kernel: &KernelParts) -> Self {
        let visibility = wgpu::ShaderStages::FRAGMENT.union(wgpu::ShaderStages::COMPUTE);
        let tables = tables(kernel);
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
            label: Some("MaterialTable layout"),
            entries: &layout_entries,
        });
        let buffers: Vec<_> = tables.iter().map(|table| table.buffer(device)).collect();
        let pending = curves(device, kernel);
        let curves = pending.texture.create_view(&Default::default());
        let mut entries: Vec<_> = (0..)
            .zip(&buffers)
            .map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
            .collect();
        let resource = wgpu::BindingResource::TextureView(&curves);
        entries.push(wgpu::BindGroupEntry { binding: CURVES_BINDING, resource });
        let bind_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("MaterialTable bind group"),
            layout: &layout,
            entries: &entries,
        });
        Self { layout, bind_group, pending: Some(pending) }
    }

    /// Uploads what is not on the device yet.
    pub(crate) fn prepare(&mut self, queue: &wgpu::Queue) {
        let Some(PendingCurves { texture, texels }) = self.pending.take() else { return };
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(texture.width() * CURVE_TEXEL_BYTES as u32),
            rows_per_image: None,
        };
        queue.write_texture(texture.as_image_copy(), &texels, layout, texture.size());
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
    let mut tables = vec![Table { label: "MaterialTable buffer", contents, least, ty }];
    let contents = kernel.profile_tables();
    if !contents.is_empty() {
        // Indices reach all of it.
        let least = contents.len();
        tables.push(Table { label: "MaterialTable profile tables", contents, least, ty: storage });
    }
    tables
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

fn curves(device: &wgpu::Device, kernel: &KernelParts) -> PendingCurves {
    let (texels, [width, height]) = (kernel.profile_curves(), kernel.curve_size());
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("MaterialTable curves"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba32Float,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    PendingCurves { texture, texels: texels.to_vec() }
}

/// The module of a kernel on the device.
pub(crate) fn shader_module(device: &wgpu::Device, kernel: &KernelParts) -> wgpu::ShaderModule {
    device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("KernelParts module"),
        source: wgpu::ShaderSource::Wgsl(kernel.module().wgsl().into()),
    })
}
