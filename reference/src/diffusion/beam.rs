//! The extended source: dipoles all along the refracted beam.

use super::boundary::Boundary;
use super::dipole::exitance;
use super::source::PointSource;
use super::{Medium, Reflectance, legal_radius, quadrature};
use std::f64::consts::PI;

/// Photon beam diffusion (Habel, Christensen and Jarosz 2013) of a perpendicular beam.
///
/// The better dipole's field, integrated over a source that falls off as α′² σt′ e^{-σt′t} with the depth t. Where
/// the paper draws 3 to 5 samples of t, here the integral is taken to convergence (relative 1e-12). Single scattering
/// is not in it.
#[derive(Clone, Copy, Debug)]
pub struct BeamDiffusion {
    power: f64,
    reduced_extinction: f64,
    source: PointSource,
    boundary: Boundary,
    corrected: bool,
}

impl BeamDiffusion {
    /// As published, with the empirical factor κ = 1 - e^{-2σt′(d_r + t)}, where d_r is the distance from the source
    /// at depth t to the point of exit: diffusion overestimates what leaves near the source.
    pub fn new(medium: Medium) -> BeamDiffusion {
        BeamDiffusion { corrected: true, ..BeamDiffusion::uncorrected(medium) }
    }

    /// The extended source without κ: what quantized diffusion (d'Eon and Irving 2011) expands into a sum of
    /// Gaussians.
    pub fn uncorrected(medium: Medium) -> BeamDiffusion {
        let boundary = Boundary::new(medium.refractive_index());
        BeamDiffusion {
            power: medium.reduced_albedo() * medium.reduced_albedo(),
            reduced_extinction: medium.reduced_extinction(),
            source: PointSource::grosjean(medium.reduced_absorption(), boundary.consistent_reflection()),
            boundary,
            corrected: false,
        }
    }

    /// κ of a source at `depth`, `distance` away; lengths in reduced mean free paths.
    fn correction(&self, distance: f64, depth: f64) -> f64 {
        if self.corrected { -libm::expm1(-2.0 * (distance + depth)) } else { 1.0 }
    }

    /// ∫∫ (1 - κ) e^{-t} exitance dt 2πr dr, taken in polar coordinates around the point of entry (t = d cos θ),
    /// where the integrand is smooth.
    fn total_taken_off_by_correction(&self) -> f64 {
        quadrature::half_line(1.0, |distance| {
            quadrature::interval(0.0, 1.0, |cosine| {
                let radius = distance * ((1.0 - cosine) * (1.0 + cosine)).sqrt();
                let depth = distance * cosine;
                // `distance²` is the Jacobian 2πr dr dt = 2π d² dd dcosθ.
                let field = self.source.field(distance * distance, radius, depth);
                2.0 * PI * libm::exp(-2.0 * (distance + depth) - depth) * exitance(&self.boundary, field)
            })
        })
    }
}

impl Reflectance for BeamDiffusion {
    fn reflectance(&self, radius: f64) -> f64 {
        let radius = legal_radius(radius);
        // At r = 0 both forms diverge, the corrected one as a logarithm.
        if radius == 0.0 {
            return if self.power == 0.0 { 0.0 } else { f64::INFINITY };
        }
        self.r_reflectance(radius) / radius
    }

    fn r_reflectance(&self, radius: f64) -> f64 {
        let s = self.reduced_extinction;
        let radius = legal_radius(radius) * s;
        // So near, r/d³ leaves the range of a double.
        if radius < 1e-300 {
            // r·E of a uniform line of sources is 1/(4π) as r → 0; with κ, which is 0 there, nothing is left.
            let limit = if self.corrected { 0.0 } else { self.boundary.flux_weight() / (4.0 * PI) };
            return s * self.power * limit;
        }
        // What lies at a distance r below the surface has a field of its own width.
        let scale = radius.min(1.0);
        let integral = quadrature::half_line(scale, |depth| {
            let field = self.source.field(radius, radius, depth);
            self.correction(libm::hypot(radius, depth), depth)
                * libm::exp(-depth)
                * exitance(&self.boundary, field)
        });
        s * self.power * integral
    }

    /// In closed form without κ; what κ takes off, by quadrature.
    fn total(&self) -> f64 {
        let whole = exitance(&self.boundary, self.source.total_of_beam());
        let taken_off = if self.corrected { self.total_taken_off_by_correction() } else { 0.0 };
        self.power * (whole - taken_off)
    }
}
