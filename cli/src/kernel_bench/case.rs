//! What is diffused.

use super::subject::Subject;
use crate::draw::{Buffers, PixelScale};
use subsurface_runtime::SubsurfaceView;

/// Buffers, and how they are seen.
#[derive(Clone, Debug)]
pub struct Case {
    /// Name in tables and files.
    pub name: String,
    /// What the pass reads.
    pub buffers: Buffers,
    /// How large a pixel is.
    pub scale: PixelScale,
}

/// Half floats between a half and 1 lie so far apart: an albedo that went through a G-buffer is off by less.
const HALF_FLOAT_STEP: f32 = 1.0 / 2048.0;

impl Case {
    /// How the pass sees the buffers.
    pub fn view(&self) -> SubsurfaceView {
        self.scale.view(self.buffers.size.height)
    }

    /// The pixels that scatter.
    pub fn translucent(&self) -> Vec<usize> {
        (0..self.buffers.depth_mm.len()).filter(|&pixel| self.buffers.depth_mm[pixel] > 0.0).collect()
    }

    /// Half of the pixels that scatter are nearer than this, mm; `None` where none scatters.
    pub fn median_distance_mm(&self) -> Option<f32> {
        let mut distances: Vec<f32> = self.buffers.depth_mm.iter().copied().filter(|mm| *mm > 0.0).collect();
        let middle = distances.len() / 2;
        (!distances.is_empty()).then(|| *distances.select_nth_unstable_by(middle, f32::total_cmp).1)
    }

    /// Millimetres that a pixel spans at the median distance; NaN where none scatters.
    pub fn millimetres_per_pixel(&self) -> f64 {
        let at = |distance_mm| f64::from(self.view().millimetres_per_pixel(distance_mm));
        self.median_distance_mm().map_or(f64::NAN, at)
    }

    /// The buffers with the subject's number; a subject with the material set of the case keeps the numbers.
    pub(super) fn buffers_of(&self, subject: &Subject) -> Buffers {
        let mut buffers = self.buffers.clone();
        if let Some(number) = subject.only_number() {
            buffers.material.fill(number);
        }
        buffers
    }

    /// Whether every translucent pixel has the material and the surface albedo of `subject`: many published methods
    /// know one profile per object.
    pub fn is_uniform(&self, subject: &Subject) -> bool {
        let number = subject.number();
        let own = subject.material().surface_albedo.map(|albedo| albedo as f32);
        let near = |albedo: &[f32; 3]| {
            albedo.iter().zip(own).all(|(albedo, own)| (albedo - own).abs() <= HALF_FLOAT_STEP)
        };
        let buffers = &self.buffers;
        self.translucent().into_iter().all(|pixel| {
            (subject.only_number().is_some() || buffers.material[pixel] == number)
                && buffers.surface_albedo.as_ref().is_none_or(|albedos| near(&albedos[pixel]))
                && buffers.mean_free_path_scale.as_ref().is_none_or(|scales| scales[pixel] == 1.0)
        })
    }
}
