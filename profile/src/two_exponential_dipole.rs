//! Two exponentials near the point of entry and the far field of a dipole's two sources.

use std::f64::consts::PI;

use crate::dipole_source::DipoleSource;
use crate::inverse::increasing_root;
use crate::model_error::{require_exponential, require_finite};
use crate::radial_profile::{legal_radius, legal_u};
use crate::{Length, Medium, ModelError, RadialProfile};

/// Two exponentials plus the two sources of a dipole. At mean free path 1,
///
/// radial_cdf(r) = 1 - w [(1 - a) e^(-r/d) + a e^(-r/bd)] - (1 - w) [(1 - h) D(z) + h D(kz)],
/// D(z) = (z/ρ) e^(-s(ρ - z)), ρ = √(r² + z²).
///
/// D is what a point source at depth z leaves outside of r: the classical dipole (\[J01\] eq. 4) is two
/// such sources of the same decay s, the second for the boundary. The exponentials carry the light that scattered a
/// few times; the short one is the logarithmic rise of r·R(r) at r → 0 that single scattering has.
///
/// w, d, z and s/(1 - A) are cubics in x = 6A/(1 + 5A), which spreads the small surface albedos A, where the first
/// few scatterings change the profile fastest, and keeps 0 and 1. They are given by their coefficients of 1, x, x²,
/// x³. a, b, h and k are constants. At A = 1 nothing is absorbed: s = 0, and the profile falls only as r⁻³.
///
/// The form and its coefficients were fitted to Monte Carlo random walks for this project; no paper has them. Every
/// set names its L1 distance, ∫ |2πr·(R - T)| dr / A from the walks T, over A in [0.01, 0.99].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoExponentialDipoleModel {
    /// w, the share of both exponentials of the energy, must come out in [0, 1].
    pub exponential_weight: [f64; 4],
    /// d, the long exponential's decay length in mean free paths, must come out > 0.
    pub exponential_length: [f64; 4],
    /// z, the depth of the dipole's first source in mean free paths, must come out > 0.
    pub dipole_depth: [f64; 4],
    /// s/(1 - A), s being the decay of the dipole per mean free path, must come out ≥ 0.
    pub dipole_attenuation: [f64; 4],
    /// a in [0, 1], the share of the short exponential among the two.
    pub short_weight: f64,
    /// b > 0, the short exponential's length in lengths of the other.
    pub short_length: f64,
    /// h in [0, 1], the share of the second source among the two.
    pub second_weight: f64,
    /// k > 0, the depth of the second source in depths of the first.
    pub second_depth: f64,
}

impl TwoExponentialDipoleModel {
    /// c of x = (1 + c)A/(1 + cA).
    ///
    /// With an index-matched medium the fits hardly depend on it. At η = 1.4 light is held back under the surface, and
    /// what scattered a few times is all that leaves at A < 0.2: with c = 1, 2, 3, 5 the mean L1 of searchlight entry is
    /// 0.74, 0.62, 0.54 and 0.50 %.
    const SPREAD: f64 = 5.0;

    /// The length this model is parametrized by.
    pub const LENGTH: Length = Length::MeanFreePath;

    /// x = 6A/(1 + 5A), the variable of the cubics.
    pub(crate) fn variable(surface_albedo: f64) -> f64 {
        (1.0 + Self::SPREAD) * surface_albedo / (1.0 + Self::SPREAD * surface_albedo)
    }

