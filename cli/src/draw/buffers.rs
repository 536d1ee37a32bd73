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

impl Buffers {
    /// Multiplies the irradiance by this power of the surface albedo, that of its material where no buffer says.
    pub fn mix_albedo(&mut self, mix: f32, of_materials: &[[f64; 3]]) {
        for (pixel, irradiance) in self.irradiance.iter_mut().enumerate() {
            let surface_albedo = match &self.surface_albedo {
                Some(given) => given[pixel],
                None => of_materials[self.material[pixel] as usize].map(|albedo| albedo as f32),
            };
            for (light, albedo) in irradiance.iter_mut().zip(surface_albedo) {
                *light *= albedo.powf(mix);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn irradiance_is_multiplied_by_a_power_of_the_surface_albedo() {
        let mut buffers = Buffers {
            size: Size { width: 2, height: 1 },
            irradiance: vec![[2.0; 3]; 2],
            depth_mm: vec![1.0; 2],
            surface_albedo: Some(vec![[0.25, 1.0, 0.0], [0.25; 3]]),
            material: vec![0, 0],
            mean_free_path_scale: None,
        };
        buffers.mix_albedo(0.5, &[[0.0; 3]]);
        assert_eq!(buffers.irradiance, [[1.0, 2.0, 0.0], [1.0; 3]]);
        // Without a buffer, the material's own.
        buffers.surface_albedo = None;
        buffers.mix_albedo(1.0, &[[0.5, 0.25, 1.0]]);
        assert_eq!(buffers.irradiance, [[0.5, 0.5, 0.0], [0.5, 0.25, 1.0]]);
    }
}
