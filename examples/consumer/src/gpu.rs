//! What an engine has anyway: a device, textures, and a way to look at a pixel.

use std::error::Error;

use subsurface_runtime::wgpu::{self, TextureUsages, util::DeviceExt as _};
use subsurface_runtime::{Extent, bytemuck};

pub struct Gpu {
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
}

impl Gpu {
    pub fn open() -> Result<Self, Box<dyn Error>> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
        let adapter = pollster::block_on(instance.request_adapter(&Default::default()))?;
        let (device, queue) = pollster::block_on(adapter.request_device(&Default::default()))?;
        Ok(Self { device, queue })
    }

    pub fn upload(&self, size: Extent, texel: impl Fn(u32, u32) -> [f32; 4]) -> wgpu::TextureView {
        let Extent { width, height } = size;
        let texels: Vec<_> = (0..width * height).map(|i| texel(i % width, i / width)).collect();
        let descriptor = wgpu::TextureDescriptor {
            label: Some("Gpu input"),
            size: size.into(),
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba32Float,
            usage: TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST | TextureUsages::COPY_SRC,
            view_formats: &[],
        };
        let bytes = bytemuck::cast_slice(&texels);
        let texture =
            self.device.create_texture_with_data(&self.queue, &descriptor, Default::default(), bytes);
        texture.create_view(&Default::default())
    }

    pub fn pixel(&self, texture: &wgpu::Texture, [x, y]: [u32; 2]) -> Result<[f32; 4], Box<dyn Error>> {
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("Gpu pixel"),
            size: 16,
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let origin = wgpu::Origin3d { x, y, z: 0 };
        let from = wgpu::TexelCopyTextureInfo { origin, ..texture.as_image_copy() };
        let to = wgpu::TexelCopyBufferInfo { buffer: &buffer, layout: Default::default() };
        let mut encoder = self.device.create_command_encoder(&Default::default());
        encoder.copy_texture_to_buffer(from, to, Extent::new(1, 1).into());
        self.queue.submit([encoder.finish()]);
        buffer.map_async(wgpu::MapMode::Read, .., |_| ());
        self.device.poll(wgpu::PollType::wait_indefinitely())?;
        Ok(bytemuck::pod_read_unaligned(&buffer.get_mapped_range(..)?))
    }
}
