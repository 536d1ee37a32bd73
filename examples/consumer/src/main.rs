//! The edge of a shadow on skin and on marble, softened by the light under their surfaces.
mod materials {
    include!(concat!(env!("OUT_DIR"), "/subsurface.rs"));
}
use materials::Material;
use pollster::FutureExt as _;
use subsurface_runtime::wgpu::{self, TextureFormat::Rgba32Float};
use subsurface_runtime::{Extent, LoadedKernel, Readback, Target, bytemuck};
use subsurface_runtime::{SubsurfaceDescriptor, SubsurfaceInputs, SubsurfacePass, SubsurfaceView};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapter = instance.request_adapter(&Default::default()).block_on()?;
    let (device, queue) = adapter.request_device(&Default::default()).block_on()?;
    // A wall 300 mm away, skin above and marble below; its left half lies in shadow.
    let texture = |texel: &dyn Fn(usize, usize) -> [f32; 4]| {
        let texels: Vec<[f32; 4]> = (0..64 * 64).map(|i| texel(i % 64, i / 64)).collect();
        let (size, bytes) = (Extent::new(64, 64), bytemuck::cast_slice(&texels));
        Target::from_texels(&device, &queue, size, Rgba32Float, "input", bytes)
    };
    let irradiance = texture(&|x, _| [if x < 32 { 0.0 } else { 1.0 }; 4])?;
    let surface = texture(&|_, y| [Material::Skin, Material::Marble][y / 32].surface_texel())?;
    let depth = texture(&|_, _| [300.0; 4])?;
    let kernel = LoadedKernel::new(&device, &queue, &materials::kernel())?;
    let mut pass = SubsurfacePass::new(&device, &kernel, &SubsurfaceDescriptor::new(Rgba32Float))?;
    pass.bind(&device, &SubsurfaceInputs::new(&irradiance.view, &surface.view, &depth.view))?;
    pass.prepare(&queue, &SubsurfaceView::orthographic_distances(0.05))?; // mm per pixel
    let output = pass.create_output(&device)?;
    let mut encoder = device.create_command_encoder(&Default::default());
    pass.encode(&mut encoder, &output.view)?;
    let readback = Readback::record(&device, &mut encoder, &output.texture);
    queue.submit([encoder.finish()]);
    let texels: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&readback.wait(&device)?);
    println!("kernel {}", materials::PROVENANCE);
    for (material, y) in [(Material::Skin, 16), (Material::Marble, 48)] {
        println!("{material}: 0 -> {:?}", texels[y * 64 + 28]);
    }
    Ok(())
}
