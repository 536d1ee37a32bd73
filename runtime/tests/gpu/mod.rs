//! The device that tests run on, and how they read textures and buffers back.

#![allow(dead_code, unreachable_pub, reason = "each test binary uses its own part of this module")]

use subsurface_codegen::{Compilation, Compiler};
use subsurface_runtime::{Extent, Readback, SubsurfaceKernel, Target, wgpu};

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
        self.texture(size, wgpu::TextureFormat::Rgba32Float, bytemuck::cast_slice(&texels(size, pixel)))
    }

    /// A texture of one f32 per pixel.
    pub fn r32(&self, size: [u32; 2], pixel: impl Fn(u32, u32) -> f32) -> wgpu::TextureView {
        self.texture(size, wgpu::TextureFormat::R32Float, bytemuck::cast_slice(&texels(size, pixel)))
    }

    fn texture(
        &self,
        [width, height]: [u32; 2],
        format: wgpu::TextureFormat,
        bytes: &[u8],
    ) -> wgpu::TextureView {
        let size = Extent::new(width, height);
        let made = Target::from_texels(&self.device, &self.queue, size, format, "test input", bytes);
        made.expect("the texels fit the size").view
    }

    /// Bytes of a texture, row by row without padding.
    pub fn read_texture(&self, texture: &wgpu::Texture) -> Vec<u8> {
        let mut encoder = self.device.create_command_encoder(&Default::default());
        let readback = Readback::record(&self.device, &mut encoder, texture);
        self.queue.submit([encoder.finish()]);
        readback.wait(&self.device).expect("the device answers")
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

/// One value per pixel, rows from the top.
fn texels<T>([width, height]: [u32; 2], pixel: impl Fn(u32, u32) -> T) -> Vec<T> {
    (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| pixel(x, y)).collect()
}
