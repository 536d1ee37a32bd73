//! A mixture of profiles.

use std::slice::from_mut;

use crate::description::{
    Coefficient, Contents, Dependence, Description, Field, Notation, ProfileModel, Published, Slot, Variable,
    visit_all,
};
use crate::inverse::increasing_root;
use crate::quantity::Bounds;
use crate::radial_profile::legal_u;
use crate::{
    BurleyModel, BurleyShape, Channel, Length, Medium, Model, ModelError, Quantity, RadialData,
    RadialProfile, Requirement,
};

/// One part of a [`MixtureModel`].
#[derive(Clone, Debug, PartialEq)]
pub struct MixturePart {
    /// Share of the energy, ≥ 0. Only ratios matter.
    pub weight: f64,
    /// Any model, a mixture included.
    pub model: Model,
}

/// A mixture of any profiles: R(r) = Σ wᵢ Rᵢ(r), the weights divided by their sum.
///
/// The cdf is the weighted sum of the parts' too, and a mixture of profiles is a profile. Parts whose lengths are
/// absolute keep them, the others are scaled by the medium's length, which must be the same kind of length for all.
#[derive(Clone, Debug, PartialEq)]
pub struct MixtureModel {
    /// The parts, at least one, in any order.
    pub parts: Vec<MixturePart>,
}

impl MixtureModel {
    /// Most parts that are no mixtures themselves: a kernel evaluates every one for each tap.
    pub const MAXIMUM_PARTS: usize = 8;

    /// The parts, those of mixtures within included, which are none themselves; the weights sum to 1.
    pub fn leaves(&self) -> Vec<(f64, &Model)> {
        let sum: f64 = self.parts.iter().map(|part| part.weight).sum();
        let leaves = self.parts.iter().flat_map(|part| {
            let share = part.weight / sum;
            part.model.leaves().into_iter().map(move |(weight, model)| (share * weight, model))
        });
        leaves.collect()
    }

    /// The profile of one channel of a medium.
    pub fn profile(&self, medium: Medium, channel: Channel) -> Result<MixtureProfile, ModelError> {
        self.validate()?;
        let sum: f64 = self.parts.iter().map(|part| part.weight).sum();
        let mut parts = Vec::with_capacity(self.parts.len());
        for (index, part) in self.parts.iter().enumerate() {
            let profile = part.model.profile(medium, channel);
            let profile =
                profile.map_err(|error| ModelError::OfPart { part: index, error: Box::new(error) })?;
            if part.weight > 0.0 {
                parts.push((part.weight / sum, profile));
            }
        }
        Ok(MixtureProfile { surface_albedo: medium.surface_albedo(), parts })
    }
}

/// There is something to mix.
static A_PART: Requirement = Requirement {
    coefficient: "parts",
    wrong: "a mixture needs at least one part",
    expected: "expected at least one part",
    remedy: "for example `Mixture([(weight: 1.0, model: Burley(parametrization: Searchlight))])`",
};

/// There is something to divide the weights by.
static A_WEIGHT: Requirement = Requirement {
    coefficient: "parts",
    wrong: "the weights of the parts sum to 0",
    expected: "all weights are 0",
    remedy: "give one part a weight above 0",
};

/// A kernel has to evaluate all parts.
static FEW_PARTS: Requirement = Requirement {
    coefficient: "parts",
    wrong: "the mixture has {} parts, those of mixtures within counted",
    expected: "expected at most 8",
    remedy: "fit fewer parts to the same profile, or write it as a table: `Tabulated(file: \"my_table.csv\")`",
};

/// One length scales all parts.
static ONE_LENGTH: Requirement = Requirement {
    coefficient: "parts",
    wrong: "the parts of the mixture are parametrized by different lengths",
    expected: "expected the mean free path for all of them, or the diffuse mean free path for all",
    remedy: "a material gives one of the two: choose parts that take the same, such as `Burley(parametrization: Searchlight)`",
};

