//! A sum of exponentials and of the sources of a dipole, which several models evaluate to.

use std::f64::consts::PI;

use crate::dipole_source::DipoleSource;
use crate::inverse::increasing_root;
use crate::radial_profile::{legal_radius, legal_u};
use crate::{ModelError, RadialProfile, Requirement};

/// w e^(-r/d).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Exponential {
    /// Share of all energy.
    pub(crate) weight: f64,
    /// d > 0, at length 1.
    pub(crate) length: f64,
}

/// An exponential's share is a share.
static WEIGHT_A_SHARE: Requirement = Requirement {
    coefficient: "exponential_weight",
    wrong: "the exponential's weight is {}",
    expected: "w(A) must be from 0 to 1",
    remedy: "the polynomial `exponential_weight` must stay within [0, 1] for all A in [0, 1]",
};

/// An exponential falls.
static LENGTH_POSITIVE: Requirement = Requirement {
    coefficient: "exponential_length",
    wrong: "the exponential's length is {}",
    expected: "d(A) must be above 0",
    remedy: "the polynomial `exponential_length` must stay above 0 for all A in [0, 1]",
};

impl Exponential {
    /// The exponential that a model has at a surface albedo, which the errors name.
    pub(crate) fn new(surface_albedo: f64, weight: f64, length: f64) -> Result<Exponential, ModelError> {
        if !(0.0..=1.0).contains(&weight) {
            return Err(WEIGHT_A_SHARE.broken_at(surface_albedo, weight));
        }
        if !(length > 0.0 && length.is_finite()) {
            return Err(LENGTH_POSITIVE.broken_at(surface_albedo, length));
        }
        Ok(Exponential { weight, length })
    }

    /// Density of the exit radius. A part without energy counts as 0, however short.
    fn radial_pdf(&self, r: f64) -> f64 {
        if self.weight > 0.0 { self.weight * ((-r / self.length).exp() / self.length) } else { 0.0 }
    }
}

/// A profile of `E` exponentials and `S` sources of a dipole: with lengths in the profile's own,
///
/// radial_cdf(r) = 1 - Σ w e^(-r/d) - Σ w (z/ρ) e^(-s(ρ - z)), ρ = √(r² + z²).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExponentialSourceSum<const E: usize, const S: usize> {
    surface_albedo: f64,
    /// The length that all others are counted in, mm.
    pub(crate) mean_free_path_mm: f64,
    pub(crate) exponentials: [Exponential; E],
    /// Shares of all energy, and the sources.
    pub(crate) sources: [(f64, DipoleSource); S],
}

impl<const E: usize, const S: usize> ExponentialSourceSum<E, S> {
    /// A sum whose shares add up to 1.
    pub(crate) fn new(
        surface_albedo: f64,
        mean_free_path_mm: f64,
        exponentials: [Exponential; E],
        sources: [(f64, DipoleSource); S],
    ) -> Self {
        ExponentialSourceSum { surface_albedo, mean_free_path_mm, exponentials, sources }
    }

    /// Decay lengths of the exponentials, mm.
    pub fn exponential_lengths_mm(&self) -> [f64; E] {
        self.exponentials.map(|exponential| exponential.length * self.mean_free_path_mm)
    }

    /// Depths of the sources, mm.
    pub fn dipole_depths_mm(&self) -> [f64; S] {
        self.sources.map(|(_, source)| source.depth * self.mean_free_path_mm)
    }

    /// s, the decay of the sources' field, mm⁻¹. 0 where nothing is absorbed.
    pub fn dipole_attenuation_per_mm(&self) -> f64 {
        self.sources.first().map_or(0.0, |(_, source)| source.attenuation / self.mean_free_path_mm)
    }

