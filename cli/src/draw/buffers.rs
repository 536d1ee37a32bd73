//! The subsurface pass alone, on somebody's own buffers.

use subsurface_codegen::Compilation;
use subsurface_runtime::{Path, SubsurfaceView, wgpu};

use super::device::Device;
use super::uploaded::{Precision, Uploaded};
use super::{beyond_device, out_of_order, subsurface_pass};
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

impl PixelScale {
    /// How the subsurface pass sees buffers of this height, whose depths are distances in mm.
    pub fn view(self, height_pixels: u32) -> SubsurfaceView {
        match self {
            Self::MillimetresPerPixel(mm) => SubsurfaceView::orthographic_distances(mm),
            Self::FovYDegrees(degrees) => {
                SubsurfaceView::perspective_distances(degrees.to_radians(), height_pixels)
            }
        }
    }
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
    /// Factor on the mean free path, ≥ 0; `None`: 1.
    pub mean_free_path_scale: Option<Vec<f32>>,
}

/// Runs the subsurface pass alone: the diffused irradiance, background passed through.
pub fn diffuse(
    buffers: &Buffers,
    materials: &Compilation,
    scale: PixelScale,
    path: Option<Path>,
    frame_index: u32,
) -> Result<LinearPicture, Failure> {
    let device = Device::open()?;
    device.checked(|| {
        let uploaded = Uploaded::new(&device, buffers, materials, Precision::Single)?;
        let format = wgpu::TextureFormat::Rgba32Float;
        let mut pass = subsurface_pass(&device, &materials.parts, format, path)?;
        pass.bind(&device.device, &uploaded.inputs()).map_err(|error| beyond_device(&error))?;
        let output = pass.create_output(&device.device).map_err(out_of_order)?;
        let view = scale.view(buffers.size.height).with_frame_index(frame_index);
        pass.prepare(&device.queue, &view).map_err(out_of_order)?;
        device.submit(|encoder| pass.encode(encoder, &output.view))?;
        let texels = device.read(&output.texture)?;
        Ok(LinearPicture {
            size: buffers.size,
            pixels: texels.into_iter().map(|[r, g, b, _]| [r, g, b]).collect(),
        })
    })
}
