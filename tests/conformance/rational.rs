//! \[L23\]'s rational profile with its coefficients as the paper prints them, typed from the paper.

use std::f64::consts::PI;

/// r·R(r) = (a r + b)/(r + c), \[L23\] eq. (7), at a mean free path of 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rational {
    pub(crate) a: f64,
    pub(crate) b: f64,
    pub(crate) c: f64,
}

/// k₁ of eq. (12) as printed.
pub(crate) const K1_PRINTED: f64 = 0.461;

/// k₁ that refits give, see `l23_refit`.
pub(crate) const K1_REFITTED: f64 = 0.0635;

impl Rational {
    /// Eq. (11)-(15) at a single-scattering albedo, with a choice of k₁.
    pub(crate) fn liang_2023(alpha: f64, k1: f64) -> Rational {
        Rational {
            // 0.1^(-30(α - 1)) in the paper.
            a: -0.0064 * alpha + 0.00316 * 0.1_f64.powf(-30.0 * (alpha - 1.0)),
            b: k1 * alpha.powf(b_exponent(alpha)),
            c: 0.0097 * (4.2 * alpha).exp() + 0.166,
        }
    }

    pub(crate) fn at(&self, radius: f64) -> f64 {
        (self.a * radius + self.b) / (radius + self.c)
    }

    /// Where eq. (7) is 0.
    pub(crate) fn end(&self) -> f64 {
        -self.b / self.a
    }

    /// Eq. (17): ∫₀^r 2π (a t + b)/(t + c) dt over the surface albedo, not normalised.
    pub(crate) fn cdf(&self, radius: f64, surface_albedo: f64) -> f64 {
        let Rational { a, b, c } = *self;
        2.0 * PI * (a * radius + (b - a * c) * (radius / c + 1.0).ln()) / surface_albedo
    }

    /// Mean of eq. (7) over a ring.
    pub(crate) fn ring_mean(&self, r_lo: f64, r_hi: f64) -> f64 {
        let mean_reciprocal = ((r_hi + self.c) / (r_lo + self.c)).ln() / (r_hi - r_lo);
        self.a + (self.b - self.a * self.c) * mean_reciprocal
    }
}

/// k₂ of eq. (13).
pub(crate) fn b_exponent(alpha: f64) -> f64 {
    (6.7 * (alpha - 0.45).powi(2) + 2.6) * alpha + 1.3
}
