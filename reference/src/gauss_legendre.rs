//! Gauss-Legendre quadrature.

use std::f64::consts::PI;

/// Nodes in (-1, 1) and weights of an `N`-point rule.
pub(crate) struct GaussLegendre<const N: usize> {
    nodes: [(f64, f64); N],
}

impl<const N: usize> GaussLegendre<N> {
    /// Newton's method on the Legendre polynomial from the guess cos(π(i + 3/4)/(N + 1/2)) and the weights
    /// 2/((1 - x²) P'²), both as in Abramowitz and Stegun 1964.
    pub(crate) fn new() -> Self {
        let mut nodes = [(0.0, 0.0); N];
        for (index, node) in nodes.iter_mut().enumerate() {
            let mut x = libm::cos(PI * (index as f64 + 0.75) / (N as f64 + 0.5));
            let mut derivative = 1.0;
            // From this guess, four steps are exact to the last place; the fifth and sixth change nothing.
            for _ in 0..6 {
                let (mut before, mut value) = (1.0, x);
                for degree in 2..=N {
                    let k = degree as f64;
                    (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
                }
                derivative = N as f64 * (x * value - before) / (x * x - 1.0);
                x -= value / derivative;
            }
            *node = (x, 2.0 / ((1.0 - x * x) * derivative * derivative));
        }
        GaussLegendre { nodes }
    }

    /// Nodes and weights on `from` to `to`.
    pub(crate) fn on(&self, from: f64, to: f64) -> impl Iterator<Item = (f64, f64)> {
        let (centre, half) = (0.5 * (from + to), 0.5 * (to - from));
        self.nodes.iter().map(move |&(x, weight)| (centre + half * x, half * weight))
    }

    /// ∫ f over `from` to `to`.
    pub(crate) fn integrate(&self, from: f64, to: f64, mut f: impl FnMut(f64) -> f64) -> f64 {
        self.on(from, to).map(|(x, weight)| weight * f(x)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_exact() {
        let rule = GaussLegendre::<16>::new();
        // A 16-point rule is exact up to degree 31.
        let integral = rule.integrate(0.0, 2.0, |x| 32.0 * x.powi(31));
        assert!((integral / 2.0_f64.powi(32) - 1.0).abs() < 1e-13);
        assert!((rule.integrate(-1.0, 3.0, |_| 1.0) - 4.0).abs() < 1e-14);
    }
}
