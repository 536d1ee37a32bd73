//! The device that tests run on, and how they read textures and buffers back.

#![allow(dead_code, unreachable_pub, reason = "each test binary uses its own part of this module")]

use subsurface_codegen::{Compilation, Compiler};
use subsurface_runtime::{SubsurfaceKernel, wgpu};

/// A device and its queue.
pub struct Gpu {
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
}

impl Gpu {
    /// Opens the first adapter. A machine without one fails the test: it never skips.
    pub fn open() -> Self {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
        let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))
            .expect("no graphics adapter: run `cargo xtask test`, or install mesa-vulkan-drivers");
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("test device"),
            required_limits: wgpu::Limits::default().using_resolution(adapter.limits()),
            ..Default::default()
        }))
        .expect("the adapter refuses a device with WebGPU's default limits");
        Self { device, queue }
    }

    /// Runs `body` and fails on any validation error.
    pub fn validated<T>(&self, body: impl FnOnce() -> T) -> T {
        let scope = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let value = body();
        if let Some(error) = pollster::block_on(scope.pop()) {
            panic!("validation error: {error}");
        }
        value
    }

    /// A texture of four f32 per pixel.
    pub fn rgba32(&self, size: [u32; 2], pixel: impl Fn(u32, u32) -> [f32; 4]) -> wgpu::TextureView {
        let texels: Vec<[f32; 4]> =
            (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y))).map(|(x, y)| pixel(x, y)).collect();
        self.texture(size, wgpu::TextureFormat::Rgba32Float, bytemuck::cast_slice(&texels))
    }

    /// A texture of one f32 per pixel.
    pub fn r32(&self, size: [u32; 2], pixel: impl Fn(u32, u32) -> f32) -> wgpu::TextureView {
        let texels: Vec<f32> =
            (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y))).map(|(x, y)| pixel(x, y)).collect();
        self.texture(size, wgpu::TextureFormat::R32Float, bytemuck::cast_slice(&texels))
    }

    fn texture(
        &self,
        [width, height]: [u32; 2],
        format: wgpu::TextureFormat,
        bytes: &[u8],
    ) -> wgpu::TextureView {
        use wgpu::util::DeviceExt as _;
        let descriptor = wgpu::TextureDescriptor {
            label: Some("test input"),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        };
        let order = wgpu::util::TextureDataOrder::LayerMajor;
        self.device
            .create_texture_with_data(&self.queue, &descriptor, order, bytes)
            .create_view(&Default::default())
    }

    /// Bytes of a texture, row by row without padding.
    pub fn read_texture(&self, texture: &wgpu::Texture) -> Vec<u8> {
        let bytes_per_pixel = texture.format().block_copy_size(None).expect("a colour format");
        let row = texture.width() * bytes_per_pixel;
        let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("test readback"),
            size: u64::from(padded * texture.height()),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = self.device.create_command_encoder(&Default::default());
        encoder.copy_texture_to_buffer(
            texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(padded),
                    rows_per_image: None,
                },
            },
            texture.size(),
        );
        self.queue.submit([encoder.finish()]);
        let bytes = self.map(&buffer);
        bytes.chunks(padded as usize).flat_map(|line| &line[..row as usize]).copied().collect()
    }

    /// Bytes of a buffer that can be mapped.
    pub fn map(&self, buffer: &wgpu::Buffer) -> Vec<u8> {
        buffer.map_async(wgpu::MapMode::Read, .., |result| result.expect("mapping a readback buffer"));
        self.device.poll(wgpu::PollType::wait_indefinitely()).expect("the device answers");
        buffer.get_mapped_range(..).expect("mapped above").to_vec()
    }
}

/// Compiles material files in memory.
pub fn compile(files: &[(&str, &str)]) -> Compilation {
    Compiler::from_memory(files.iter().map(|(path, text)| (*path, *text)))
        .compile()
        .unwrap_or_else(|report| panic!("{report}"))
}

/// The kernel of a compilation.
pub fn kernel(compilation: &Compilation) -> SubsurfaceKernel {
    let (wgsl, table) = (compilation.wgsl.clone(), compilation.material_table.clone());
    SubsurfaceKernel::new(wgsl, table, compilation.material_names()).expect("a compilation makes a kernel")
}
