//! The edge of a shadow on skin and on marble, softened by the light under their surfaces.
mod materials {
    include!(concat!(env!("OUT_DIR"), "/subsurface.rs"));
}
use materials::Material;
use pollster::FutureExt as _;
use subsurface_runtime::wgpu::{self, TextureFormat::Rgba32Float};
use subsurface_runtime::{Extent, Readback, SubsurfaceInputs, SubsurfacePass, SubsurfaceView, Target, bytemuck};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapter = instance.request_adapter(&Default::default()).block_on()?;
    let (device, queue) = adapter.request_device(&Default::default()).block_on()?;
    // A wall 300 mm away, skin above and marble below; its left half lies in shadow.
    let size = Extent::new(64, 64);
    let texture = |texel: &dyn Fn(usize, usize) -> [f32; 4]| {
        let texels: Vec<[f32; 4]> = (0..64 * 64).map(|i| texel(i % 64, i / 64)).collect();
        Target::from_texels(&device, &queue, size, Rgba32Float, "input", bytemuck::cast_slice(&texels))
    };
    let irradiance = &texture(&|x, _| [if x < 32 { 0.0 } else { 1.0 }; 4])?.view;
    let surface = &texture(&|_, y| [Material::Skin, Material::Marble][y / 32].surface_texel())?.view;
    let depth = &texture(&|_, _| [300.0; 4])?.view;
    let (depth_stencil, mean_free_path_scale) = (None, None); // neither is needed
    let inputs = SubsurfaceInputs { irradiance, surface, depth, depth_stencil, mean_free_path_scale };

    let mut pass = SubsurfacePass::new(&device, &materials::kernel(), Rgba32Float, None);
    pass.resize(&device, size, &inputs)?;
    pass.prepare(&queue, &SubsurfaceView::orthographic_distances(0.05)); // mm per pixel
    let mut encoder = device.create_command_encoder(&Default::default());
    pass.encode(&mut encoder);
    let readback = Readback::record(&device, &mut encoder, &pass.output().ok_or("not resized")?.texture);
    queue.submit([encoder.finish()]);
    let texels: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&readback.wait(&device)?);
    println!("kernel {}", materials::PROVENANCE);
    for (material, y) in [(Material::Skin, 16), (Material::Marble, 48)] {
        println!("{}: 0 -> {:?}", material.name(), texels[y * 64 + 28]);
    }
    Ok(())
}
