//! The multipole: a slab, whose two surfaces mirror each other.

mod images;
mod modes;

use super::boundary::Boundary;
use super::dipole::SOURCE_DEPTH;
use super::source::PointSource;
use super::{Medium, Reflectance, legal_radius};

/// The multipole of Donner and Jensen (2005) for a slab with the same medium on both sides.
///
/// The classical dipole (source of power α′ at z_r = 1/σt′, D = 1/(3σt′), A as in
/// [`ClassicalDipole`](super::ClassicalDipole)), mirrored at both extrapolated surfaces without end. Where the paper
/// cuts the sum off, here it is complete: near the source the images are summed and the rest is integrated, farther
/// away the same field is summed in the slab's own modes, which fall off exponentially (relative error below 1e-9).
///
/// [`Reflectance`] is for the side where light enters; [`transmittance`](Self::transmittance) is for the other.
#[derive(Clone, Copy, Debug)]
pub struct Multipole {
    power: f64,
    reduced_extinction: f64,
    slab: Slab,
}

/// Why a slab has no multipole.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ThicknessError {
    /// The thickness is not a finite number above 0.
    #[error("thickness {0} is not a finite number above 0: for a half-space use the dipole")]
    NotPositive(f64),
    /// The source, one reduced mean free path deep, would lie outside the slab.
    #[error(
        "thickness {thickness} does not exceed the {reduced_mean_free_path} mean free paths at which the multipole has its \
         source: simulate so thin a layer instead"
    )]
    ThinnerThanSource {
        /// The thickness given, mean free paths.
        thickness: f64,
        /// 1/σt′, mean free paths.
        reduced_mean_free_path: f64,
    },
}

/// Reduced mean free paths. The images lie up to 513 times as deep, and that must not overflow.
const LARGEST_THICKNESS: f64 = 1e300;

/// A slab between two surfaces at which the fluence vanishes, with a source in it. Reduced mean free paths.
#[derive(Clone, Copy, Debug)]
struct Slab {
    thickness: f64,
    extrapolation: f64,
    transport_extinction: f64,
}

/// The side of a slab on which light leaves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Entry,
    Far,
}

impl Slab {
    /// Distance of the two surfaces at which the fluence vanishes.
    fn extrapolated_thickness(&self) -> f64 {
        self.thickness + 2.0 * self.extrapolation
    }

    /// The radius at which both sums are quick and neither cancels.
    ///
    /// Farther out, the images add up to something smaller than each of them, by e^{-π² r/(2 σtr d²)} with absorption.
    /// Farther in, the modes do, by e^{-σtr d²/(2r)}, and their number grows as d/r.
    fn crossover_radius(&self) -> f64 {
        let d = self.extrapolated_thickness();
        d * (self.transport_extinction * d).max(0.5)
    }

    /// Flux through a surface at `radius`, of a source of power 1.
    fn flux(&self, side: Side, radius: f64) -> f64 {
        if radius >= self.crossover_radius() {
            modes::flux(self, side, radius)
        } else {
            images::flux(self, side, radius)
        }
    }

    /// ∫ flux 2πr dr: the source of a plane, for which the diffusion equation is solved by hyperbolic functions.
    fn total(&self, side: Side) -> f64 {
        let to_surface = match side {
            Side::Entry => SOURCE_DEPTH,
            Side::Far => self.thickness - SOURCE_DEPTH,
        };
        let (b, d) = (self.extrapolation, self.extrapolated_thickness());
        // From the source to where the fluence vanishes on the other side.
        let to_other_side = self.thickness - to_surface + b;
        let s = self.transport_extinction;
        if s == 0.0 {
            return to_other_side / d;
        }
        // cosh(s b) sinh(s z)/sinh(s d) in exponentials that cannot overflow, with z + b + to_surface = d.
        0.5 * (libm::exp(-s * to_surface) + libm::exp(-s * (to_surface + 2.0 * b)))
            * libm::expm1(-2.0 * s * to_other_side)
            / libm::expm1(-2.0 * s * d)
    }
}

impl Multipole {
    /// The multipole of a slab of `medium`, `thickness` in mean free paths.
    ///
    /// # Errors
    ///
    /// A thickness that is not a finite number, or not more than 1/σt′ = 1/(1 - gα) mean free paths.
    pub fn new(medium: Medium, thickness: f64) -> Result<Multipole, ThicknessError> {
        if !(thickness > 0.0 && thickness.is_finite()) {
            return Err(ThicknessError::NotPositive(thickness));
        }
        let reduced_extinction = medium.reduced_extinction();
        if thickness * reduced_extinction <= SOURCE_DEPTH {
            let reduced_mean_free_path = 1.0 / reduced_extinction;
            return Err(ThicknessError::ThinnerThanSource { thickness, reduced_mean_free_path });
        }
        let reflection = Boundary::new(medium.refractive_index()).classical_reflection();
        let source = PointSource::classical(medium.reduced_absorption(), reflection);
        let slab = Slab {
            thickness: (thickness * reduced_extinction).min(LARGEST_THICKNESS),
            extrapolation: source.extrapolation(),
            transport_extinction: source.transport_extinction(),
        };
        Ok(Multipole { power: medium.reduced_albedo(), reduced_extinction, slab })
    }

    /// T(r), energy per unit area (mean free paths⁻²) that leaves the far side of the slab, at `radius` from the axis
    /// of the beam.
    pub fn transmittance(&self, radius: f64) -> f64 {
        self.per_area(Side::Far, radius)
    }

    /// ∫ T(r) 2πr dr.
    pub fn total_transmittance(&self) -> f64 {
        self.power * self.slab.total(Side::Far)
    }

    fn per_area(&self, side: Side, radius: f64) -> f64 {
        let s = self.reduced_extinction;
        s * s * self.power * self.slab.flux(side, legal_radius(radius) * s)
    }
}

impl Reflectance for Multipole {
    fn reflectance(&self, radius: f64) -> f64 {
        self.per_area(Side::Entry, radius)
    }

    fn total(&self) -> f64 {
        self.power * self.slab.total(Side::Entry)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn images_and_modes_are_the_same_field() {
        for transport_extinction in [0.0, 0.01, 0.3, 1.2] {
            for thickness in [1.01, 2.0, 10.0, 300.0] {
                let slab = Slab { thickness, extrapolation: 2.0 / 3.0, transport_extinction };
                for side in [Side::Entry, Side::Far] {
                    for factor in [0.8, 1.0, 1.2] {
                        let radius = factor * slab.crossover_radius();
                        let (i, m) = (images::flux(&slab, side, radius), modes::flux(&slab, side, radius));
                        // The integral that ends the sum of images is good to 1e-11 of the largest of them.
                        assert!((i - m).abs() <= 1e-9 * m, "{slab:?} {side:?} {radius}: {i} {m}");
                    }
                }
            }
        }
    }
}
