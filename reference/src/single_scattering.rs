//! What leaves after exactly one scattering, by quadrature, for perpendicular entry.
//!
//! Light enters along the normal, is scattered at the depth z, and leaves at the radius r along ρ = √(r² + z²):
//!
//! R₁(r) = α ∫₀^∞ e^(-z) p(-z/ρ) e^(-ρ) T(z/ρ) (z/ρ) / ρ² dz,
//!
//! with the phase function p and the boundary's transmittance T. With z = r sinh t and w = e^(-t) this becomes
//!
//! r·R₁(r) = α ∫₀¹ e^(-r/w) p(-μ) T(μ) 2 (1 - w²) / (1 + w²)² dw,  μ = (1 - w²)/(1 + w²),
//!
//! in which the integral over r is an exponential too. What the boundary sends back in has to scatter again before it
//! can leave, so this is all of n = 1, with a refractive mismatch as well.

use std::f64::consts::{PI, TAU};
use std::sync::LazyLock;

use crate::gauss_legendre::GaussLegendre;
use crate::{Entry, HalfSpace, fresnel};

static PANEL: LazyLock<GaussLegendre<16>> = LazyLock::new(GaussLegendre::new);

/// r·R₁(r) / α per mean free path at `radius` ≥ 0 in mean free paths: the energy after one scattering that leaves
/// per area, times the radius. [`None`] for an entry that is not perpendicular. Good to 10⁻¹⁰ of its value at r = 0.
pub fn r_reflectance(half_space: &HalfSpace, radius: f64) -> Option<f64> {
    integrate(half_space, |w| libm::exp(-radius / w))
}

/// Energy per α that leaves after one scattering between the radii `from` and `to` (infinity is allowed).
/// [`None`] for an entry that is not perpendicular.
pub fn energy(half_space: &HalfSpace, from: f64, to: f64) -> Option<f64> {
    let integral = integrate(half_space, |w| w * (libm::exp(-from / w) - libm::exp(-to / w)))?;
    Some(TAU * integral)
}

/// ∫ `f(w)` p T 2(1 - w²)/(1 + w²)² dw over the exits that the boundary lets through.
fn integrate(half_space: &HalfSpace, f: impl Fn(f64) -> f64) -> Option<f64> {
    if half_space.entry() != Entry::Searchlight {
        return None;
    }
    let g = half_space.anisotropy();
    let refractive_index = half_space.refractive_index();
    let integrand = |w: f64| {
        let squared = w * w;
        let mu = (1.0 - squared) / (1.0 + squared);
        let angle = 1.0 + g * g + 2.0 * g * mu;
        let phase = (1.0 - g * g) / (4.0 * PI * angle * angle.sqrt());
        let transmittance = 1.0 - fresnel::reflectance(mu, refractive_index);
        let jacobian = 2.0 * (1.0 - squared) / ((1.0 + squared) * (1.0 + squared));
        f(w) * phase * transmittance * jacobian
    };
    // Beyond the critical angle nothing leaves: w ends where μ does.
    let critical_cosine = (1.0 - 1.0 / (refractive_index * refractive_index)).sqrt();
    let end = ((1.0 - critical_cosine) / (1.0 + critical_cosine)).sqrt();
    // T begins there like a square root, which w = end (1 - v²) makes smooth.
    let mut sum = PANEL.integrate(0.0, 0.5_f64.sqrt(), |v| 2.0 * v * end * integrand(end * (1.0 - v * v)));
    // e^(-r/w) bends at w = r: panels halve down to 2⁻²⁵, far below the first ring.
    let mut to = end / 2.0;
    for _ in 0..24 {
        sum += PANEL.integrate(to / 2.0, to, integrand);
        to /= 2.0;
    }
    Some(sum + PANEL.integrate(0.0, to, integrand))
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use super::*;
    use crate::radial_grid::RINGS;
    use crate::{Goal, RING_EDGES, Run};

    fn searchlight(anisotropy: f64, refractive_index: f64) -> HalfSpace {
        HalfSpace::new(Entry::Searchlight, anisotropy, refractive_index).expect("a medium that can be")
    }

    #[test]
    fn the_walk_counts_what_the_quadrature_says() {
        for (anisotropy, refractive_index) in [(0.0, 1.0), (0.6, 1.0), (-0.4, 1.4)] {
            let half_space = searchlight(anisotropy, refractive_index);
            let mut run = Run::new(half_space, 11);
            run.simulate(&Goal::photons(400_000).expect("some"), &mut |_| ControlFlow::Continue(()));
            let (mut chi_squared, mut degrees) = (0.0, 0.0);
            for ring in 0..RINGS - 1 {
                let energy =
                    energy(&half_space, RING_EDGES[ring], RING_EDGES[ring + 1]).expect("perpendicular");
                let expected = energy * run.photons() as f64;
                if expected >= 10.0 {
                    chi_squared += (run.histogram.row(0)[ring] as f64 - expected).powi(2) / expected;
                    degrees += 1.0;
                }
            }
            // χ² has the variance 2 per degree of freedom; 4 of its standard deviations.
            let deviation = (chi_squared - degrees) / (2.0_f64 * degrees).sqrt();
            assert!(degrees > 30.0 && deviation.abs() < 4.0, "g = {anisotropy}: {chi_squared} / {degrees}");
        }
    }

    #[test]
    fn rings_add_up_to_the_first_order_of_the_exact_total() {
        // dA/dα at 0, of A = 1 - H(1) √(1 - α): (1 - ln 2)/2.
        let exact = 0.5 * (1.0 - std::f64::consts::LN_2);
        let whole = energy(&searchlight(0.0, 1.0), 0.0, f64::INFINITY).expect("perpendicular");
        assert!((whole - exact).abs() < 1e-12, "{whole}");
        let parts: f64 = RING_EDGES
            .windows(2)
            .map(|edges| energy(&searchlight(0.0, 1.0), edges[0], edges[1]).expect("perpendicular"))
            .sum();
        assert!((parts - exact).abs() < 1e-12);
    }

    #[test]
    fn profile_is_the_derivative_of_the_energy() {
        let half_space = searchlight(0.3, 1.4);
        for radius in [0.01, 0.3, 2.0] {
            let step = 1e-4 * radius;
            let energy = energy(&half_space, radius - step, radius + step).expect("perpendicular");
            let value = r_reflectance(&half_space, radius).expect("perpendicular");
            // The error of a central difference is step²/6 of the second derivative.
            assert!((energy / (2.0 * TAU * step) / value - 1.0).abs() < 1e-7);
        }
        assert_eq!(r_reflectance(&HalfSpace::matched_isotropic(Entry::Diffuse), 1.0), None);
    }
}
