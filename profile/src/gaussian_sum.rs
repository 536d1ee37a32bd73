//! A sum of Gaussians.
//!
//! Source: d'Eon and Luebke 2007, \[GG3\].

use std::f64::consts::PI;

use crate::inverse::increasing_root;
use crate::radial_profile::{legal_radius, legal_u};
use crate::{Channel, Length, Medium, ModelError, RadialProfile};

/// One Gaussian of a [`GaussianSumModel`]: G(v, r) = e^(-r²/2v)/(2πv).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GaussianTerm {
    /// Variance v along each axis, mm², finite and > 0.
    pub variance_mm2: f64,
    /// Share of the energy per channel (red, green, blue), ≥ 0. Only ratios within a channel matter.
    pub weight: [f64; 3],
}

/// A sum of Gaussians, \[GG3\]: R(r)/A = Σ wᵢ G(vᵢ, r).
///
/// The only profile that is radially symmetric and separable at once. Its variances are absolute: they belong
/// to one measured material, and the medium's length does not scale them. The weights of each channel are
/// normalised by their sum.
#[derive(Clone, Debug, PartialEq)]
pub struct GaussianSumModel {
    /// The Gaussians, at least one, in any order.
    pub terms: Vec<GaussianTerm>,
}

impl GaussianSumModel {
    /// Human skin: the six Gaussians that \[GG3\] fits to a three-layer model.
    ///
    /// The weights of each channel sum to 1.
    pub const SKIN: [GaussianTerm; 6] = [
        GaussianTerm { variance_mm2: 0.0064, weight: [0.233, 0.455, 0.649] },
        GaussianTerm { variance_mm2: 0.0484, weight: [0.100, 0.336, 0.344] },
        GaussianTerm { variance_mm2: 0.187, weight: [0.118, 0.198, 0.0] },
        GaussianTerm { variance_mm2: 0.567, weight: [0.113, 0.007, 0.007] },
        GaussianTerm { variance_mm2: 1.99, weight: [0.358, 0.004, 0.0] },
        GaussianTerm { variance_mm2: 7.41, weight: [0.078, 0.0, 0.0] },
    ];

    /// The length this model is said to be parametrized by. It has no effect.
    pub const LENGTH: Length = Length::MeanFreePath;

    /// The profile of one channel. Only the surface albedo of the medium is used.
    pub fn profile(&self, medium: Medium, channel: Channel) -> Result<GaussianSumProfile, ModelError> {
        let mut errors = Vec::new();
        self.collect_errors(&mut errors);
        if let Some(first) = errors.into_iter().next() {
            return Err(first);
        }
        let weight = |term: &GaussianTerm| term.weight[channel.index()];
        // Divided by the largest first, so that no sum of finite weights overflows.
        let largest = self.terms.iter().map(weight).fold(0.0, f64::max);
        let sum: f64 = self.terms.iter().map(|term| weight(term) / largest).sum();
        let gaussians = self
            .terms
            .iter()
            .filter(|term| weight(term) > 0.0)
            .map(|term| Gaussian { variance: term.variance_mm2, weight: weight(term) / largest / sum })
            .collect();
        Ok(GaussianSumProfile { surface_albedo: medium.surface_albedo(), gaussians })
    }

    pub(crate) fn collect_errors(&self, errors: &mut Vec<ModelError>) {
        if self.terms.is_empty() {
            errors.push(ModelError::NoTerms);
            return;
        }
        for (index, term) in self.terms.iter().enumerate() {
            let variance_mm2 = term.variance_mm2;
            if !variance_mm2.is_finite() {
                errors.push(ModelError::NotFinite { coefficient: format!("terms[{index}].variance_mm2") });
            } else if variance_mm2 <= 0.0 {
                errors.push(ModelError::VarianceNotPositive { term: index, variance_mm2 });
            }
            for channel in Channel::ALL {
                let weight = term.weight[channel.index()];
                if !weight.is_finite() {
                    let coefficient = format!("terms[{index}].weight[{}]", channel.index());
                    errors.push(ModelError::NotFinite { coefficient });
                } else if weight < 0.0 {
                    errors.push(ModelError::NegativeWeight { term: index, channel, weight });
                }
            }
        }
        for channel in Channel::ALL {
            if self.terms.iter().all(|term| term.weight[channel.index()] == 0.0) {
                errors.push(ModelError::WeightsSumToZero { channel });
            }
        }
    }
}

