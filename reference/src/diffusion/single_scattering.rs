//! The light that scattered once, beside the theories that leave it out.

use super::{Medium, Reflectance, legal_radius};
use crate::single_scattering;

/// Exact single scattering of a perpendicular beam: [`single_scattering`] of one medium, its albedo included.
#[derive(Clone, Copy, Debug)]
pub struct SingleScattering {
    medium: Medium,
}

impl SingleScattering {
    /// The single scattering of `medium`.
    pub fn new(medium: Medium) -> SingleScattering {
        SingleScattering { medium }
    }
}

impl Reflectance for SingleScattering {
    fn reflectance(&self, radius: f64) -> f64 {
        let radius = legal_radius(radius);
        if radius == 0.0 {
            return if self.medium.single_scattering_albedo() == 0.0 { 0.0 } else { f64::INFINITY };
        }
        self.r_reflectance(radius) / radius
    }

    fn r_reflectance(&self, radius: f64) -> f64 {
        let per_albedo = single_scattering::r_reflectance(self.medium.half_space(), legal_radius(radius))
            .expect("light enters a diffusion theory's medium perpendicularly");
        self.medium.single_scattering_albedo() * per_albedo
    }

    fn total(&self) -> f64 {
        let per_albedo = single_scattering::energy(self.medium.half_space(), 0.0, f64::INFINITY)
            .expect("light enters a diffusion theory's medium perpendicularly");
        self.medium.single_scattering_albedo() * per_albedo
    }
}
