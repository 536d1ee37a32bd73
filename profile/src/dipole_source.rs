//! The light of one source of a dipole, at the surface.

use std::f64::consts::PI;

use crate::{ModelError, Requirement};

/// A point source below the surface of an absorbing, scattering half-space, at mean free path 1.
///
/// In the classical dipole (\[J01\] eq. 4) the light that a source at depth z sends through the surface
/// has the density z(1 + sρ)e^(-sρ)/(2πρ³) per area, ρ = √(r² + z²). Divided by its integral e^(-sz), that is the
/// profile here; its tail is (z/ρ) e^(-s(ρ - z)).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct DipoleSource {
    /// z > 0.
    pub(crate) depth: f64,
    /// s ≥ 0.
    pub(crate) attenuation: f64,
}

/// A source lies below the surface.
static DEPTH_POSITIVE: Requirement = Requirement {
    coefficient: "dipole_depth",
    wrong: "the dipole's depth is {}",
    expected: "z(A) must be above 0",
    remedy: "the polynomial `dipole_depth` must stay above 0 for all A in [0, 1]",
};

/// A source's field does not grow.
static ATTENUATION_NOT_NEGATIVE: Requirement = Requirement {
    coefficient: "dipole_attenuation",
    wrong: "the dipole's attenuation is {}",
    expected: "s(A) must be 0 or more",
    remedy: "the polynomial `dipole_attenuation` must not be negative for any A in [0, 1]",
};

impl DipoleSource {
    /// Halley's method takes at most five steps to all digits, over all depths, attenuations and fractions.
    const MAXIMUM_STEPS: usize = 8;

    /// The source that a model has at a surface albedo, which the errors name.
    pub(crate) fn new(surface_albedo: f64, depth: f64, attenuation: f64) -> Result<DipoleSource, ModelError> {
        if !(depth > 0.0 && depth.is_finite()) {
            return Err(DEPTH_POSITIVE.broken_at(surface_albedo, depth));
        }
        if !(attenuation >= 0.0 && attenuation.is_finite()) {
            return Err(ATTENUATION_NOT_NEGATIVE.broken_at(surface_albedo, attenuation));
        }
        Ok(DipoleSource { depth, attenuation })
    }

    /// t = ρ/z - 1 = (√(n² + 1) - 1), n = r/z, without the cancellation and without overflow.
    fn excess(&self, r: f64) -> f64 {
        let n = r / self.depth;
        // Above 2²⁷ the 1 is below the last place of n², and further up n·n overflows. t stays finite: s t is 0·∞
        // at A = 1 otherwise.
        if n > 1e9 { (n - 1.0).clamp(0.0, f64::MAX) } else { n * n / (1.0 + 1f64.hypot(n)) }
    }

    /// ln of the tail: -ln(ρ/z) - s(ρ - z) = -ln(1 + t) - s z t.
    fn log_tail(&self, excess: f64) -> f64 {
        -(excess.ln_1p() + self.attenuation * self.depth * excess)
    }

    /// Fraction of the source's light that leaves beyond r.
    pub(crate) fn tail(&self, r: f64) -> f64 {
        self.log_tail(self.excess(r)).exp()
    }

    /// Fraction of the source's light that leaves within r.
    pub(crate) fn cdf(&self, r: f64) -> f64 {
        -self.log_tail(self.excess(r)).exp_m1()
    }

    /// Density per unit area, which is finite at r = 0: (1 + sρ)z e^(-s(ρ - z))/(2πρ³).
    pub(crate) fn area_pdf(&self, r: f64) -> f64 {
        let t = self.excess(r);
        let z_over_rho = 1.0 / (1.0 + t);
        let slope = z_over_rho + self.attenuation * self.depth;
        z_over_rho * slope * self.log_tail(t).exp() / (2.0 * PI * self.depth * self.depth)
    }

    /// z r (1 + sρ) e^(-s(ρ - z))/ρ³, ordered so that no power of a large ρ overflows.
    pub(crate) fn radial_pdf(&self, r: f64) -> f64 {
        let t = self.excess(r);
        let z_over_rho = 1.0 / (1.0 + t);
        let slope = z_over_rho + self.attenuation * self.depth;
        let r_over_rho = r / r.hypot(self.depth);
        r_over_rho * slope * self.log_tail(t).exp() / self.depth
    }