/// What a file says of a part besides its model.
const WEIGHT: Coefficient<MixturePart> =
    Coefficient::<MixturePart>::new("weight", "w", "share of the energy", |part| from_mut(&mut part.weight))
        .quantity(Quantity {
            noun: "weight of a part",
            unit: "",
            bounds: Bounds::NonNegative,
            kind: "number",
            meaning: "give this part's share of the energy, 0 or more",
        });

/// Only ratios of weights matter, so a fit leaves that of the first part as it is.
const FIRST_PART: &[Coefficient<MixturePart>] = &[WEIGHT.never_fitted()];

const OTHER_PARTS: &[Coefficient<MixturePart>] = &[WEIGHT];

impl ProfileModel for MixtureModel {
    const DESCRIPTION: Description = Description {
        name: "Mixture",
        stem: "mixture",
        caption: "mixture",
        equation: "R(r) = Σ w Rᵢ(r), Rᵢ the profiles of the parts",
        notes: "`model` is any model, written out; mixtures within mixtures count by their parts, of which there are at \
                most 8. Weights are divided by their sum; a sum that is not 1 (± 0.001) gets a warning. Parts with lengths \
                of their own keep them, the others share the material's. A part may also be written as a pair: \
                `(0.3, Burley(parametrization: Searchlight))`. A fit leaves the first weight as it is, because only \
                ratios count.",
        source: "any models",
        notation: Notation::Parts,
        example: "Mixture([(weight: 0.3, model: Burley(parametrization: Searchlight)), \
                  (weight: 0.7, model: Burley(parametrization: Diffuse))])",
        lengths: &[],
        variable: Variable::SURFACE_ALBEDO,
    };

    const PUBLISHED: &'static [Published<Self>] = &[];

    fn fields() -> Vec<&'static Field> {
        OTHER_PARTS.iter().map(|coefficient| &coefficient.field).collect()
    }

    fn blank(_terms: usize) -> Option<Self> {
        None
    }

    fn visit(&mut self, visitor: &mut dyn FnMut(Slot<'_>)) {
        for (index, part) in self.parts.iter_mut().enumerate() {
            let fields = if index == 0 { FIRST_PART } else { OTHER_PARTS };
            visit_all(fields, part, &format!("parts[{index}]."), visitor);
            part.model.visit(&mut |slot| {
                let Slot { prefix, field, values } = slot;
                visitor(Slot { prefix: &format!("parts[{index}].model.{prefix}"), field, values });
            });
        }
    }

    fn boxed_profile(&self, medium: Medium, channel: Channel) -> Result<Box<dyn RadialProfile>, ModelError> {
        Ok(Box::new(self.profile(medium, channel)?))
    }

    fn collect_errors(&self, errors: &mut Vec<ModelError>) {
        if self.parts.is_empty() {
            errors.push(A_PART.broken(None));
            return;
        }
        if self.parts.iter().all(|part| part.weight == 0.0) {
            errors.push(A_WEIGHT.broken(None));
        }
        let count = self.leaves().len();
        if count > Self::MAXIMUM_PARTS {
            errors.push(FEW_PARTS.broken_by(count as f64));
        }
        let scaled =
            || self.parts.iter().map(|part| &part.model).filter(|model| model.dependence().on_length());
        if scaled().any(|model| model.length() != self.length()) {
            errors.push(ONE_LENGTH.broken(None));
        }
        for (index, part) in self.parts.iter().enumerate() {
            let mut of_part = Vec::new();
            part.model.collect_errors(&mut of_part);
            let wrap = |error| ModelError::OfPart { part: index, error: Box::new(error) };
            errors.extend(of_part.into_iter().map(wrap));
        }
    }

    fn length(&self) -> Length {
        let mut scaled =
            self.parts.iter().map(|part| &part.model).filter(|model| model.dependence().on_length());
        scaled.next().map_or(Length::MeanFreePath, Model::length)
    }

    fn dependence(&self) -> Dependence {
        let of_parts = || self.parts.iter().map(|part| part.model.dependence());
        match (of_parts().any(Dependence::on_length), of_parts().any(Dependence::on_channel)) {
            (true, true) => Dependence::MediumAndChannel,
            (false, true) => Dependence::Channel,
            (_, false) => Dependence::Medium,
        }
    }

    fn make_constant(&mut self, surface_albedo: f64) {
        for part in &mut self.parts {
            part.model.make_constant(surface_albedo);
        }
    }

    /// Two of Burley's profiles, half and half: that for diffuse entry, and that for perpendicular entry at twice its
    /// width. (With equal shapes the fit creeps along a valley, six times as long.)
    fn start(_data: &[RadialData], _terms: usize) -> Option<Self> {
        let BurleyShape { constant, slope, amplitude, .. } = BurleyShape::SEARCHLIGHT;
        let [constant, slope, amplitude] = [constant, slope, amplitude].map(|factor| 0.5 * factor);
        let shape = BurleyShape { constant, slope, amplitude, ..BurleyShape::SEARCHLIGHT };
        let parts = [BurleyModel::DIFFUSE, BurleyModel { shape, ..BurleyModel::SEARCHLIGHT }];
        let parts = parts.map(|model| MixturePart { weight: 0.5, model: Model::Burley(model) });
        Some(MixtureModel { parts: parts.to_vec() })
    }

    fn normalise(&mut self) {
        let sum: f64 = self.parts.iter().map(|part| part.weight).sum();
        for part in &mut self.parts {
            if sum.is_finite() && sum > 0.0 {
                part.weight /= sum;
            }
            part.model.normalise();
        }
    }

    fn contents(&self) -> Contents<'_> {
        Contents::Parts(self)
    }
}

