//! What every theory answers.

use super::{Medium, SingleScattering};
use std::fmt::Debug;

/// Where the light leaves that entered perpendicularly at one point.
///
/// Radii are in mean free paths. A negative radius is read as 0, an infinite one gives the limit, NaN gives NaN.
pub trait Reflectance: Debug + Send + Sync {
    /// R(r), energy per unit area (mean free paths⁻²) for an energy of 1 that entered. May be infinite at r = 0,
    /// nowhere else.
    fn reflectance(&self, radius: f64) -> f64;

    /// r·R(r) (mean free paths⁻¹). Finite everywhere, r = 0 included.
    fn r_reflectance(&self, radius: f64) -> f64 {
        let radius = legal_radius(radius);
        radius * self.reflectance(radius)
    }

    /// ∫ R(r) 2πr dr, the surface albedo by this theory. May exceed 1: diffusion theory does not conserve energy.
    fn total(&self) -> f64;
}

/// A theory of multiple scattering, and the light that scattered once, exactly.
///
/// This is what the papers mean by "dipole + single scattering" (Christensen and Burley 2015, figure 6). Whether the
/// sum counts single scattering once is for the theory: [`BetterDipole`](super::BetterDipole) and
/// [`BeamDiffusion`](super::BeamDiffusion) leave it out, [`ClassicalDipole::new`](super::ClassicalDipole::new) does
/// not, and [`ClassicalDipole::multiple_scattering`](super::ClassicalDipole::multiple_scattering) is the one that does.
#[derive(Clone, Copy, Debug)]
pub struct WithSingleScattering<T> {
    multiple: T,
    single: SingleScattering,
}

impl<T: Reflectance> WithSingleScattering<T> {
    /// Adds the single scattering of `medium`, which should be the one of `multiple`.
    pub fn new(multiple: T, medium: Medium) -> WithSingleScattering<T> {
        WithSingleScattering { multiple, single: SingleScattering::new(medium) }
    }

    /// The theory of multiple scattering alone.
    pub fn multiple(&self) -> &T {
        &self.multiple
    }

    /// Single scattering alone.
    pub fn single(&self) -> &SingleScattering {
        &self.single
    }
}

impl<T: Reflectance> Reflectance for WithSingleScattering<T> {
    fn reflectance(&self, radius: f64) -> f64 {
        self.multiple.reflectance(radius) + self.single.reflectance(radius)
    }

    fn r_reflectance(&self, radius: f64) -> f64 {
        self.multiple.r_reflectance(radius) + self.single.r_reflectance(radius)
    }

    fn total(&self) -> f64 {
        self.multiple.total() + self.single.total()
    }
}

/// A radius as the theories read it: negative means 0; infinite means one so large that its reciprocal and its
/// products with a medium's constants still are numbers; NaN stays NaN.
pub(super) fn legal_radius(radius: f64) -> f64 {
    /// Products of a few constants with it do not overflow, and nothing is left at this distance.
    const LARGEST_RADIUS: f64 = 1e300;
    radius.clamp(0.0, LARGEST_RADIUS)
}