    /// The profile of a medium whose length is the mean free path.
    pub fn profile(&self, medium: Medium) -> Result<TwoExponentialDipoleProfile, ModelError> {
        let surface_albedo = medium.surface_albedo();
        let x = Self::variable(surface_albedo);
        let cubic = |[c0, c1, c2, c3]: [f64; 4]| c0 + (c1 + (c2 + c3 * x) * x) * x;
        let weight = cubic(self.exponential_weight);
        let length = cubic(self.exponential_length);
        let depth = cubic(self.dipole_depth);
        // The sum turns a -0.0 from A = 1 into 0.0.
        let attenuation = (1.0 - surface_albedo) * cubic(self.dipole_attenuation) + 0.0;
        require_exponential(surface_albedo, weight, length)?;
        let dipole = DipoleSource::new(surface_albedo, depth, attenuation)?;
        let mut errors = Vec::new();
        self.collect_constant_errors(&mut errors);
        if let Some(error) = errors.into_iter().next() {
            return Err(error);
        }
        let (short_length, second_depth) = (self.short_length * length, self.second_depth * depth);
        for (quantity, value) in [("b d", short_length), ("k z", second_depth)] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(ModelError::OutOfNumericRange { quantity, surface_albedo });
            }
        }
        Ok(TwoExponentialDipoleProfile {
            surface_albedo,
            mean_free_path_mm: medium.length_mm(),
            exponentials: [
                Exponential { weight: weight * (1.0 - self.short_weight), length },
                Exponential { weight: weight * self.short_weight, length: short_length },
            ],
            sources: [
                ((1.0 - weight) * (1.0 - self.second_weight), dipole),
                ((1.0 - weight) * self.second_weight, DipoleSource { depth: second_depth, attenuation }),
            ],
        })
    }

    pub(crate) fn collect_errors(&self, errors: &mut Vec<ModelError>) {
        for (field, coefficients) in [
            ("exponential_weight", self.exponential_weight),
            ("exponential_length", self.exponential_length),
            ("dipole_depth", self.dipole_depth),
            ("dipole_attenuation", self.dipole_attenuation),
        ] {
            for (power, value) in coefficients.into_iter().enumerate() {
                require_finite([(format!("{field}[{power}]").as_str(), value)], errors);
            }
        }
        self.collect_constant_errors(errors);
    }

    fn collect_constant_errors(&self, errors: &mut Vec<ModelError>) {
        for (coefficient, value) in
            [("short_weight", self.short_weight), ("second_weight", self.second_weight)]
        {
            if !value.is_finite() {
                require_finite([(coefficient, value)], errors);
            } else if !(0.0..=1.0).contains(&value) {
                errors.push(ModelError::ShareOutOfRange { coefficient, value });
            }
        }
        for (coefficient, value) in [("short_length", self.short_length), ("second_depth", self.second_depth)]
        {
            if !value.is_finite() {
                require_finite([(coefficient, value)], errors);
            } else if value <= 0.0 {
                errors.push(ModelError::RatioNotPositive { coefficient, value });
            }
        }
    }
}

/// w e^(-r/d).
#[derive(Clone, Copy, Debug, PartialEq)]
struct Exponential {
    weight: f64,
    length: f64,
}

/// The member of [`TwoExponentialDipoleModel`] that belongs to one medium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoExponentialDipoleProfile {
    surface_albedo: f64,
    mean_free_path_mm: f64,
    /// The long and the short one; weights are shares of all energy, lengths are in mean free paths.
    exponentials: [Exponential; 2],
    /// Shares of all energy, and the sources at mean free path 1.
    sources: [(f64, DipoleSource); 2],
}

impl TwoExponentialDipoleProfile {
    /// Shares of the energy: the long exponential, the short one, the first source, the second. Their sum is 1.
    pub fn weights(&self) -> [f64; 4] {
        let [long, short] = self.exponentials.map(|exponential| exponential.weight);
        let [first, second] = self.sources.map(|(weight, _)| weight);
        [long, short, first, second]
    }

    /// Decay lengths of the long and the short exponential, mm.
    pub fn exponential_lengths_mm(&self) -> [f64; 2] {
        self.exponentials.map(|exponential| exponential.length * self.mean_free_path_mm)
    }

    /// Depths of the dipole's sources, mm.
    pub fn dipole_depths_mm(&self) -> [f64; 2] {
        self.sources.map(|(_, source)| source.depth * self.mean_free_path_mm)
    }

    /// s, the dipole's decay, mm⁻¹. 0 at A = 1.
    pub fn dipole_attenuation_per_mm(&self) -> f64 {
        self.sources[0].1.attenuation / self.mean_free_path_mm
    }

