//! Buffers on the device.

use subsurface_codegen::Compilation;
use subsurface_runtime::{Extent, SubsurfaceInputs, Target, wgpu};

use super::beyond_device;
use super::buffers::Buffers;
use super::device::Device;
use crate::failure::Failure;

/// How exactly irradiance is kept on the device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// As a renderer has it: `Rgba16Float`.
    Half,
    /// As it was given: `Rgba32Float`.
    Single,
}

/// [`Buffers`] as the textures that a subsurface pass reads.
#[derive(Clone, Debug)]
pub struct Uploaded {
    /// Size of every texture.
    pub size: Extent,
    /// Diffuse irradiance, linear; alpha 1.
    pub irradiance: Target,
    /// Surface albedo and material number; `Rgba32Float`.
    pub surface: Target,
    /// Distance along the view axis (mm), 0 for background; `R32Float`.
    pub distance: Target,
    /// Factor on the mean free path; `R32Float`.
    pub mean_free_path_scale: Option<Target>,
}

/// The largest half float.
const LARGEST_HALF: f32 = 65504.0;

impl Uploaded {
    /// Uploads `buffers`, whose material numbers are those of `materials`.
    pub fn new(
        device: &Device,
        buffers: &Buffers,
        materials: &Compilation,
        precision: Precision,
    ) -> Result<Self, Failure> {
        let size = Extent::new(buffers.size.width, buffers.size.height);
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
        let upload = |format, texels: &[u8], label| {
            Target::from_texels(&device.device, &device.queue, size, format, label, texels)
                .map_err(|error| beyond_device(&error))
        };
        let single = |values: &[f32], label| {
            upload(wgpu::TextureFormat::R32Float, bytemuck::cast_slice(values), label)
        };
        let colours = buffers.irradiance.iter().map(|[r, g, b]| [*r, *g, *b, 1.0]);
        let irradiance = match precision {
            Precision::Single => {
                let texels: Vec<[f32; 4]> = colours.collect();
                upload(wgpu::TextureFormat::Rgba32Float, bytemuck::cast_slice(&texels), "irradiance")
            }
            Precision::Half => {
                let half = |value: f32| exr::prelude::f16::from_f32(value.min(LARGEST_HALF)).to_bits();
                let texels: Vec<[u16; 4]> = colours.map(|colour| colour.map(half)).collect();
                upload(wgpu::TextureFormat::Rgba16Float, bytemuck::cast_slice(&texels), "irradiance")
            }
        }?;
        let scale = buffers.mean_free_path_scale.as_ref();
        Ok(Self {
            size,
            irradiance,
            surface: upload(wgpu::TextureFormat::Rgba32Float, bytemuck::cast_slice(&surface), "surface")?,
            distance: single(&buffers.depth_mm, "distance")?,
            mean_free_path_scale: scale.map(|scale| single(scale, "mean free path scale")).transpose()?,
        })
    }

    /// The textures as a subsurface pass takes them.
    pub fn inputs(&self) -> SubsurfaceInputs<'_> {
        let inputs = SubsurfaceInputs::new(&self.irradiance.view, &self.surface.view, &self.distance.view);
        let scale = self.mean_free_path_scale.as_ref();
        scale.map_or(inputs, |scale| inputs.with_mean_free_path_scale(&scale.view))
    }
}