    /// Bounds of [`radius_beyond`](Self::radius_beyond), without iterating: each term of its equation alone gives an
    /// upper bound of p, and e^p - 1 ≤ p e^p with that bound in the exponent gives a lower one.
    pub(crate) fn radius_bounds(&self, log_q: f64) -> [f64; 2] {
        let (sz, target) = (self.attenuation * self.depth, -log_q);
        let highest = if sz > 0.0 { target.min((target / sz).ln_1p()) } else { target };
        let lowest = target / (1.0 + sz * highest.exp());
        [lowest, highest].map(|p| self.depth * (2.0 * p).exp_m1().sqrt())
    }

    /// The radius beyond which the fraction q = e^(`log_q`) is left: √(ρ² - z²), ρ = W₀(s z e^(sz)/q)/s.
    ///
    /// Lambert's W overflows for large s z and is 0/0 at s = 0, so this solves for p = ln(ρ/z) instead:
    /// p + s z (e^p - 1) = -ln q. Halley's method starts at the smaller of the two roots that each term has alone.
    /// The radius is exact to a few units in the last place.
    pub(crate) fn radius_beyond(&self, log_q: f64) -> f64 {
        let sz = self.attenuation * self.depth;
        let target = -log_q;
        let mut p = if sz > 0.0 { target.min((target / sz).ln_1p()) } else { target };
        for _ in 0..Self::MAXIMUM_STEPS {
            let growth = p.exp_m1();
            let slope = 1.0 + sz * (1.0 + growth);
            let newton = (p + sz * growth - target) / slope;
            // The second derivative is slope - 1.
            let step = newton / (1.0 - 0.5 * newton * (slope - 1.0) / slope);
            p -= step;
            // The method's order is 3: after a step of 1e-6 the next would be below the last place.
            if step.abs() <= 1e-6 * p {
                break;
            }
        }
        let t = p.exp_m1();
        self.depth * (t * (2.0 + t)).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_radius_is_exact_where_lambert_overflows() {
        for attenuation in [0.0, 1e-300, 1e-12, 1e-6, 1e-3, 0.1, 1.0, 30.0, 1e3, 1e9] {
            let source = DipoleSource { depth: 2.0, attenuation };
            for log_q in [-1e-300, -1e-15, -1e-9, -1e-4, -0.1, -0.7, -3.0, -12.0, -36.7] {
                let there = source.log_tail(source.excess(source.radius_beyond(log_q)));
                // -ln q grows at most as r² does, so the roundings of r count twice.
                assert!((there / log_q - 1.0).abs() < 1e-14, "s = {attenuation}, ln q = {log_q}: {there}");
            }
        }
    }

    #[test]
    fn the_radius_is_within_its_bounds() {
        for attenuation in [0.0, 1e-300, 1e-6, 0.1, 1.0, 30.0, 1e9] {
            let source = DipoleSource { depth: 2.0, attenuation };
            for log_q in [-1e-300, -1e-9, -0.1, -0.7, -3.0, -36.7] {
                let ([low, high], r) = (source.radius_bounds(log_q), source.radius_beyond(log_q));
                assert!(low <= r * (1.0 + 1e-14) && r <= high * (1.0 + 1e-14), "{low} {r} {high}");
            }
        }
    }

    #[test]
    fn the_radius_is_lamberts() {
        // W₀(1) = 0.567143290409783873: s z e^(sz) = q with z = 1 and q = e^(-2) has s = W₀(e^(-2)) and ρ = W₀(1)/s.
        // s solves s e^s = e^(-2): 0.120028238987641.
        let s = 0.120_028_238_987_641_23;
        let rho = DipoleSource { depth: 1.0, attenuation: s }.radius_beyond(-2.0).hypot(1.0);
        assert!((rho * s - 0.567_143_290_409_784).abs() < 1e-15, "{}", rho * s);
    }

    #[test]
    fn tail_and_cdf_are_the_equation() {
        let DipoleSource { depth: z, attenuation: s } = DipoleSource { depth: 1.5, attenuation: 0.3 };
        let source = DipoleSource { depth: z, attenuation: s };
        for r in [0.1, 1.0, 7.0] {
            let rho = f64::hypot(r, z);
            let tail = z / rho * (-s * (rho - z)).exp();
            // ρ - z of the printed form cancels: a rounding of ρ, 2 ulp of a number near 1.
            assert!((source.tail(r) - tail).abs() < 1e-15 && (source.cdf(r) - (1.0 - tail)).abs() < 1e-15);
        }
    }
}
