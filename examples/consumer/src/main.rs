use subsurface_runtime::wgpu::{self, util::DeviceExt as _};
use subsurface_runtime::{Extent, SubsurfaceInputs, SubsurfacePass, SubsurfaceView, bytemuck};

#[allow(dead_code, reason = "this program uses a part of what is generated")]
mod materials {
    include!(concat!(env!("OUT_DIR"), "/subsurface.rs"));
}
use materials::{MATERIALS, Material};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapter = pollster::block_on(instance.request_adapter(&Default::default()))?;
    let (device, queue) = pollster::block_on(adapter.request_device(&Default::default()))?;
    let size = Extent::new(64, 64);
    let texture = |usage| wgpu::TextureDescriptor { label: None, size: size.into(), mip_level_count: 1, sample_count: 1, dimension: wgpu::TextureDimension::D2, format: wgpu::TextureFormat::Rgba32Float, usage, view_formats: &[] };
    Ok(())
}
