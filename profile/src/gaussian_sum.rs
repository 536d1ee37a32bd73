//! A sum of Gaussians.
//!
//! Source: d'Eon and Luebke 2007, \[GG3\].

use std::f64::consts::PI;
use std::slice::from_mut;

use crate::description::{
    Coefficient, Contents, Description, Field, Notation, ProfileModel, Published, Slot, Values, Variable,
    visit_all,
};
use crate::inverse::increasing_root;
use crate::quantity::Bounds;
use crate::radial_profile::{legal_radius, legal_u};
use crate::{Channel, Medium, ModelError, Quantity, RadialData, RadialProfile, Requirement};

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

    /// The profile of one channel. Only the surface albedo of the medium is used.
    pub fn profile(&self, medium: Medium, channel: Channel) -> Result<GaussianSumProfile, ModelError> {
        self.validate()?;
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

    /// Gaussians of equal weight, whose medians are evenly spaced in the logarithm of the radius between the 5 % and the
    /// 98 % quantiles of the data.
    fn spread(terms: usize, data: &[RadialData]) -> Self {
        let end = |quantile: f64, fallback: f64| {
            let radii: Vec<f64> =
                data.iter().map(|data| data.quantile(quantile)).filter(|r| *r > 0.0).collect();
            let log_mean = radii.iter().map(|r| r.ln()).sum::<f64>() / radii.len() as f64;
            if radii.is_empty() { fallback } else { log_mean.exp() }
        };
        let (near, far) = (end(0.05, 0.05), end(0.98, 5.0));
        let gaussian = |term: usize| {
            let median = near * (far / near).powf((term as f64 + 0.5) / terms as f64);
            // The cdf 1 - e^(-r²/2v) is ½ at r² = 2v ln 2.
            GaussianTerm {
                variance_mm2: median * median / (2.0 * std::f64::consts::LN_2),
                weight: [1.0 / terms as f64; 3],
            }
        };
        GaussianSumModel { terms: (0..terms).map(gaussian).collect() }
    }
}

/// There is something to sum.
static A_TERM: Requirement = Requirement {
    coefficient: "terms",
    wrong: "a Gaussian sum needs at least one term",
    expected: "expected at least one Gaussian",
    remedy: "for example `GaussianSum([(variance_mm2: 1.0, weight: 1.0)])`",
};

/// There is something to divide the weights by.
static A_WEIGHT: Requirement = Requirement {
    coefficient: "",
    wrong: "weights of the Gaussians sum to 0",
    expected: "all weights of this channel are 0",
    remedy: "give one Gaussian a weight above 0 in each channel; for a black channel set `surface_albedo` to 0",
};

/// What a file says of one term.
const TERM: &[Coefficient<GaussianTerm>] = &[
    Coefficient::new("variance_mm2", "v", "variance along each axis", |term: &mut GaussianTerm| {
        from_mut(&mut term.variance_mm2)
    })
    .quantity(Quantity {
        noun: "Gaussian variance",
        unit: "mm²",
        bounds: Bounds::Positive,
        kind: "number",
        meaning: "give the variance v of e^(-r²/2v)/(2πv) along each axis, in mm²",
    }),
    Coefficient::new("weight", "w", "share of the energy", |term: &mut GaussianTerm| &mut term.weight)
        .values(Values::Channels)
        .quantity(Quantity {
            noun: "Gaussian weight",
            unit: "",
            bounds: Bounds::NonNegative,
            kind: "number",
            meaning: "give this Gaussian's share of the energy, 0 or more",
        }),
];

impl ProfileModel for GaussianSumModel {
    const DESCRIPTION: Description = Description {
        name: "GaussianSum",
        stem: "gaussian_sum",
        caption: "Gaussian sum",
        equation: "R(r)/A = Σ w e^(−r²/2v)/(2πv)",
        notes: "Variances v are absolute: the mean free path does not scale them. Weights are not all 0 in a channel, \
                and are divided by their sum per channel. A sum that is neither 1 nor A (± 0.001) gets a warning.",
        source: "d'Eon and Luebke 2007, GPU Gems 3, ch. 14",
        notation: Notation::Terms {
            term: "Gaussian",
            example: "(variance_mm2: 1.0, weight: (0.3, 0.2, 0.1))",
        },
        example: "GaussianSum([(variance_mm2: 1.0, weight: 1.0)])",
        lengths: &[],
        variable: Variable::SURFACE_ALBEDO,
    };

    const PUBLISHED: &'static [Published<Self>] = &[Published::new(
        "gaussian_skin",
        "",
        "d'Eon and Luebke 2007, GPU Gems 3, §14.4.5: six Gaussians for human skin",
        || GaussianSumModel { terms: Self::SKIN.to_vec() },
    )];

    fn fields() -> Vec<&'static Field> {
        TERM.iter().map(|coefficient| &coefficient.field).collect()
    }

    fn blank(terms: usize) -> Option<Self> {
        Some(GaussianSumModel { terms: vec![GaussianTerm { variance_mm2: 1.0, weight: [1.0; 3] }; terms] })
    }

    fn visit(&mut self, visitor: &mut dyn FnMut(Slot<'_>)) {
        for (index, term) in self.terms.iter_mut().enumerate() {
            visit_all(TERM, term, &format!("terms[{index}]."), visitor);
        }
    }

    fn boxed_profile(&self, medium: Medium, channel: Channel) -> Result<Box<dyn RadialProfile>, ModelError> {
        Ok(Box::new(self.profile(medium, channel)?))
    }

    fn collect_errors(&self, errors: &mut Vec<ModelError>) {
        if self.terms.is_empty() {
            errors.push(A_TERM.broken(None));
            return;
        }
        for channel in Channel::ALL {
            if self.terms.iter().all(|term| term.weight[channel.index()] == 0.0) {
                errors.push(A_WEIGHT.broken(Some(channel)));
            }
        }
    }

    fn start(data: &[RadialData], terms: usize) -> Option<Self> {
        Some(Self::spread(terms.max(1), data))
    }

    fn normalise(&mut self) {
        let sum: f64 = self.terms.iter().map(|term| term.weight[0]).sum();
        if sum.is_finite() && sum > 0.0 {
            for term in &mut self.terms {
                term.weight = term.weight.map(|weight| weight / sum);
            }
        }
    }

    fn contents(&self) -> Contents<'_> {
        Contents::Terms(&self.terms)
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
        let messages: Vec<String> = model.errors().iter().map(ToString::to_string).collect();
        assert_eq!(
            messages,
            [
                "coefficient `terms[0].variance_mm2` is not a finite number",
                "`terms[0].weight[1]` is -0.1",
                "`terms[1].variance_mm2` is 0 mm²",
                "coefficient `terms[1].weight[0]` is not a finite number",
                "blue weights of the Gaussians sum to 0",
            ]
        );
        let empty = GaussianSumModel { terms: Vec::new() }.profile(medium(), Channel::Red);
        assert_eq!(empty, Err(A_TERM.broken(None)));
    }
}