    /// A radius of this profile for a uniform u in [0, 1), without iterating over the profile: u chooses one of the
    /// four parts by its share, and what is left of u inverts that part. -d ln(1 - v) inverts an exponential,
    /// √(W₀(s z e^(sz)/(1 - v))²/s² - z²) a source, W₀ being Lambert's.
    ///
    /// Exact, but not monotone in u as [`sample_radius`](RadialProfile::sample_radius) is: strata of u are strata of
    /// each part, not of the radius.
    pub fn sample_by_composition(&self, u: f64) -> f64 {
        if u.is_nan() {
            return u;
        }
        let mut rest = legal_u(u);
        let weights = self.weights();
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

    /// The radius beyond which the part has the fraction e^(`log_q`), in the order of [`weights`](Self::weights).
    fn part_radius(&self, part: usize, log_q: f64) -> f64 {
        match part {
            0 | 1 => -self.exponentials[part].length * log_q,
            _ => self.sources[part - 2].1.radius_beyond(log_q),
        }
    }

    fn unit_radius(&self, radius_mm: f64) -> f64 {
        legal_radius(legal_radius(radius_mm) / self.mean_free_path_mm)
    }

    fn unit_cdf(&self, r: f64) -> f64 {
        let exponentials = self.exponentials.map(|e| -e.weight * (-r / e.length).exp_m1());
        let sources = self.sources.map(|(weight, source)| weight * source.cdf(r));
        (exponentials[0] + exponentials[1] + sources[0] + sources[1]).clamp(0.0, 1.0)
    }

    fn unit_tail(&self, r: f64) -> f64 {
        let exponentials = self.exponentials.map(|e| e.weight * (-r / e.length).exp());
        let sources = self.sources.map(|(weight, source)| weight * source.tail(r));
        (exponentials[0] + exponentials[1] + sources[0] + sources[1]).clamp(0.0, 1.0)
    }

    /// Σ (w/d) e^(-r/d) of the exponentials. A part without energy counts as 0, however short.
    fn exponential_pdf(&self, r: f64) -> f64 {
        let pdf =
            |e: Exponential| if e.weight > 0.0 { e.weight * ((-r / e.length).exp() / e.length) } else { 0.0 };
        pdf(self.exponentials[0]) + pdf(self.exponentials[1])
    }

    fn unit_radial_pdf(&self, r: f64) -> f64 {
        let [first, second] = self.sources.map(|(weight, source)| weight * source.radial_pdf(r));
        self.exponential_pdf(r) + first + second
    }

    /// ln r at which the cdf is u, in (0, 1), and how often the profile was evaluated for it.
    fn log_quantile(&self, u: f64) -> (f64, u32) {
        let log_q = (-u).ln_1p();
        // The quantile of a mixture lies between those of its parts, and the mean of their logarithms is near.
        let (mut low, mut high, mut start) = (f64::INFINITY, f64::NEG_INFINITY, 0.0);
        for (part, weight) in self.weights().into_iter().enumerate() {
            if weight > 0.0 {
                let bounds = match part {
                    0 | 1 => [-self.exponentials[part].length * log_q; 2],
                    _ => self.sources[part - 2].1.radius_bounds(log_q),
                };
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

impl RadialProfile for TwoExponentialDipoleProfile {
    fn surface_albedo(&self) -> f64 {
        self.surface_albedo
    }

    /// Infinite at r = 0, as 1/r, unless the exponentials have no share.
    fn area_pdf(&self, radius_mm: f64) -> f64 {
        let r = self.unit_radius(radius_mm);
        let exponentials = self.exponential_pdf(r);
        let near = if exponentials > 0.0 { exponentials / (2.0 * PI * r) } else { 0.0 };
        let [first, second] = self.sources.map(|(weight, source)| weight * source.area_pdf(r));
        (near + first + second) / self.mean_free_path_mm / self.mean_free_path_mm
    }

    /// Σ (w/d) e^(-r/d) + Σ w z r (1 + sρ) e^(-s(ρ - z))/ρ³, at mean free path 1.
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
        // Below the smallest normal number logarithms lose their meaning; 0 is off by less than 1e-153 mfp.
        if u < f64::MIN_POSITIVE {
            return 0.0;
        }
        self.log_quantile(u).0.exp() * self.mean_free_path_mm
    }
}

mod published;

#[cfg(test)]
mod tests;
