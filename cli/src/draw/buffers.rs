//! Somebody's own buffers.

use subsurface_runtime::SubsurfaceView;

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
