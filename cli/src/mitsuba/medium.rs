//! A material as a path tracer knows it.

use subsurface_codegen::{DiffuseLobe, Material};
use subsurface_profile::single_scattering_albedo::{self, Entry};

/// What lies between the medium and the air.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Boundary {
    /// Nothing: both have one index.
    Matched,
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
        // F₀ = ((η - 1)/(η + 1))², of a mirror without end below 1.
        let root = material.reflectance_at_normal.sqrt().min(0.9);
        let refractive_index = material.refractive_index.unwrap_or((1.0 + root) / (1.0 - root));
        if refractive_index <= 1.0 {
            return Self::Matched;
        }
        Self::Rough { refractive_index, alpha: material.roughness.powi(2).max(1e-3) }
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
    /// material's profile is for.
    pub fn of(material: &Material, surface_albedo: [f64; 3], boundary: Boundary) -> Self {
        let entry = match material.diffuse {
            DiffuseLobe::Chandrasekhar(entry) => entry,
            _ => material.profile.model.entry().unwrap_or(Entry::Searchlight),
        };
        let refractive_index = match boundary {
            Boundary::Matched => 1.0,
            Boundary::Rough { refractive_index, .. } => refractive_index,
        };
        Self {
            mean_free_path_mm: material.slab_mean_free_path_mm(),
            single_scattering_albedo: surface_albedo.map(|albedo| {
                single_scattering_albedo::from_surface_albedo_below(entry, refractive_index, albedo)
            }),
        }
    }
}
