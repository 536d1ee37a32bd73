//! The subsurface pass in a deferred renderer that knows nothing of it: its own G-buffer with a surface albedo of 8 bits,
//! material numbers in a texture of their own, a stencil, and depth that runs from 1 to 0.
//!
//! ```text
//! cargo run --example deferred -- deferred.png
//! ```

mod engine;

use pollster::FutureExt as _;
use subsurface::presets::{self, Material};
use subsurface::runtime::wgpu;
use subsurface::runtime::{
    Extent, LoadedKernel, Readback, SubsurfaceDescriptor, SubsurfaceInputs, SubsurfacePass, SubsurfaceView,
    Target,
};

use engine::{Ball, Engine};

const SIZE: Extent = Extent::new(480, 270);

/// A jade ball, one of marble and one of plaster, which the kernel has no material for; centimetres, as the engine has it.
fn balls() -> [Ball; 3] {
    let of = |material: Material| (material.parameters().surface.surface_albedo, material.number());
    let plaster = ([0.75, 0.72, 0.68], Engine::NO_MATERIAL);
    [(of(Material::Jade), -3.2), (of(Material::Marble), 0.0), (plaster, 3.2)]
        .map(|((albedo, material), x)| Ball { centre: [x, 0.0, -20.0], radius: 1.5, albedo, material })
}

/// The picture, four bytes of sRGB per pixel; with the subsurface pass or without.
pub(crate) fn draw(with_subsurface: bool) -> Result<Vec<u8>, Box<dyn std::error::Error>> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapter = instance.request_adapter(&Default::default()).block_on()?;
    let (device, queue) = adapter.request_device(&Default::default()).block_on()?;
    let engine = Engine::new(&device, SIZE, balls());

    // Once, and again when the material files change.
    let kernel = LoadedKernel::new(&device, &queue, &presets::kernel())?;
    let descriptor = SubsurfaceDescriptor {
        label: Some("deferred subsurface"),
        stencil: Some(Engine::DEPTH_STENCIL_FORMAT),
        material_ids: true,
        ..SubsurfaceDescriptor::new(Engine::LIGHT_FORMAT)
    };
    let mut subsurface = SubsurfacePass::new(&device, &kernel, &descriptor)?;

    // When the size changes.
    let inputs = SubsurfaceInputs::new(&engine.irradiance.view, &engine.albedo.view, &engine.depth)
        .with_material_ids(&engine.material.view)
        .with_depth_stencil(&engine.depth_stencil.view);
    subsurface.bind(&device, &inputs)?;
    let diffused = subsurface.create_output(&device)?;
    let picture = Target::new(&device, SIZE, Engine::PICTURE_FORMAT, "deferred picture")?;

    // Every frame: the engine's passes, with ours between light and resolve.
    subsurface
        .prepare(&queue, &SubsurfaceView::from_projection(engine.clip_from_view(), SIZE.height, 10.0))?;
    let mut encoder = device.create_command_encoder(&Default::default());
    engine.draw_gbuffer(&mut encoder);
    engine.draw_light(&mut encoder);
    let light = if with_subsurface {
        subsurface.encode(&mut encoder, &diffused.view)?;
        &diffused
    } else {
        &engine.irradiance
    };
    engine.resolve(&device, &mut encoder, &light.view, &picture.view);
    let readback = Readback::record(&device, &mut encoder, &picture.texture);
    queue.submit([encoder.finish()]);
    Ok(readback.wait(&device)?)
}

/// Writes the picture to the file that the command line names.
#[allow(dead_code, reason = "a test draws without a file")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args_os().nth(1).unwrap_or_else(|| "deferred.png".into());
    image::save_buffer(&path, &draw(true)?, SIZE.width, SIZE.height, image::ColorType::Rgba8)?;
    Ok(())
}
