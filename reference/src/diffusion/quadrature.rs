//! Integrals of smooth functions to nearly the last digit.
//!
//! Double-exponential quadrature (Takahasi and Mori 1974, "Double exponential formulas for numerical integration"): a
//! change of variable lets the integrand vanish double exponentially at both ends, and there the trapezoidal rule
//! converges exponentially, square roots at the ends included. Each halving of the step about doubles the number of
//! correct digits, so where two steps agree to [`AGREEMENT`] the finer one is good to about its square. It needs no
//! table of nodes, and nothing to tune but the scale.

use std::f64::consts::FRAC_PI_2;

/// Relative difference of two successive steps at which the finer is returned.
const AGREEMENT: f64 = 1e-9;

/// The first step. Coarse enough that a smooth integrand takes two halvings.
const FIRST_STEP: f64 = 0.25;

/// The step is halved at most this often, to 2⁻⁹: an integrand that is not a number ends too.
const HALVINGS: u32 = 7;

/// ∫₀^∞ f(x) dx of a function that falls at least as fast as e⁻ˣ.
///
/// `scale` in (0, 1] is the smallest x at which f has a feature of its own; a power law towards 0 is none.
pub(super) fn half_line(scale: f64, f: impl Fn(f64) -> f64) -> f64 {
    /// x = scale·3.6e-26: what is left out is below the last digit for all that diverges slower than 1/√x.
    const LOW: f64 = -4.0;
    /// e⁻ˣ underflows at 745.
    const LARGEST: f64 = 750.0;
    trapezoid(LOW, libm::log(LARGEST / scale), |t| {
        let e = libm::exp(-t);
        let x = scale * libm::exp(t - e);
        f(x) * x * (1.0 + e)
    })
}

/// ∫ f(x) dx from `a` to `b` of a function that is finite at both ends.
pub(super) fn interval(a: f64, b: f64, f: impl Fn(f64) -> f64) -> f64 {
    /// Here the weight of a node is 1e-21 of the largest.
    const END: f64 = 3.5;
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    trapezoid(-END, END, |t| {
        let s = FRAC_PI_2 * libm::sinh(t);
        let c = libm::cosh(s);
        f(middle + half * libm::tanh(s)) * half * FRAC_PI_2 * libm::cosh(t) / (c * c)
    })
}

/// The trapezoidal rule over [low, high] for a function that vanishes at both ends.
fn trapezoid(low: f64, high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let mut intervals = ((high - low) / FIRST_STEP).ceil() as u32;
    let mut step = (high - low) / f64::from(intervals);
    let mut sum: f64 = (0..=intervals).map(|i| f(low + f64::from(i) * step)).sum();
    for _ in 0..HALVINGS {
        let between: f64 = (0..intervals).map(|i| f(low + (f64::from(i) + 0.5) * step)).sum();
        let agreed = (between - sum).abs() <= 2.0 * AGREEMENT * sum.abs();
        sum += between;
        intervals *= 2;
        step *= 0.5;
        if agreed {
            break;
        }
    }
    sum * step
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// Measured: the worst of the integrals below is off by 4e-15.
    const TOLERANCE: f64 = 2e-14;

    #[track_caller]
    fn assert_close(actual: f64, expected: f64) {
        assert!((actual / expected - 1.0).abs() < TOLERANCE, "{actual} for {expected}");
    }

    #[test]
    fn half_line_of_gamma_functions() {
        assert_close(half_line(1.0, |x| (-x).exp()), 1.0);
        assert_close(half_line(1.0, |x| x.powi(5) * (-x).exp()), 120.0);
        // Γ(½) = √π: a singularity at the end that is left out below x = 3.6e-26 loses 4e-13.
        assert!((half_line(1.0, |x| (-x).exp() / x.sqrt()) / PI.sqrt() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn half_line_with_a_feature_far_below_its_end() {
        // ∫ s/(x+s)² e⁻ˣ dx = 1 - s e^s E₁(s); at s = 1e-9, E₁(s) = -γ - ln s + s.
        let s = 1e-9_f64;
        let e1 = -0.577_215_664_901_532_9 - s.ln() + s;
        assert_close(half_line(s, |x| s / ((x + s) * (x + s)) * (-x).exp()), 1.0 - s * s.exp() * e1);
    }

    #[test]
    fn interval_of_smooth_functions_and_roots() {
        assert_close(interval(1.0, 3.0, |x| x * x), 26.0 / 3.0);
        assert_close(interval(0.0, 1.0, f64::sqrt), 2.0 / 3.0);
        assert_close(interval(-1.0, 1.0, |x| (1.0 - x * x).sqrt()), PI / 2.0);
    }

    #[test]
    fn nothing_integrates_to_nothing_and_nan_to_nan() {
        assert_eq!(interval(0.0, 1.0, |_| 0.0), 0.0);
        assert_eq!(half_line(1.0, |_| 0.0), 0.0);
        assert!(half_line(1.0, |_| f64::NAN).is_nan());
    }
}
