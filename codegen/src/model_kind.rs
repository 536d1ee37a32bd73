//! The profile models that have shaders.

use subsurface_profile::Model;

/// The profile models, in the order of their numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum ModelKind {
    Burley,
    ExponentialDipole,
    GaussianSum,
    Polynomial,
    Tabulated,
    TwoExponentialDipole,
}

impl ModelKind {
    pub(crate) fn of(model: &Model) -> Option<Self> {
        match model {
            Model::Burley(_) => Some(Self::Burley),
            Model::ExponentialDipole(_) => Some(Self::ExponentialDipole),
            Model::GaussianSum(_) => Some(Self::GaussianSum),
            Model::Polynomial(_) => Some(Self::Polynomial),
            Model::Tabulated(_) => Some(Self::Tabulated),
            Model::TwoExponentialDipole(_) => Some(Self::TwoExponentialDipole),
            _ => None,
        }
    }

    /// Stem of the shader module, prefix of its functions and name of the row's field.
    pub(crate) fn stem(self) -> &'static str {
        match self {
            Self::Burley => "burley",
            Self::ExponentialDipole => "exponential_dipole",
            Self::GaussianSum => "gaussian_sum",
            Self::Polynomial => "polynomial",
            Self::Tabulated => "tabulated",
            Self::TwoExponentialDipole => "two_exponential_dipole",
        }
    }

    pub(crate) fn structure(self) -> &'static str {
        match self {
            Self::Burley => "BurleyModel",
            Self::ExponentialDipole => "ExponentialDipoleModel",
            Self::GaussianSum => "GaussianSumModel",
            Self::Polynomial => "PolynomialModel",
            Self::Tabulated => "TabulatedModel",
            Self::TwoExponentialDipole => "TwoExponentialDipoleModel",
        }
    }

    /// Whether the model's functions take the `shape` of its row besides the coefficients.
    pub(crate) fn has_shape(self) -> bool {
        self == Self::TwoExponentialDipole
    }

    pub(crate) fn constant(self) -> String {
        format!("MODEL_{}", self.stem().to_ascii_uppercase())
    }
}