/// One Gaussian of one channel, its weight normalised and > 0.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Gaussian {
    /// mm².
    variance: f64,
    weight: f64,
}

impl Gaussian {
    /// -x/2v, the logarithm of the Gaussian's tail beyond the radius √x.
    fn log_tail(&self, x: f64) -> f64 {
        -0.5 * x / self.variance
    }
}

/// The member of [`GaussianSumModel`] that belongs to one medium and channel.
#[derive(Clone, Debug, PartialEq)]
pub struct GaussianSumProfile {
    surface_albedo: f64,
    /// At least one.
    gaussians: Vec<Gaussian>,
}

impl GaussianSumProfile {
    /// Fraction of the energy within the radius √x.
    fn cdf_of_square(&self, x: f64) -> f64 {
        let cdf: f64 = self.gaussians.iter().map(|g| -g.weight * g.log_tail(x).exp_m1()).sum();
        // The normalised weights sum to 1 only up to rounding.
        cdf.clamp(0.0, 1.0)
    }

    /// Fraction of the energy beyond the radius √x.
    fn tail_of_square(&self, x: f64) -> f64 {
        let tail: f64 = self.gaussians.iter().map(|g| g.weight * g.log_tail(x).exp()).sum();
        tail.clamp(0.0, 1.0)
    }
}

impl RadialProfile for GaussianSumProfile {
    fn surface_albedo(&self) -> f64 {
        self.surface_albedo
    }

    /// Σ wᵢ G(vᵢ, r). Finite at r = 0.
    fn area_pdf(&self, radius_mm: f64) -> f64 {
        let r = legal_radius(radius_mm);
        self.gaussians.iter().map(|g| g.weight * g.log_tail(r * r).exp() / (2.0 * PI * g.variance)).sum()
    }

    fn radial_pdf(&self, radius_mm: f64) -> f64 {
        let r = legal_radius(radius_mm);
        self.gaussians.iter().map(|g| g.weight * g.log_tail(r * r).exp() * r / g.variance).sum()
    }

    /// Σ wᵢ(1 - e^(-r²/2v)).
    fn radial_cdf(&self, radius_mm: f64) -> f64 {
        let r = legal_radius(radius_mm);
        self.cdf_of_square(r * r)
    }

    fn radial_tail(&self, radius_mm: f64) -> f64 {
        let r = legal_radius(radius_mm);
        self.tail_of_square(r * r)
    }

