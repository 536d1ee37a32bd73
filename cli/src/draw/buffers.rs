//! The subsurface pass alone, on somebody's own buffers.

use subsurface_codegen::Compilation;
use subsurface_runtime::{Extent, SubsurfaceInputs, SubsurfacePass, SubsurfaceView, Target, wgpu};

use super::device::Device;
use super::{beyond_device, kernel};
use crate::failure::Failure;
use crate::picture::LinearPicture;
use crate::scene::camera::Size;

/// How many millimetres a pixel covers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PixelScale {
    /// The same everywhere: an orthographic view (mm per pixel, > 0).
    MillimetresPerPixel(f32),
    /// In proportion to `Z`: a perspective view of this vertical field of view (degrees, in (0, 180)).
    FovYDegrees(f32),
}

/// Somebody's own buffers for the subsurface pass, rows from the top.
#[derive(Clone, Debug)]
pub struct Buffers {
    /// Size of every buffer.
    pub size: Size,
    /// Diffuse irradiance, linear.
    pub irradiance: Vec<[f32; 3]>,
    /// Distance along the view axis (mm); 0 is background.
    pub depth_mm: Vec<f32>,
    /// Surface albedo, in [0, 1]; `None`: that of the material.
    pub surface_albedo: Option<Vec<[f32; 3]>>,
    /// Number of the material, checked against the set.
    pub material: Vec<u32>,
}

/// Runs the subsurface pass alone: the diffused irradiance, background passed through.
pub fn diffuse(
    buffers: &Buffers,
    materials: &Compilation,
    scale: PixelScale,
    taps: u32,
    seed: u32,
) -> Result<LinearPicture, Failure> {
    let device = Device::open()?;
    let kernel = kernel(materials)?;
    let size = Extent::new(buffers.size.width, buffers.size.height);
    let view = match scale {
        PixelScale::MillimetresPerPixel(mm) => SubsurfaceView::orthographic_distances(mm),
        PixelScale::FovYDegrees(degrees) => {
            SubsurfaceView::perspective_distances(degrees.to_radians(), size.height)
        }
    };
    let own_surface_albedo =
        |number: u32| materials.set.materials[number as usize].surface_albedo.map(|a| a as f32);
    let surface: Vec<[f32; 4]> = buffers
        .material
        .iter()
        .enumerate()
        .map(|(pixel, &number)| {
            let given = buffers.surface_albedo.as_ref().map(|albedos| albedos[pixel]);
            let [red, green, blue] = given.unwrap_or_else(|| own_surface_albedo(number));
            [red, green, blue, number as f32]
        })
        .collect();
    let irradiance: Vec<[f32; 4]> = buffers.irradiance.iter().map(|[r, g, b]| [*r, *g, *b, 1.0]).collect();
    device.checked(|| {
        let rgba32 = wgpu::TextureFormat::Rgba32Float;
        let upload = |format, texels, label| {
            Target::from_texels(&device.device, &device.queue, size, format, label, texels)
                .map_err(|error| beyond_device(&error))
        };
        let irradiance = upload(rgba32, bytemuck::cast_slice(&irradiance), "diffuse irradiance")?;
        let surface = upload(rgba32, bytemuck::cast_slice(&surface), "diffuse surface")?;
        let distances = bytemuck::cast_slice(&buffers.depth_mm);
        let depth = upload(wgpu::TextureFormat::R32Float, distances, "diffuse distance")?;
        let mut pass = SubsurfacePass::new(&device.device, &kernel, rgba32, None);
        let inputs = SubsurfaceInputs {
            irradiance: &irradiance.view,
            surface: &surface.view,
            depth: &depth.view,
            depth_stencil: None,
        };
        pass.resize(&device.device, size, &inputs).map_err(|error| beyond_device(&error))?;
        pass.prepare(&device.queue, &view.with_taps(taps).with_seed(seed));
        let label = Some("diffuse");
        let mut encoder = device.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label });
        pass.encode(&mut encoder);
        device.queue.submit([encoder.finish()]);
        let Some(output) = pass.output() else {
            return Err(Failure::new("the pass has no output", "please report this as a defect"));
        };
        let texels = device.read(&output.texture)?;
        Ok(LinearPicture {
            size: buffers.size,
            pixels: texels.into_iter().map(|[r, g, b, _]| [r, g, b]).collect(),
        })
    })
}
