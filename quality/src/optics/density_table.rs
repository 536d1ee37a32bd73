//! The densities of three channels by radius.

use crate::gather::gathered::Rgb;

/// Steps of a table.
const STEPS: usize = 800;

/// Densities per area at even steps of the radius' logarithm, and straight between. A step is 1.5 %: where profiles fall as
/// r⁻⁵ that is within 1e-3 of them, and closer where they hold energy.
#[derive(Debug)]
pub(crate) struct DensityTable {
    ln_first: f64,
    per_ln_step: f64,
    densities: Vec<Rgb>,
}

impl DensityTable {
    /// The table of `density` between two radii > 0.
    pub(crate) fn new(first: f64, last: f64, density: impl Fn(f64) -> Rgb) -> Self {
        let ln_first = first.ln();
        let ln_step = (last.ln() - ln_first) / STEPS as f64;
        let radius = |step: usize| (ln_first + step as f64 * ln_step).exp();
        let densities = (0..=STEPS).map(|step| density(radius(step))).collect();
        Self { ln_first, per_ln_step: 1.0 / ln_step, densities }
    }

    /// The densities at a radius > 0; those at the ends beyond them.
    pub(crate) fn at(&self, radius: f64) -> Rgb {
        let place = ((radius.ln() - self.ln_first) * self.per_ln_step).clamp(0.0, STEPS as f64);
        let step = (place as usize).min(STEPS - 1);
        let (lower, upper) = (&self.densities[step], &self.densities[step + 1]);
        let share = place - step as f64;
        std::array::from_fn(|channel| lower[channel] + share * (upper[channel] - lower[channel]))
    }
}