    /// Newton's method on the logarithm of the tail S as a function of x = r², which is convex and decreasing
    /// (a log-sum-exp of straight lines), so that it converges monotonically from below.
    fn sample_radius(&self, u: f64) -> f64 {
        if u.is_nan() {
            return u;
        }
        let u = legal_u(u);
        let log_q = (-u).ln_1p();
        let bounds = |bound: &dyn Fn(&Gaussian) -> f64| self.gaussians.iter().map(bound).fold(0.0, f64::max);
        // Where one Gaussian alone holds the fraction q, the sum holds more.
        let one_alone = bounds(&|g| 2.0 * g.variance * (g.weight.ln() - log_q));
        // Jensen's inequality: Σ w e^(-x/2v) ≥ e^(-x Σ w/2v).
        let jensen = -log_q / self.gaussians.iter().map(|g| 0.5 * g.weight / g.variance).sum::<f64>();
        // All the energy in the widest Gaussian would be the farthest.
        let upper = -2.0 * log_q * bounds(&|g| g.variance);
        let value_and_slope = |x: f64| {
            let slope_over_tail: f64 =
                self.gaussians.iter().map(|g| 0.5 * g.weight / g.variance * g.log_tail(x).exp()).sum();
            let cdf = self.cdf_of_square(x);
            // Near x = 0 the tail's logarithm needs the cdf, far out it needs the tail.
            let log_tail = if cdf < 0.5 { (-cdf).ln_1p() } else { self.tail_of_square(x).ln() };
            (log_q - log_tail, slope_over_tail / self.tail_of_square(x))
        };
        increasing_root(value_and_slope, [0.0, upper], one_alone.max(jensen), 0.0).sqrt()
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may panic")]

    use super::*;

    fn medium() -> Medium {
        Medium::new(0.5, 1.0).unwrap()
    }

    fn one(variance_mm2: f64, weight: [f64; 3]) -> GaussianSumModel {
        GaussianSumModel { terms: vec![GaussianTerm { variance_mm2, weight }] }
    }

    #[test]
    fn skin_weights_sum_to_one() {
        for channel in Channel::ALL {
            let sum: f64 = GaussianSumModel::SKIN.iter().map(|term| term.weight[channel.index()]).sum();
            // The paper's three decimals sum exactly, their doubles to a rounding.
            assert!((sum - 1.0).abs() < 1e-15, "{channel}: {sum}");
        }
    }

    #[test]
    fn one_gaussian_has_its_closed_inverse() {
        let profile = one(3.0, [0.2, 0.2, 0.2]).profile(medium(), Channel::Green).unwrap();
        for u in [1e-300, 1e-9, 0.1, 0.5, 0.9, 1.0 - 1e-12] {
            let exact = (-6.0 * f64::ln_1p(-u)).sqrt();
            // The two bounds of the bracket coincide up to rounding.
            assert!((profile.sample_radius(u) / exact - 1.0).abs() < 1e-14, "{u}");
        }
    }

    #[test]
    fn the_length_does_not_scale_it_and_only_ratios_of_weights_matter() {
        let here = one(3.0, [0.2, 0.3, 0.4]).profile(medium(), Channel::Red).unwrap();
        let there =
            one(3.0, [1e308, 0.3, 0.4]).profile(Medium::new(0.5, 1e4).unwrap(), Channel::Red).unwrap();
        assert_eq!(here, there);
    }

    #[test]
    fn variances_of_many_decades_are_no_trouble() {
        let terms = [1e-12, 1e-3, 1.0, 1e9]
            .map(|variance_mm2| GaussianTerm { variance_mm2, weight: [1.0, 1e-9, 1e9] });
        let profile = GaussianSumModel { terms: terms.to_vec() }.profile(medium(), Channel::Red).unwrap();
        for step in 1..1000 {
            let u = f64::from(step) / 1000.0;
            // x = r² is solved to 2 ε; the plateaus between the Gaussians make u less sensitive, not more.
            assert!((profile.radial_cdf(profile.sample_radius(u)) - u).abs() < 1e-14, "{u}");
        }
    }

    #[test]
    fn all_errors_are_found_and_placed() {
        let mut model = one(f64::NAN, [0.1, -0.1, 0.0]);
        model.terms.push(GaussianTerm { variance_mm2: 0.0, weight: [f64::INFINITY, 0.1, 0.0] });
        let mut errors = Vec::new();
        model.collect_errors(&mut errors);
        assert_eq!(
            errors,
            [
                ModelError::NotFinite { coefficient: "terms[0].variance_mm2".into() },
                ModelError::NegativeWeight { term: 0, channel: Channel::Green, weight: -0.1 },
                ModelError::VarianceNotPositive { term: 1, variance_mm2: 0.0 },
                ModelError::NotFinite { coefficient: "terms[1].weight[0]".into() },
                ModelError::WeightsSumToZero { channel: Channel::Blue },
            ]
        );
        assert_eq!(
            GaussianSumModel { terms: Vec::new() }.profile(medium(), Channel::Red),
            Err(ModelError::NoTerms)
        );
    }
}
