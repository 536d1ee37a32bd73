//! The field in a slab as a sum over its modes.

use super::super::dipole::SOURCE_DEPTH;
use super::{Side, Slab};
use std::f64::consts::PI;

/// Flux through a surface at `radius` > 0 of a source of power 1.
///
/// Between two surfaces at distance d where it vanishes, the fluence is a sum of sin(k z), k = nπ/d, and each
/// coefficient solves the diffusion equation in the plane with the extinction κ² = k² + σtr²: K₀(κr)/2πD. The flux is
/// D times its derivative.
pub(super) fn flux(slab: &Slab, side: Side, radius: f64) -> f64 {
    /// A mode whose K₀ is e⁻⁴⁰ of the first one's is below the last digit.
    const NEGLIGIBLE: f64 = 40.0;
    let d = slab.extrapolated_thickness();
    let extinction = |n: f64| libm::hypot(n * PI / d, slab.transport_extinction);
    let mut sum = 0.0;
    let mut n = 1.0;
    while (extinction(n) - extinction(1.0)) * radius < NEGLIGIBLE {
        let k = n * PI / d;
        // The outward derivative of the n-th sine at the far surface has the sign (-1)^(n+1).
        let sign = if side == Side::Far && n % 2.0 == 0.0 { -1.0 } else { 1.0 };
        let mode =
            sign * k * libm::cos(k * slab.extrapolation) * libm::sin(k * (SOURCE_DEPTH + slab.extrapolation));
        sum += mode * bessel_k0(extinction(n) * radius);
        n += 1.0;
    }
    sum / (PI * d)
}

/// The modified Bessel function K₀(x) = ∫₀^∞ e^{-x cosh t} dt for x ≥ 1, by the trapezoidal rule, which converges
/// exponentially for a function that is analytic and even.
fn bessel_k0(x: f64) -> f64 {
    // e^{-π²/h} bounds the error for small x, e^{-2π²/(h²x)} for large; both are below 1e-17 of the value.
    let step = (0.7 / x.sqrt()).min(0.2);
    // Half the weight at t = 0, the edge of an even function.
    let mut sum = 0.5;
    let mut t = step;
    let mut term = 1.0;
    while term > 1e-18 {
        // cosh t - 1, without its cancellation.
        let s = libm::sinh(0.5 * t);
        term = libm::exp(-2.0 * x * s * s);
        sum += term;
        t += step;
    }
    sum * step * libm::exp(-x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bessel_k0_has_its_tabulated_values() {
        // As mpmath 1.3 has them, which agree with the ten digits of Abramowitz and Stegun 1964.
        for (x, k0) in [
            (1.0, 0.421_024_438_240_708_33),
            (2.0, 0.113_893_872_749_533_44),
            (5.0, 3.691_098_334_042_594e-3),
        ] {
            assert!((bessel_k0(x) / k0 - 1.0).abs() < 1e-14, "{x}");
        }
        // √(π/2x) e⁻ˣ (1 - 1/8x + 9/128x² - …) at x = 500, where the next term is 6e-10.
        let x = 500.0_f64;
        let asymptote =
            (PI / (2.0 * x)).sqrt() * (-x).exp() * (1.0 - 1.0 / (8.0 * x) + 9.0 / (128.0 * x * x));
        assert!((bessel_k0(x) / asymptote - 1.0).abs() < 1e-8);
    }
}
