//! The edge of a shadow on skin and on marble, softened by the light under their surfaces.

mod gpu;
#[allow(dead_code, reason = "this program uses a part of what is generated")]
mod materials {
    include!(concat!(env!("OUT_DIR"), "/subsurface.rs"));
}

use materials::{MATERIALS, Material};
use subsurface_runtime::{Extent, SubsurfaceInputs, SubsurfacePass, SubsurfaceView, wgpu::TextureFormat};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let gpu = gpu::Gpu::open()?;
    let size = Extent::new(64, 64);
    // A wall 300 mm away, skin above and marble below; its left half lies in shadow.
    let material = |y| if y < 32 { Material::Skin } else { Material::Marble };
    let irradiance = &gpu.upload(size, |x, _| if x < 32 { [0.0; 4] } else { [1.0; 4] });
    let surface = &gpu.upload(size, |_, y| {
        let [red, green, blue] = MATERIALS[material(y) as usize].surface.surface_albedo;
        [red, green, blue, material(y).number() as f32]
    });
    let depth = &gpu.upload(size, |_, _| [300.0; 4]);
    let inputs = SubsurfaceInputs { irradiance, surface, depth, depth_stencil: None };

    let mut pass = SubsurfacePass::new(&gpu.device, &materials::kernel(), TextureFormat::Rgba32Float, None);
    pass.resize(&gpu.device, size, &inputs)?;
    pass.prepare(&gpu.queue, &SubsurfaceView::orthographic_distances(0.05)); // mm per pixel
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    pass.encode(&mut encoder);
    gpu.queue.submit([encoder.finish()]);
    println!("kernel {}", materials::PROVENANCE);
    let output = pass.output().ok_or("resize makes the output")?;
    for y in [16, 48] {
        let [before, after] =
            [irradiance.texture(), &output.texture].map(|texture| gpu.pixel(texture, [28, y]));
        println!("{}: {:?} -> {:?}", material(y).name(), before?, after?);
    }
    Ok(())
}
