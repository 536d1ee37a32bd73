//! The families of models that can be fitted, and where their fits start.

use crate::{
    BurleyModel, ExponentialDipoleModel, GaussianSumModel, GaussianTerm, Model, PolynomialModel, RadialData,
    TwoExponentialDipoleModel,
};

/// A family of models, with its start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Family {
    /// Burley's normalised diffusion, from \[CB15\] eq. (5).
    Burley,
    /// The rational profile of Liang et al., from the paper's corrected coefficients.
    Polynomial,
    /// A sum of so many Gaussians; 0 counts as 1.
    GaussianSum {
        /// Number of Gaussians.
        terms: usize,
    },
    /// An exponential plus a dipole, from the coefficients for searchlight entry.
    ExponentialDipole,
    /// Two exponentials plus a dipole of two sources, from the coefficients for searchlight entry.
    TwoExponentialDipole,
}

impl Family {
    /// Gaussians that [`from_name`](Self::from_name) takes.
    pub const GAUSSIANS: usize = 4;

    /// Names that [`from_name`](Self::from_name) knows.
    pub const NAMES: [&'static str; 5] =
        ["burley", "polynomial", "gaussian_sum", "exponential_dipole", "two_exponential_dipole"];

    /// A family by its name, one of [`NAMES`](Self::NAMES).
    pub fn from_name(name: &str) -> Option<Family> {
        Some(match name {
            "burley" => Family::Burley,
            "polynomial" => Family::Polynomial,
            "gaussian_sum" => Family::GaussianSum { terms: Self::GAUSSIANS },
            "exponential_dipole" => Family::ExponentialDipole,
            "two_exponential_dipole" => Family::TwoExponentialDipole,
            _ => return None,
        })
    }

    /// Where a fit of this family to `data` starts.
    pub fn start(&self, data: &[RadialData]) -> Model {
        match *self {
            Family::Burley => Model::Burley(BurleyModel::SEARCHLIGHT),
            Family::Polynomial => Model::Polynomial(PolynomialModel::LIANG_2023),
            Family::GaussianSum { terms } => Model::GaussianSum(spread_gaussians(terms.max(1), data)),
            Family::ExponentialDipole => Model::ExponentialDipole(ExponentialDipoleModel::SEARCHLIGHT),
            Family::TwoExponentialDipole => {
                Model::TwoExponentialDipole(TwoExponentialDipoleModel::SEARCHLIGHT)
            }
        }
    }
}

/// Gaussians of equal weight, whose medians are evenly spaced in the logarithm of the radius between the 5 % and
/// the 98 % quantiles of the data.
fn spread_gaussians(terms: usize, data: &[RadialData]) -> GaussianSumModel {
    let end = |quantile: f64, fallback: f64| {
        let radii: Vec<f64> = data.iter().map(|data| data.quantile(quantile)).filter(|r| *r > 0.0).collect();
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