/// The member of [`MixtureModel`] that belongs to one medium and channel.
#[derive(Debug)]
pub struct MixtureProfile {
    surface_albedo: f64,
    /// Shares above 0 that sum to 1, and the profiles; at least one.
    parts: Vec<(f64, Box<dyn RadialProfile>)>,
}

impl MixtureProfile {
    fn sum(&self, of_part: impl Fn(&dyn RadialProfile) -> f64) -> f64 {
        self.parts.iter().map(|(weight, profile)| weight * of_part(&**profile)).sum()
    }
}

impl RadialProfile for MixtureProfile {
    fn surface_albedo(&self) -> f64 {
        self.surface_albedo
    }

    fn area_pdf(&self, radius_mm: f64) -> f64 {
        self.sum(|profile| profile.area_pdf(radius_mm))
    }

    fn radial_pdf(&self, radius_mm: f64) -> f64 {
        self.sum(|profile| profile.radial_pdf(radius_mm))
    }

    fn radial_cdf(&self, radius_mm: f64) -> f64 {
        // The shares sum to 1 only up to rounding.
        self.sum(|profile| profile.radial_cdf(radius_mm)).clamp(0.0, 1.0)
    }

    fn radial_tail(&self, radius_mm: f64) -> f64 {
        self.sum(|profile| profile.radial_tail(radius_mm)).clamp(0.0, 1.0)
    }

