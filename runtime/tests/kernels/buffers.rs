//! What the pass reads in one frame.

use crate::gpu::Gpu;
use crate::setup::SURFACE_ALBEDO;
use subsurface_runtime::{SubsurfaceInputs, wgpu};

/// Distance of a surface where a test says nothing else.
pub(crate) const DISTANCE_MM: f32 = 500.0;

/// Pixels of a frame, rows from the top.
#[derive(Clone, Debug)]
pub(crate) struct Buffers {
    pub(crate) size: [u32; 2],
    /// Red, green, blue and alpha.
    pub(crate) irradiance: Vec<[f32; 4]>,
    /// Surface albedo and the number of the material.
    pub(crate) surface: Vec<[f32; 4]>,
    pub(crate) distance_mm: Vec<f32>,
    /// Factors on the mean free path; `None` for a frame without them.
    pub(crate) scale: Option<Vec<f32>>,
}

impl Buffers {
    /// A white plane of one material that faces the viewer, lit evenly.
    pub(crate) fn plane(size: [u32; 2], material: u32) -> Self {
        let [r, g, b] = SURFACE_ALBEDO.map(|a| a as f32);
        let pixels = (size[0] * size[1]) as usize;
        Self {
            size,
            irradiance: vec![[1.0; 4]; pixels],
            surface: vec![[r, g, b, material as f32]; pixels],
            distance_mm: vec![DISTANCE_MM; pixels],
            scale: None,
        }
    }

    /// Replaces the irradiance.
    pub(crate) fn lit(mut self, pixel: impl Fn(u32, u32) -> [f32; 3]) -> Self {
        self.irradiance = self.each(|x, y| {
            let [r, g, b] = pixel(x, y);
            [r, g, b, 1.0]
        });
        self
    }

    /// Replaces the surface albedo and keeps the materials.
    pub(crate) fn coloured(mut self, pixel: impl Fn(u32, u32) -> [f32; 3]) -> Self {
        let width = self.size[0];
        self.surface = self.each(|x, y| {
            let [r, g, b] = pixel(x, y);
            [r, g, b, self.surface[(y * width + x) as usize][3]]
        });
        self
    }

    /// Replaces the numbers of the materials and keeps the surface albedo.
    pub(crate) fn covered(mut self, pixel: impl Fn(u32, u32) -> f32) -> Self {
        let width = self.size[0];
        self.surface = self.each(|x, y| {
            let [r, g, b, _] = self.surface[(y * width + x) as usize];
            [r, g, b, pixel(x, y)]
        });
        self
    }

    /// Replaces the distances, mm.
    pub(crate) fn distant(mut self, pixel: impl Fn(u32, u32) -> f32) -> Self {
        self.distance_mm = self.each(pixel);
        self
    }

    /// Gives factors on the mean free path.
    pub(crate) fn scaled(mut self, pixel: impl Fn(u32, u32) -> f32) -> Self {
        self.scale = Some(self.each(pixel));
        self
    }

    /// Index of a pixel.
    pub(crate) fn index(&self, x: u32, y: u32) -> usize {
        (y * self.size[0] + x) as usize
    }

    /// One value per pixel.
    pub(crate) fn each<T>(&self, pixel: impl Fn(u32, u32) -> T) -> Vec<T> {
        let [width, height] = self.size;
        (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| pixel(x, y)).collect()
    }

    /// The frame on the device.
    pub(crate) fn upload(&self, gpu: &Gpu) -> Uploaded {
        let rgba = |texels: &[[f32; 4]]| {
            gpu.texture(self.size, wgpu::TextureFormat::Rgba32Float, bytemuck::cast_slice(texels))
        };
        let single = |texels: &[f32]| {
            gpu.texture(self.size, wgpu::TextureFormat::R32Float, bytemuck::cast_slice(texels))
        };
        Uploaded {
            irradiance: rgba(&self.irradiance),
            surface: rgba(&self.surface),
            depth: single(&self.distance_mm),
            scale: self.scale.as_deref().map(single),
        }
    }
}

/// A frame on the device.
#[derive(Debug)]
pub(crate) struct Uploaded {
    pub(crate) irradiance: wgpu::TextureView,
    pub(crate) surface: wgpu::TextureView,
    pub(crate) depth: wgpu::TextureView,
    pub(crate) scale: Option<wgpu::TextureView>,
}

impl Uploaded {
    /// The frame as a pass takes it.
    pub(crate) fn inputs(&self) -> SubsurfaceInputs<'_> {
        let inputs = SubsurfaceInputs::new(&self.irradiance, &self.surface, &self.depth);
        self.scale.as_ref().map_or(inputs, |scale| inputs.with_mean_free_path_scale(scale))
    }
}

/// A number in [0, 1) that is a hash of a pixel and `salt`: the same on every machine.
pub(crate) fn noise(x: u32, y: u32, salt: u32) -> f32 {
    let mut hash = x.wrapping_mul(0x9E37_79B9) ^ y.wrapping_mul(0x85EB_CA6B) ^ salt.wrapping_mul(0xC2B2_AE35);
    for _ in 0..2 {
        hash = (hash ^ (hash >> 16)).wrapping_mul(0x7FEB_352D);
        hash = (hash ^ (hash >> 15)).wrapping_mul(0x846C_A68B);
    }
    (hash >> 8) as f32 / 16_777_216.0
}
