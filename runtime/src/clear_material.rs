//! What is clear: it absorbs light, and does not scatter it.

use crate::bindings::clear::{ClearObject, ObjectTransform};

/// Largest absorption, per mm: times no way it is still 0.
const MOST_ABSORPTION: f32 = 1e20;

/// A material that absorbs light on its way through and refracts it where it enters, such as glass, water or a soap bubble.
///
/// The compiler makes one of each `Clear(…)` of a set, as a constant of the generated module `clear`.
///
/// ```
/// use subsurface_runtime::ClearMaterial;
///
/// let glass = ClearMaterial { shell_thickness_mm: Some(2.0), ..ClearMaterial::default() };
/// assert_eq!((glass.absorption_per_mm, glass.refractive_index), ([0.0; 3], 1.5));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClearMaterial {
    /// Absorption coefficient σ, per mm, red, green, blue: after d mm e^(−σ d) of the light is left. By default 0.
    pub absorption_per_mm: [f32; 3],
    /// Refractive index over that of what is outside, 1 to 2; by default 1.5.
    pub refractive_index: f32,
    /// Roughness of its boundary, 0 to 1; by default 0.
    pub roughness: f32,
    /// Thickness in mm of the walls of what is hollow; `None`, the default, for what is filled.
    pub shell_thickness_mm: Option<f32>,
}

impl Default for ClearMaterial {
    fn default() -> Self {
        Self { absorption_per_mm: [0.0; 3], refractive_index: 1.5, roughness: 0.0, shell_thickness_mm: None }
    }
}

impl ClearMaterial {
    /// As the shaders take it.
    pub(crate) fn uniform(&self, transform: ObjectTransform, coverage: f32) -> ClearObject {
        ClearObject {
            transform,
            absorption_per_mm: self
                .absorption_per_mm
                .map(|absorption| absorption.clamp(0.0, MOST_ABSORPTION)),
            refractive_index: self.refractive_index.clamp(1.0, 2.0),
            roughness: self.roughness.clamp(0.0, 1.0),
            shell_thickness_mm: self.shell_thickness_mm.unwrap_or_default().max(0.0),
            coverage: coverage.clamp(0.0, 1.0),
            padding_140: [0; 4],
        }
    }
}