    /// Newton's method between the parts' quantiles, in the logarithms of r and of the cdf or, in the far half, the tail.
    fn sample_radius(&self, u: f64) -> f64 {
        if u.is_nan() {
            return u;
        }
        let u = legal_u(u);
        // Below the smallest normal number logarithms lose their meaning.
        if u < f64::MIN_POSITIVE {
            return 0.0;
        }
        let (mut low, mut high, mut start) = (f64::INFINITY, f64::NEG_INFINITY, 0.0);
        for (weight, profile) in &self.parts {
            let quantile = profile.sample_radius(u).max(f64::MIN_POSITIVE).ln();
            (low, high) = (low.min(quantile), high.max(quantile));
            start += weight * quantile;
        }
        let (log_u, log_q) = (u.ln(), (-u).ln_1p());
        let value_and_slope = |log_r: f64| {
            let r = log_r.exp();
            let pdf = r * self.radial_pdf(r);
            if u < 0.5 {
                let cdf = self.radial_cdf(r);
                (cdf.ln() - log_u, pdf / cdf)
            } else {
                let tail = self.radial_tail(r);
                (log_q - tail.ln(), pdf / tail)
            }
        };
        increasing_root(value_and_slope, [low, high], start, 1.0).exp()
    }

    fn max_radius(&self) -> Option<f64> {
        let ends: Option<Vec<f64>> = self.parts.iter().map(|(_, profile)| profile.max_radius()).collect();
        ends?.into_iter().reduce(f64::max)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may panic")]

    use super::*;

    fn mixture(parts: impl IntoIterator<Item = (f64, Model)>) -> MixtureModel {
        let parts = parts.into_iter().map(|(weight, model)| MixturePart { weight, model });
        MixtureModel { parts: parts.collect() }
    }

    fn published(stem: &str) -> Model {
        Model::published(stem).unwrap()
    }

    /// Mixtures of all models that are published, of two kinds of lengths, and of mixtures.
    fn mixtures() -> Vec<MixtureModel> {
        let two = mixture([(1.0, published("burley_searchlight")), (3.0, published("liang_2023"))]);
        let dmfp = mixture([(0.5, published("burley_dmfp")), (0.5, published("gaussian_skin"))]);
        let nested = mixture([
            (0.2, published("gaussian_skin")),
            (0.3, two.clone().into()),
            (0.5, published("dipole_marble")),
            (0.0, published("two_exponential_dipole_diffuse")),
        ]);
        vec![two, dmfp, nested]
    }

    fn at(model: &MixtureModel, surface_albedo: f64, channel: Channel) -> MixtureProfile {
        model.profile(Medium::new(surface_albedo, 1.3).unwrap(), channel).unwrap()
    }

    #[test]
    fn it_is_the_weighted_sum_of_its_parts() {
        let model = &mixtures()[2];
        let p = at(model, 0.7, Channel::Green);
        let leaves = model.leaves();
        assert_eq!(leaves.len(), 5);
        let shares: Vec<f64> = leaves.iter().map(|(weight, _)| *weight).collect();
        for (share, expected) in shares.iter().zip([0.2, 0.075, 0.225, 0.5, 0.0]) {
            assert!((share - expected).abs() < 1e-15, "{shares:?}");
        }
        for r in [1e-3, 0.1, 1.0, 10.0] {
            let medium = Medium::new(0.7, 1.3).unwrap();
            let sum = |of: &dyn Fn(&dyn RadialProfile) -> f64| -> f64 {
                let part = |(w, m): &(f64, &Model)| w * of(&*m.profile(medium, Channel::Green).unwrap());
                leaves.iter().map(part).sum()
            };
            // The order of the sums differs.
            let is_near = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-14;
            assert!(is_near(p.area_pdf(r), sum(&|p| p.area_pdf(r))), "{r}");
            assert!(is_near(p.radial_cdf(r), sum(&|p| p.radial_cdf(r))), "{r}");
            assert!(is_near(p.radial_tail(r), sum(&|p| p.radial_tail(r))), "{r}");
        }
    }

    #[test]
    fn the_inverse_is_exact_across_its_parts() {
        for model in mixtures() {
            for surface_albedo in [0.0, 0.3, 0.9, 1.0] {
                let p = at(&model, surface_albedo, Channel::Red);
                let mut last = 0.0;
                for u in [0.0, 1e-300, 1e-12, 1e-3, 0.1, 0.4999, 0.5, 0.7, 0.95, 0.999, 1.0 - 1e-9] {
                    let r = p.sample_radius(u);
                    assert!(r >= last && r.is_finite(), "{u}: {r}");
                    last = r;
                    // A radius is solved to a few roundings of its logarithm.
                    assert!((p.radial_cdf(r) - u).abs() <= 2e-13 * u, "{u}: {}", p.radial_cdf(r));
                    let q = 1.0 - u;
                    // Where the polynomial ends the tail falls with the square of the distance: half of the digits.
                    assert!((p.radial_tail(r) - q).abs() <= 1e-12 * q, "{u}: {}", p.radial_tail(r));
                }
                assert!(p.sample_radius(f64::NAN).is_nan());
            }
        }
    }

    #[test]
    fn the_density_is_the_slope_of_the_cdf() {
        for model in mixtures() {
            let p = at(&model, 0.6, Channel::Blue);
            for u in [0.05, 0.3, 0.6, 0.9] {
                let r = p.sample_radius(u);
                let h = 1e-5 * r;
                let slope = (p.radial_cdf(r + h) - p.radial_cdf(r - h)) / (2.0 * h);
                // The error of the central difference is h²/6 of the third derivative, and 1e-16/h of rounding.
                assert!((slope / p.radial_pdf(r) - 1.0).abs() < 1e-6, "{u}");
                let expected = 2.0 * std::f64::consts::PI * r * p.area_pdf(r);
                assert!((p.radial_pdf(r) / expected - 1.0).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn it_depends_on_what_its_parts_depend_on() {
        let [two, dmfp, nested] = <[_; 3]>::try_from(mixtures()).unwrap();
        assert_eq!((two.dependence(), two.length()), (Dependence::Medium, Length::MeanFreePath));
        assert_eq!(
            (dmfp.dependence(), dmfp.length()),
            (Dependence::MediumAndChannel, Length::DiffuseMeanFreePath)
        );
        assert_eq!(nested.dependence(), Dependence::MediumAndChannel);
        let absolute = mixture([(1.0, published("gaussian_skin")), (1.0, published("dipole_skin1"))]);
        assert_eq!(absolute.dependence(), Dependence::Channel);
        assert!(at(&two, 0.5, Channel::Red).max_radius().is_none());
        let ends = mixture([(1.0, published("liang_2023")), (1.0, published("liang_2023_printed"))]);
        let (end, printed) = (at(&ends, 0.5, Channel::Red), published("liang_2023_printed"));
        let printed = printed.profile(Medium::new(0.5, 1.3).unwrap(), Channel::Red).unwrap();
        assert_eq!(end.max_radius(), printed.max_radius());
    }

    #[test]
    fn what_is_no_mixture_says_why() {
        let messages = |model: &MixtureModel| -> Vec<String> {
            model.errors().iter().map(ToString::to_string).collect()
        };
        assert_eq!(messages(&mixture([])), ["a mixture needs at least one part"]);
        let burley = || published("burley_searchlight");
        assert_eq!(messages(&mixture([(0.0, burley())])), ["the weights of the parts sum to 0"]);
        assert_eq!(messages(&mixture([(-1.0, burley())])), ["`parts[0].weight` is -1"]);
        let many = mixture((0..9).map(|_| (1.0, burley())));
        assert_eq!(messages(&many), ["the mixture has 9 parts, those of mixtures within counted"]);
        let lengths = mixture([(1.0, burley()), (1.0, published("burley_dmfp"))]);
        assert_eq!(messages(&lengths), ["the parts of the mixture are parametrized by different lengths"]);
        let bad = crate::GaussianSumModel { terms: Vec::new() };
        let nested = mixture([(1.0, burley()), (1.0, bad.into())]);
        assert_eq!(messages(&nested), ["part 1 (from 0): a Gaussian sum needs at least one term"]);
        assert_eq!(nested.errors()[0].coefficient(), "parts[1].model.terms");
    }
}
