//! Exact totals of an index-matched half-space with isotropic scattering, by Chandrasekhar's H functions.
//!
//! - \[C60\] Chandrasekhar 1960, "Radiative Transfer", Dover.
//! - \[SW59\] Stibbs, Weir 1959, "On the H-functions for isotropic scattering", MNRAS 119, 512-525.

use std::f64::consts::{FRAC_1_PI, FRAC_PI_2, FRAC_PI_4};
use std::sync::LazyLock;

use crate::Entry;
use crate::gauss_legendre::GaussLegendre;

/// Why there is no exact total.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TotalError {
    /// α is outside [0, 1] or not a number.
    #[error("single-scattering albedo {0} is not in [0, 1]: give scattering over extinction")]
    SingleScatteringAlbedo(f64),
    /// A is outside [0, 1] or not a number.
    #[error("surface albedo {0} is not in [0, 1]: give the reflected fraction of what entered")]
    SurfaceAlbedo(f64),
}

/// A node of the quadrature over θ: nothing here depends on the medium or the direction.
struct Node {
    weight: f64,
    /// 1 - θ cot θ.
    one_minus: f64,
    cosine_squared: f64,
    sine_squared: f64,
}

/// Panels that halve from π/4 towards 0 and towards π/2, since the logarithm bends at θ ≈ √3 q and the denominator at
/// cos θ ≈ μ. What lies below the last panel is 10⁻⁹ of the range, of which the rule still has two digits right.
static NODES: LazyLock<Vec<Node>> = LazyLock::new(|| {
    const PANELS: i32 = 30;
    let rule = GaussLegendre::<16>::new();
    let mut nodes = Vec::new();
    let mut to = FRAC_PI_4;
    for panel in 0..=PANELS {
        let from = if panel == PANELS { 0.0 } else { to / 2.0 };
        for (x, weight) in rule.on(from, to) {
            let (sine, cosine) = libm::sincos(x);
            let (sine_squared, cosine_squared) = (sine * sine, cosine * cosine);
            nodes.push(Node { weight, one_minus: one_minus_cotangent(x), cosine_squared, sine_squared });
            // π/2 - x: sine and cosine change places, exactly.
            let one_minus = 1.0 - (FRAC_PI_2 - x) * sine / cosine;
            nodes.push(Node {
                weight,
                one_minus,
                cosine_squared: sine_squared,
                sine_squared: cosine_squared,
            });
        }
        to = from;
    }
    nodes
});

/// 1 - θ cot θ, by the series of the cotangent where the difference would cancel.
fn one_minus_cotangent(theta: f64) -> f64 {
    let square = theta * theta;
    if theta < 0.05 {
        square * (1.0 / 3.0 + square * (1.0 / 45.0 + square * (2.0 / 945.0 + square / 4725.0)))
    } else {
        1.0 - theta / libm::tan(theta)
    }
}

/// H of one medium, which scatters isotropically with the single-scattering albedo α = 1 - q².
struct HFunction {
    /// Weight × ln(1 - α θ cot θ), cos²θ, sin²θ.
    terms: Vec<(f64, f64, f64)>,
}

impl HFunction {
    fn new(q: f64) -> HFunction {
        // 1 - α θ cot θ = q² + α (1 - θ cot θ).
        let alpha = (1.0 - q) * (1.0 + q);
        let term = |node: &Node| {
            (node.weight * libm::log(q * q + alpha * node.one_minus), node.cosine_squared, node.sine_squared)
        };
        HFunction { terms: NODES.iter().map(term).collect() }
    }

    fn at(&self, mu: f64) -> f64 {
        let squared = mu * mu;
        let integral: f64 =
            self.terms.iter().map(|&(term, cosine, sine)| term / (cosine + squared * sine)).sum();
        libm::exp(-mu * FRAC_1_PI * integral)
    }
}

/// H(μ) of a medium that scatters isotropically with the single-scattering albedo α = 1 - q². μ and q in [0, 1].
///
/// \[SW59\]: ln H(μ) = -(μ/π) ∫₀^(π/2) ln(1 - α θ cot θ) / (cos²θ + μ² sin²θ) dθ.
pub fn h_function(mu: f64, q: f64) -> f64 {
    HFunction::new(q).at(mu)
}

/// Surface albedo of a medium with α = 1 - q².
fn surface_albedo_of_q(entry: Entry, q: f64) -> f64 {
    static RULE: LazyLock<GaussLegendre<32>> = LazyLock::new(GaussLegendre::new);
    let h = HFunction::new(q);
    match entry {
        // [C60] ch. V, integrated over all exits: A(μ₀) = 1 - H(μ₀) √(1 - α).
        Entry::Searchlight => 1.0 - q * h.at(1.0),
        // ∫ A(μ₀) 2μ₀ dμ₀. H bends like μ ln μ at 0, and μ = t² takes that away.
        Entry::Diffuse => 1.0 - q * RULE.integrate(0.0, 1.0, |t| 4.0 * t * t * t * h.at(t * t)),
    }
}

/// Surface albedo A in [0, 1] of an index-matched, isotropically scattering half-space with `single_scattering_albedo`.
/// Good to 10⁻¹¹.
///
/// # Errors
///
/// α outside [0, 1].
pub fn surface_albedo(entry: Entry, single_scattering_albedo: f64) -> Result<f64, TotalError> {
    if !(0.0..=1.0).contains(&single_scattering_albedo) {
        return Err(TotalError::SingleScatteringAlbedo(single_scattering_albedo));
    }
    if single_scattering_albedo == 0.0 {
        return Ok(0.0);
    }
    Ok(surface_albedo_of_q(entry, (1.0 - single_scattering_albedo).sqrt()))
}

/// Single-scattering albedo α in [0, 1] of which `surface_albedo` comes: the inverse of [`surface_albedo()`].
///
/// # Errors
///
/// A outside [0, 1].
pub fn single_scattering_albedo(entry: Entry, surface_albedo: f64) -> Result<f64, TotalError> {
    if !(0.0..=1.0).contains(&surface_albedo) {
        return Err(TotalError::SurfaceAlbedo(surface_albedo));
    }
    // A falls from 1 to 0 as q goes from 0 to 1.
    let q = crate::root::falling(0.0, 1.0, |q| {
        if q == 1.0 { -surface_albedo } else { surface_albedo_of_q(entry, q) - surface_albedo }
    });
    Ok((1.0 - q) * (1.0 + q))
}
