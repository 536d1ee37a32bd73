//! A ball of jade: all four passes by the `Renderer`. `cargo run --example renderer -- jade.png`

use pollster::FutureExt as _;
use subsurface::presets::{self, Material};
use subsurface::runtime::*;

const SIZE: Extent = Extent::new(320, 240);

/// A sphere of radius 0.05 m.
fn ball(device: &wgpu::Device) -> Geometry {
    let vertex = |index: u32| {
        let (theta, phi) =
            ((index / 65) as f32 * std::f32::consts::PI / 64.0, (index % 65) as f32 * 0.09817477);
        let normal = [theta.sin() * phi.sin(), theta.cos(), theta.sin() * phi.cos()];
        Vertex { position: normal.map(|x| 0.05 * x), normal, ..Default::default() }
    };
    let quad = |a: u32| [a, a + 65, a + 1, a + 1, a + 65, a + 66];
    let indices: Vec<u32> = (0..64).flat_map(|row| (65 * row..65 * row + 64).flat_map(quad)).collect();
    Geometry::new(device, &(0..65 * 65).map(vertex).collect::<Vec<_>>(), &indices)
}

/// The picture, four bytes of sRGB per pixel.
pub(crate) fn draw() -> Result<Vec<u8>, Box<dyn std::error::Error>> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapter = instance.request_adapter(&Default::default()).block_on()?;
    let (device, queue) = adapter.request_device(&Default::default()).block_on()?;
    let kernel = LoadedKernel::new(&device, &queue, &presets::kernel())?;
    let mut renderer = Renderer::new(&device, &kernel, &RendererDescriptor::default())?;
    let surface = SurfaceDescriptor { material: Some(Material::Jade.number()), ..Default::default() };
    let objects = [Object::new(&device, &queue, ball(&device), &surface)?];
    let lights = [DirectionalLight { direction: [1.0, -0.7, -0.5], ..Default::default() }.into()];
    let camera = Camera { position: [0.0, 0.0, 0.3], ..Default::default() };
    let frame = Frame { lights: &lights, ..Frame::new(camera, Bounds::new([0.0; 3], 0.06), 1000.0) };

    renderer.resize(&device, SIZE)?;
    renderer.prepare(&queue, &frame)?;
    let picture = Target::new(&device, SIZE, wgpu::TextureFormat::Rgba8UnormSrgb, "picture")?;
    let mut encoder = device.create_command_encoder(&Default::default());
    renderer.encode(&mut encoder, &objects, &picture.view)?;
    let readback = Readback::record(&device, &mut encoder, &picture.texture);
    queue.submit([encoder.finish()]);
    Ok(readback.wait(&device)?)
}

#[allow(dead_code, reason = "a test draws without a file")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args_os().nth(1).unwrap_or_else(|| "jade.png".into());
    image::save_buffer(&path, &draw()?, SIZE.width, SIZE.height, image::ColorType::Rgba8)?;
    Ok(())
}
