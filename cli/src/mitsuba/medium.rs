//! A material as a path tracer knows it.

use subsurface_codegen::Material;
use subsurface_profile::single_scattering_albedo;

/// What lies between the medium and the air.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Boundary {
    /// Nothing: both have one index.
    Matched,
    /// A smooth dielectric.
    Smooth {
        /// Refractive index of the medium, > 1.
        refractive_index: f64,
    },
    /// A rough dielectric.
    Rough {
        /// Refractive index of the medium, > 1.
        refractive_index: f64,
        /// Width of the GGX lobe: the square of the perceptual roughness.
        alpha: f64,
    },
}

impl Boundary {
    /// The boundary with the material's specular lobe.
    pub fn of(material: &Material) -> Self {
        Self::of_index(material.boundary_index(), material.roughness)
    }

    /// The boundary of an index, with a perceptual roughness.
    pub fn of_index(refractive_index: f64, roughness: f64) -> Self {
        if refractive_index <= 1.0 {
            return Self::Matched;
        }
        if roughness == 0.0 {
            return Self::Smooth { refractive_index };
        }
        Self::Rough { refractive_index, alpha: roughness.powi(2).max(1e-3) }
    }

    /// The same without its roughness.
    pub fn smooth(self) -> Self {
        match self {
            Self::Rough { refractive_index, .. } => Self::Smooth { refractive_index },
            Self::Matched | Self::Smooth { .. } => self,
        }
    }
}

/// A homogeneous medium that scatters isotropically.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Medium {
    /// Mean free path per channel, mm.
    pub mean_free_path_mm: [f64; 3],
    /// Single-scattering albedo per channel.
    pub single_scattering_albedo: [f64; 3],
}

impl Medium {
    /// The medium whose half-space has a surface albedo of `surface_albedo` below this boundary, under the light that the
    /// material's profile is for; its mean free path is `scale` times the material's.
    pub fn of(material: &Material, surface_albedo: [f64; 3], scale: f64, boundary: Boundary) -> Self {
        let entry = material.entry();
        let refractive_index = match boundary {
            Boundary::Matched => 1.0,
            Boundary::Smooth { refractive_index } | Boundary::Rough { refractive_index, .. } => {
                refractive_index
            }
        };
        Self {
            mean_free_path_mm: material.slab_mean_free_path_mm().map(|length| scale * length),
            single_scattering_albedo: surface_albedo.map(|albedo| {
                single_scattering_albedo::from_surface_albedo_below(entry, refractive_index, albedo)
            }),
        }
    }
}
