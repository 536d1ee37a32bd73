//! Diffusion theories by name.

use super::truth::Truth;
use crate::failure::Failure;
use clap::ValueEnum;
use subsurface_reference::diffusion::{
    BeamDiffusion, BetterDipole, ClassicalDipole, Medium, Reflectance, SingleScattering, WithSingleScattering,
};

/// A diffusion theory, with the exact single scattering added where its paper does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Theory {
    /// Jensen et al. 2001: a point source and its mirror image, plus exact single scattering, which the published
    /// source holds already: it counts twice.
    ClassicalDipole,
    /// The same with a source of multiple scattering alone, plus exact single scattering.
    ClassicalDipoleOnce,
    /// d'Eon 2012: Grosjean's diffusion, plus exact single scattering.
    BetterDipole,
    /// Habel et al. 2013: an extended source with their empirical correction, plus exact single scattering.
    BeamDiffusion,
    /// d'Eon and Irving 2011: the extended source without that correction, plus exact single scattering.
    QuantizedDiffusion,
    /// Light that scattered once, exactly.
    SingleScattering,
}

impl Theory {
    /// Its name in a legend.
    pub(super) fn label(self) -> &'static str {
        match self {
            Self::ClassicalDipole => "dipole + single scattering",
            Self::ClassicalDipoleOnce => "dipole (α²) + single scattering",
            Self::BetterDipole => "better dipole + single scattering",
            Self::BeamDiffusion => "beam diffusion + single scattering",
            Self::QuantizedDiffusion => "quantized diffusion + single scattering",
            Self::SingleScattering => "single scattering",
        }
    }

    /// The theory's profile of the medium that has `surface_albedo` in truth.
    pub(super) fn reflectance(
        self,
        truth: &Truth,
        surface_albedo: f64,
    ) -> Result<Box<dyn Reflectance>, Failure> {
        let medium = Medium::new(truth.medium_at(surface_albedo), 0.0, truth.refractive_index())
            .map_err(|error| Failure::new(error.to_string(), "choose another surface albedo"))?;
        Ok(match self {
            Self::ClassicalDipole => {
                Box::new(WithSingleScattering::new(ClassicalDipole::new(medium), medium))
            }
            Self::ClassicalDipoleOnce => {
                Box::new(WithSingleScattering::new(ClassicalDipole::multiple_scattering(medium), medium))
            }
            Self::BetterDipole => Box::new(WithSingleScattering::new(BetterDipole::new(medium), medium)),
            Self::BeamDiffusion => Box::new(WithSingleScattering::new(BeamDiffusion::new(medium), medium)),
            Self::QuantizedDiffusion => {
                Box::new(WithSingleScattering::new(BeamDiffusion::uncorrected(medium), medium))
            }
            Self::SingleScattering => Box::new(SingleScattering::new(medium)),
        })
    }
}