    /// Shares of the energy, of the exponentials and then of the sources.
    fn shares(&self) -> impl Iterator<Item = f64> + '_ {
        let exponentials = self.exponentials.iter().map(|exponential| exponential.weight);
        exponentials.chain(self.sources.iter().map(|(weight, _)| *weight))
    }

    /// A radius of this profile for a uniform u in [0, 1), without iterating over the profile: u chooses one of the
    /// parts by its share, and what is left of u inverts that part. -d ln(1 - v) inverts an exponential,
    /// √(W₀(s z e^(sz)/(1 - v))²/s² - z²) a source, W₀ being Lambert's.
    ///
    /// Exact, but not monotone in u as [`sample_radius`](RadialProfile::sample_radius) is: strata of u are strata of
    /// each part, not of the radius.
    pub fn sample_by_composition(&self, u: f64) -> f64 {
        if u.is_nan() {
            return u;
        }
        let mut rest = legal_u(u);
        let weights: Vec<f64> = self.shares().collect();
        let last = weights.iter().rposition(|weight| *weight > 0.0).unwrap_or(0);
        let mut part = 0;
        while part < last && rest >= weights[part] {
            rest -= weights[part];
            part += 1;
        }
        // Rounding may leave the last part a little more than its share.
        let log_q = (-legal_u(rest / weights[part])).ln_1p();
        self.part_radius(part, log_q) * self.mean_free_path_mm
    }

    /// The radius beyond which the part has the fraction e^(`log_q`), in the order of [`shares`](Self::shares).
    fn part_radius(&self, part: usize, log_q: f64) -> f64 {
        match self.exponentials.get(part) {
            Some(exponential) => -exponential.length * log_q,
            None => self.sources[part - E].1.radius_beyond(log_q),
        }
    }

    fn unit_radius(&self, radius_mm: f64) -> f64 {
        legal_radius(legal_radius(radius_mm) / self.mean_free_path_mm)
    }

    fn unit_cdf(&self, r: f64) -> f64 {
        let exponentials = self.exponentials.iter().map(|e| -e.weight * (-r / e.length).exp_m1());
        let sources = self.sources.iter().map(|(weight, source)| weight * source.cdf(r));
        exponentials.chain(sources).fold(0.0, |sum, part| sum + part).clamp(0.0, 1.0)
    }

    fn unit_tail(&self, r: f64) -> f64 {
        let exponentials = self.exponentials.iter().map(|e| e.weight * (-r / e.length).exp());
        let sources = self.sources.iter().map(|(weight, source)| weight * source.tail(r));
        exponentials.chain(sources).fold(0.0, |sum, part| sum + part).clamp(0.0, 1.0)
    }

    /// Σ (w/d) e^(-r/d) of the exponentials.
    fn exponential_pdf(&self, r: f64) -> f64 {
        self.exponentials.iter().fold(0.0, |sum, exponential| sum + exponential.radial_pdf(r))
    }

    fn unit_radial_pdf(&self, r: f64) -> f64 {
        let sources = self.sources.iter().map(|(weight, source)| weight * source.radial_pdf(r));
        sources.fold(self.exponential_pdf(r), |sum, source| sum + source)
    }

    /// ln r at which the cdf is u, in (0, 1), and how often the profile was evaluated for it.
    pub(crate) fn log_quantile(&self, u: f64) -> (f64, u32) {
        let log_q = (-u).ln_1p();
        // The quantile of a mixture lies between those of its parts, and the mean of their logarithms is near.
        let (mut low, mut high, mut start) = (f64::INFINITY, f64::NEG_INFINITY, 0.0);
        let exponentials = self.exponentials.iter().map(|e| (e.weight, [-e.length * log_q; 2]));
        let sources = self.sources.iter().map(|(weight, source)| (*weight, source.radius_bounds(log_q)));
        for (weight, bounds) in exponentials.chain(sources) {
            if weight > 0.0 {
                let [least, greatest] = bounds.map(f64::ln);
                (low, high) = (f64::min(low, least), f64::max(high, greatest));
                start += weight * greatest;
            }
        }
        let evaluations = std::cell::Cell::new(0);
        let log_u = u.ln();
        let value_and_slope = |log_r: f64| {
            evaluations.set(evaluations.get() + 1);
            let r = log_r.exp();
            let pdf = r * self.unit_radial_pdf(r);
            if u < 0.5 {
                let cdf = self.unit_cdf(r);
                (cdf.ln() - log_u, pdf / cdf)
            } else {
                let tail = self.unit_tail(r);
                (log_q - tail.ln(), pdf / tail)
            }
        };
        let log_r = increasing_root(value_and_slope, [low, high], start, 1.0);
        (log_r, evaluations.get())
    }
}

impl<const E: usize, const S: usize> RadialProfile for ExponentialSourceSum<E, S> {
    fn surface_albedo(&self) -> f64 {
        self.surface_albedo
    }

    /// Infinite at r = 0, as 1/r, unless the exponentials have no share.
    fn area_pdf(&self, radius_mm: f64) -> f64 {
        let r = self.unit_radius(radius_mm);
        let exponentials = self.exponential_pdf(r);
        let near = if exponentials > 0.0 { exponentials / (2.0 * PI * r) } else { 0.0 };
        let sources = self.sources.iter().map(|(weight, source)| weight * source.area_pdf(r));
        sources.fold(near, |sum, source| sum + source) / self.mean_free_path_mm / self.mean_free_path_mm
    }

    /// Σ (w/d) e^(-r/d) + Σ w z r (1 + sρ) e^(-s(ρ - z))/ρ³, at length 1.
    fn radial_pdf(&self, radius_mm: f64) -> f64 {
        self.unit_radial_pdf(self.unit_radius(radius_mm)) / self.mean_free_path_mm
    }

    fn radial_cdf(&self, radius_mm: f64) -> f64 {
        self.unit_cdf(self.unit_radius(radius_mm))
    }

    fn radial_tail(&self, radius_mm: f64) -> f64 {
        self.unit_tail(self.unit_radius(radius_mm))
    }

    /// Newton's method between the quantiles of the parts, in the logarithms of r and of the cdf or tail, where all
    /// parts are nearly straight lines.
    fn sample_radius(&self, u: f64) -> f64 {
        if u.is_nan() {
            return u;
        }
        let u = legal_u(u);
        // Below the smallest normal number logarithms lose their meaning; 0 is off by less than 1e-153 lengths.
        if u < f64::MIN_POSITIVE {
            return 0.0;
        }
        self.log_quantile(u).0.exp() * self.mean_free_path_mm
    }
}
