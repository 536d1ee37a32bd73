//! The profile models, and the published sets of their coefficients.

use crate::{
    BurleyModel, Channel, ExponentialDipoleModel, GaussianSumModel, Length, Medium, ModelError,
    PolynomialModel, RadialProfile, TabulatedModel, TwoExponentialDipoleModel,
};

/// A family of radial profiles, given by its coefficients.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Model {
    /// Burley's normalised diffusion.
    Burley(BurleyModel),
    /// The rational profile that Liang et al. call polynomial.
    Polynomial(PolynomialModel),
    /// A sum of Gaussians.
    GaussianSum(GaussianSumModel),
    /// An exponential plus a dipole.
    ExponentialDipole(ExponentialDipoleModel),
    /// Tables by surface albedo.
    Tabulated(TabulatedModel),
    /// Two exponentials plus a dipole of two sources.
    TwoExponentialDipole(TwoExponentialDipoleModel),
}

impl Model {
    /// The stems that [`published`](Self::published) knows.
    pub const PUBLISHED: [&'static str; 12] = [
        "burley_searchlight",
        "burley_diffuse",
        "burley_dmfp",
        "liang_2023",
        "liang_2023_printed",
        "gaussian_skin",
        "exponential_dipole_searchlight",
        "exponential_dipole_diffuse",
        "two_exponential_dipole_searchlight",
        "two_exponential_dipole_diffuse",
        "two_exponential_dipole_searchlight_eta_1_4",
        "two_exponential_dipole_diffuse_eta_1_4",
    ];

    /// A published set of coefficients by its stem, one of [`PUBLISHED`](Self::PUBLISHED).
    pub fn published(stem: &str) -> Option<Model> {
        Some(match stem {
            "burley_searchlight" => Model::Burley(BurleyModel::SEARCHLIGHT),
            "burley_diffuse" => Model::Burley(BurleyModel::DIFFUSE),
            "burley_dmfp" => Model::Burley(BurleyModel::DIFFUSE_MEAN_FREE_PATH),
            "liang_2023" => Model::Polynomial(PolynomialModel::LIANG_2023),
            "liang_2023_printed" => Model::Polynomial(PolynomialModel::LIANG_2023_PRINTED),
            "gaussian_skin" => {
                Model::GaussianSum(GaussianSumModel { terms: GaussianSumModel::SKIN.to_vec() })
            }
            "exponential_dipole_searchlight" => Model::ExponentialDipole(ExponentialDipoleModel::SEARCHLIGHT),
            "exponential_dipole_diffuse" => Model::ExponentialDipole(ExponentialDipoleModel::DIFFUSE),
            "two_exponential_dipole_searchlight" => {
                Model::TwoExponentialDipole(TwoExponentialDipoleModel::SEARCHLIGHT)
            }
            "two_exponential_dipole_diffuse" => {
                Model::TwoExponentialDipole(TwoExponentialDipoleModel::DIFFUSE)
            }
            "two_exponential_dipole_searchlight_eta_1_4" => {
                Model::TwoExponentialDipole(TwoExponentialDipoleModel::SEARCHLIGHT_ETA_1_4)
            }
            "two_exponential_dipole_diffuse_eta_1_4" => {
                Model::TwoExponentialDipole(TwoExponentialDipoleModel::DIFFUSE_ETA_1_4)
            }
            _ => return None,
        })
    }

    /// Which length [`Medium::length_mm`] must be for this model.
    ///
    /// The Gaussian sum does not use it, and says [`Length::MeanFreePath`].
    pub fn length(&self) -> Length {
        match self {
            Model::Burley(model) => model.length,
            Model::Polynomial(_) => PolynomialModel::LENGTH,
            Model::GaussianSum(_) => GaussianSumModel::LENGTH,
            Model::ExponentialDipole(_) => ExponentialDipoleModel::LENGTH,
            Model::Tabulated(_) => TabulatedModel::LENGTH,
            Model::TwoExponentialDipole(_) => TwoExponentialDipoleModel::LENGTH,
        }
    }

    /// The first of [`errors`](Self::errors).
    pub fn validate(&self) -> Result<(), ModelError> {
        self.errors().into_iter().next().map_or(Ok(()), Err)
    }

    /// All that is wrong with the coefficients alone, whatever the medium.
    pub fn errors(&self) -> Vec<ModelError> {
        let mut errors = Vec::new();
        match self {
            Model::Burley(model) => model.collect_errors(&mut errors),
            Model::Polynomial(model) => model.collect_errors(&mut errors),
            Model::GaussianSum(model) => model.collect_errors(&mut errors),
            Model::ExponentialDipole(model) => model.collect_errors(&mut errors),
            // Checked when it was made.
            Model::Tabulated(_) => {}
            Model::TwoExponentialDipole(model) => model.collect_errors(&mut errors),
        }
        errors
    }

    /// The profile of one channel of a medium, whose length is [`self.length()`](Self::length).
    ///
    /// Coefficients that pass [`validate`](Self::validate) may still describe no profile at a certain surface
    /// albedo; then this says why.
    pub fn profile(&self, medium: Medium, channel: Channel) -> Result<Box<dyn RadialProfile>, ModelError> {
        self.validate()?;
        Ok(match self {
            Model::Burley(model) => Box::new(model.profile(medium)?),
            Model::Polynomial(model) => Box::new(model.profile(medium)?),
            Model::GaussianSum(model) => Box::new(model.profile(medium, channel)?),
            Model::ExponentialDipole(model) => Box::new(model.profile(medium)?),
            Model::Tabulated(model) => Box::new(model.profile(medium)?),
            Model::TwoExponentialDipole(model) => Box::new(model.profile(medium)?),
        })
    }

    /// The integral of 2πr·R/A as the model's equation gives it, before the profile is normalised: how far the
    /// model misses the conservation of energy. 1 for all but the polynomial and tables.
    ///
    /// `surface_albedo` in (0, 1].
    pub fn energy_before_normalization(&self, surface_albedo: f64) -> Result<f64, ModelError> {
        match self {
            Model::Polynomial(model) => model.energy_before_normalization(surface_albedo),
            Model::Tabulated(model) => Ok(model.energy_before_normalization(surface_albedo)),
            _ => Ok(1.0),
        }
    }
}
