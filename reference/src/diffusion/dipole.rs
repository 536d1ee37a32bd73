//! Dipoles: one point source, one image.

use super::boundary::Boundary;
use super::source::{Field, PointSource};
use super::{Medium, Reflectance, legal_radius};

/// Depth of the source of a dipole, in reduced mean free paths: where a beam's light has its mean.
pub(super) const SOURCE_DEPTH: f64 = 1.0;

/// The dipole of Jensen, Marschner, Levoy and Hanrahan (2001).
///
/// D = 1/(3σt′), z_r = 1/σt′, z_v = z_r + 4AD with A = (1 + F_dr)/(1 - F_dr); F_dr is the integral of the Fresnel
/// reflectance where the paper has a fit, so at a matched boundary A is 1 (the fit gives 1.003).
#[derive(Clone, Copy, Debug)]
pub struct ClassicalDipole {
    power: f64,
    reduced_extinction: f64,
    source: PointSource,
}

impl ClassicalDipole {
    /// The dipole as published: a source of power α′.
    ///
    /// The classical theory approximates all of the light that leaves such a source, also what leaves the medium
    /// without another scattering. Jensen et al. add single scattering to it nevertheless (S = S_d + S⁽¹⁾), and so
    /// count it twice.
    pub fn new(medium: Medium) -> ClassicalDipole {
        ClassicalDipole::with_power(medium, medium.reduced_albedo())
    }

    /// The dipole for the light that scattered at least twice: a source of power α′².
    ///
    /// To be summed with single scattering. The second α′ is the part of the light that scatters again, as in the
    /// theories built on Grosjean's function; no paper prints it for the classical dipole.
    pub fn multiple_scattering(medium: Medium) -> ClassicalDipole {
        ClassicalDipole::with_power(medium, medium.reduced_albedo() * medium.reduced_albedo())
    }

    fn with_power(medium: Medium, power: f64) -> ClassicalDipole {
        let reflection = Boundary::new(medium.refractive_index()).classical_reflection();
        ClassicalDipole {
            power,
            reduced_extinction: medium.reduced_extinction(),
            source: PointSource::classical(medium.reduced_absorption(), reflection),
        }
    }
}

impl Reflectance for ClassicalDipole {
    fn reflectance(&self, radius: f64) -> f64 {
        let s = self.reduced_extinction;
        s * s * self.power * self.source.field(1.0, legal_radius(radius) * s, SOURCE_DEPTH).flux
    }

    /// α′/2 (e^{-σtr z_r} + e^{-σtr z_v}): Jensen and Buhler 2002, who write out σtr z_r = √(3(1 - α′)).
    fn total(&self) -> f64 {
        self.power * self.source.total(SOURCE_DEPTH).flux
    }
}

/// The dipole of d'Eon (2012, "A Better Dipole").
///
/// Grosjean's D = (2σa + σs′)/(3σt′²), an exitance C_φ φ + C_E E with the exact Fresnel moments, and the A that is
/// consistent with them. Of the light that its source sends out, the first scattering's α′, Grosjean's function
/// describes what scatters again: the power is α′², and single scattering is not in it.
#[derive(Clone, Copy, Debug)]
pub struct BetterDipole {
    power: f64,
    reduced_extinction: f64,
    source: PointSource,
    boundary: Boundary,
}

impl BetterDipole {
    /// The better dipole of `medium`, without single scattering.
    pub fn new(medium: Medium) -> BetterDipole {
        let boundary = Boundary::new(medium.refractive_index());
        BetterDipole {
            power: medium.reduced_albedo() * medium.reduced_albedo(),
            reduced_extinction: medium.reduced_extinction(),
            source: PointSource::grosjean(medium.reduced_absorption(), boundary.consistent_reflection()),
            boundary,
        }
    }
}

impl Reflectance for BetterDipole {
    fn reflectance(&self, radius: f64) -> f64 {
        let s = self.reduced_extinction;
        let field = self.source.field(1.0, legal_radius(radius) * s, SOURCE_DEPTH);
        s * s * self.power * exitance(&self.boundary, field)
    }

    fn total(&self) -> f64 {
        self.power * exitance(&self.boundary, self.source.total(SOURCE_DEPTH))
    }
}

/// Light that leaves through the surface, where `field` is below it (d'Eon and Irving 2011).
pub(super) fn exitance(boundary: &Boundary, field: Field) -> f64 {
    boundary.fluence_weight() * field.fluence + boundary.flux_weight() * field.flux
}
