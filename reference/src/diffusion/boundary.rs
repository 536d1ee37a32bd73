//! What a smooth surface does to diffuse light that reaches it from below.

use super::quadrature;
use crate::fresnel;

/// Moments of the Fresnel transmittance from inside, T(μ), μ the cosine with the normal inside.
///
/// The papers write moments of the reflectance, C₁ = ∫ (1 - T) μ dμ and C₂ = ∫ (1 - T) μ² dμ over [0, 1] (d'Eon
/// and Irving 2011), and give polynomials for them. Here they are integrals, taken over the cosine μₒ outside:
/// Snell's law gives μ dμ = μₒ dμₒ/η², which leaves out the angles of total reflection and with them the root at
/// their edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct Boundary {
    /// ∫ T μ dμ = ½ - C₁.
    first: f64,
    /// ∫ T μ² dμ = ⅓ - C₂.
    second: f64,
}

impl Boundary {
    pub(super) fn new(refractive_index: f64) -> Boundary {
        if refractive_index == 1.0 {
            return Boundary { first: 1.0 / 2.0, second: 1.0 / 3.0 };
        }
        let moment = |power: i32| {
            let integral = quadrature::interval(0.0, 1.0, |outside| {
                let inside = fresnel::refracted_cosine(outside, refractive_index);
                (1.0 - fresnel::reflectance(inside, refractive_index)) * inside.powi(power) * outside
            });
            integral / (refractive_index * refractive_index)
        };
        Boundary { first: moment(0), second: moment(1) }
    }

    /// A of the classical dipole, (1 + F_dr)/(1 - F_dr) with F_dr = 2C₁ (Jensen et al. 2001; there F_dr
    /// is a fit).
    pub(super) fn classical_reflection(&self) -> f64 {
        (1.0 - self.first) / self.first
    }

    /// A = (1 + 3C₂)/(1 - 2C₁), consistent with the exitance (d'Eon and Irving 2011; d'Eon 2012).
    pub(super) fn consistent_reflection(&self) -> f64 {
        (1.0 - 1.5 * self.second) / self.first
    }

    /// C_φ = (1 - 2C₁)/4, the weight of the fluence in the exitance (d'Eon and Irving 2011).
    pub(super) fn fluence_weight(&self) -> f64 {
        0.5 * self.first
    }

    /// C_E = (1 - 3C₂)/2, the weight of the flux in the exitance (d'Eon and Irving 2011).
    pub(super) fn flux_weight(&self) -> f64 {
        1.5 * self.second
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn matched_boundary_is_the_limit_of_a_weak_one() {
        // Transmittance differs from 1 only within about √(η - 1) of grazing.
        let (matched, weak) = (Boundary::new(1.0), Boundary::new(1.0 + 1e-9));
        assert!((matched.first - weak.first).abs() < 1e-7);
        assert!((matched.second - weak.second).abs() < 1e-7);
        assert_eq!(matched.classical_reflection(), 1.0);
        assert_eq!(matched.consistent_reflection(), 1.0);
        assert_eq!(matched.fluence_weight(), 0.25);
        assert_eq!(matched.flux_weight(), 0.5);
    }

    #[test]
    fn reciprocity_gives_walshs_diffuse_reflectance() {
        // η²(1 - F_inside) = 1 - F_outside, and F_outside has a closed form (Walsh 1926; Duntley 1942).
        for n in [1.1_f64, 1.33, 1.4, 1.5, 2.0] {
            let n2 = n * n;
            let walsh = 0.5
                + (n - 1.0) * (3.0 * n + 1.0) / (6.0 * (n + 1.0) * (n + 1.0))
                + n2 * (n2 - 1.0) * (n2 - 1.0) / (n2 + 1.0).powi(3) * ((n - 1.0) / (n + 1.0)).ln()
                - 2.0 * n * n2 * (n2 + 2.0 * n - 1.0) / ((n2 + 1.0) * (n2 * n2 - 1.0))
                + 8.0 * n2 * n2 * (n2 * n2 + 1.0) / ((n2 + 1.0) * (n2 * n2 - 1.0) * (n2 * n2 - 1.0)) * n.ln();
            let outside = 1.0 - 2.0 * n2 * Boundary::new(n).first;
            assert!((outside - walsh).abs() < 1e-10, "{n}: {outside} for {walsh}");
        }
    }

    #[test]
    fn moments_are_those_that_the_papers_fit() {
        // Polynomials of d'Eon and Irving 2011 for 2C₁ and 3C₂ at η = 1.4, and Jensen's F_dr (2001), which are good
        // to about 0.005.
        let boundary = Boundary::new(1.4);
        let n = 1.4_f64;
        let two_c1 = 1.0 - 2.0 * boundary.first;
        let fitted_two_c1 = -9.23372 + 22.2272 * n - 20.9292 * n.powi(2) + 10.2291 * n.powi(3)
            - 2.54396 * n.powi(4)
            + 0.254913 * n.powi(5);
        assert!((two_c1 - fitted_two_c1).abs() < 5e-3);
        let jensen = -1.440 / n.powi(2) + 0.710 / n + 0.668 + 0.0636 * n;
        assert!((two_c1 - jensen).abs() < 5e-3);
        let three_c2 = -1641.1 + 135.926 / n.powi(3) - 656.175 / n.powi(2) + 1376.53 / n + 1213.67 * n
            - 568.556 * n.powi(2)
            + 164.798 * n.powi(3)
            - 27.0181 * n.powi(4)
            + 1.91826 * n.powi(5);
        assert!((1.0 - 3.0 * boundary.second - three_c2).abs() < 5e-3);
    }
}
