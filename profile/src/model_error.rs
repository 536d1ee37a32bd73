//! Why a model has no profile.

use std::fmt;

use crate::quantity::rounded;
use crate::{Channel, Quantity};

/// What a model demands of its coefficients together, or of what they make at a surface albedo.
///
/// It stands in the description of the model, and says in words what is wrong where it is not met.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Requirement {
    /// Path of the coefficient to blame, such as `exponential_weight`; empty for the model as a whole.
    pub coefficient: &'static str,
    /// What is wrong. `{}` stands for the value.
    pub wrong: &'static str,
    /// What is expected there.
    pub expected: &'static str,
    /// What to change.
    pub remedy: &'static str,
}

impl Requirement {
    /// The error of a value that breaks the requirement at a surface albedo.
    pub(crate) const fn broken_at(&'static self, surface_albedo: f64, value: f64) -> ModelError {
        ModelError::Broken {
            requirement: self,
            value: Some(value),
            channel: None,
            surface_albedo: Some(surface_albedo),
        }
    }

    /// The error of a value that breaks the requirement whatever the surface albedo.
    pub(crate) const fn broken_by(&'static self, value: f64) -> ModelError {
        ModelError::Broken { requirement: self, value: Some(value), channel: None, surface_albedo: None }
    }

    /// The error of coefficients that break the requirement whatever the surface albedo.
    pub(crate) const fn broken(&'static self, channel: Option<Channel>) -> ModelError {
        ModelError::Broken { requirement: self, value: None, channel, surface_albedo: None }
    }
}

/// Why coefficients describe no profile, or none for a certain medium.
///
/// Shown, it is the message; [`coefficient`](Self::coefficient), [`expected`](Self::expected) and
/// [`remedy`](Self::remedy) say where to point, and what to do.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ModelError {
    /// A coefficient is infinite or not a number.
    NotFinite {
        /// Path of the field from its model, such as `a.linear`, `terms[2].variance_mm2` or `dipole_depth[0]`.
        coefficient: String,
    },
    /// A coefficient is out of the bounds of its quantity.
    OutOfBounds {
        /// Path of the field from its model.
        coefficient: String,
        /// The value given.
        value: f64,
        /// What it should be.
        quantity: &'static Quantity,
    },
    /// Coefficients break what their model demands.
    Broken {
        /// What is demanded.
        requirement: &'static Requirement,
        /// The value that breaks it, where one does.
        value: Option<f64>,
        /// The channel in which it is broken, where channels differ.
        channel: Option<Channel>,
        /// Surface albedo of the medium; `None` where the coefficients are wrong for every medium.
        surface_albedo: Option<f64>,
    },
    /// Finite coefficients gave a quantity that is infinite, or too small to divide by.
    OutOfNumericRange {
        /// Symbol of the quantity in the model's equation.
        quantity: &'static str,
        /// Surface albedo of the medium.
        surface_albedo: f64,
    },
    /// What is wrong with a part of a mixture.
    OfPart {
        /// Position of the part, from 0.
        part: usize,
        /// What is wrong with it.
        error: Box<ModelError>,
    },
}

impl ModelError {
    /// Path of the coefficient to blame, from the model; empty for the model as a whole.
    pub fn coefficient(&self) -> String {
        match self {
            Self::NotFinite { coefficient } | Self::OutOfBounds { coefficient, .. } => coefficient.clone(),
            Self::Broken { requirement, .. } => requirement.coefficient.to_owned(),
            Self::OutOfNumericRange { .. } => String::new(),
            Self::OfPart { part, error } => format!("parts[{part}].model.{}", error.coefficient()),
        }
    }

    /// What is expected there, in a few words.
    pub fn expected(&self) -> String {
        match self {
            Self::NotFinite { .. } => "not a finite number".to_owned(),
            Self::OutOfBounds { quantity, .. } => quantity.expected(),
            Self::Broken { requirement, .. } => requirement.expected.to_owned(),
            Self::OutOfNumericRange { .. } => "this model has no profile".to_owned(),
            Self::OfPart { error, .. } => error.expected(),
        }
    }

    /// What to change.
    pub fn remedy(&self) -> &'static str {
        match self {
            Self::NotFinite { .. } => Quantity::COEFFICIENT.meaning,
            Self::OutOfBounds { quantity, .. } => quantity.meaning,
            Self::Broken { requirement, .. } => requirement.remedy,
            Self::OutOfNumericRange { .. } => "compare with a published set of coefficients",
            Self::OfPart { error, .. } => error.remedy(),
        }
    }

    /// The surface albedo at which there is no profile; `None` where the coefficients are wrong for every medium.
    pub fn surface_albedo(&self) -> Option<f64> {
        match self {
            Self::NotFinite { .. } | Self::OutOfBounds { .. } => None,
            Self::Broken { surface_albedo, .. } => *surface_albedo,
            Self::OutOfNumericRange { surface_albedo, .. } => Some(*surface_albedo),
            Self::OfPart { error, .. } => error.surface_albedo(),
        }
    }
}

impl fmt::Display for ModelError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { coefficient } => {
                write!(f, "coefficient `{coefficient}` is not a finite number")
            }
            Self::OutOfBounds { coefficient, value, quantity } => {
                let space = if quantity.unit.is_empty() { "" } else { " " };
                write!(f, "`{coefficient}` is {}{space}{}", rounded(*value), quantity.unit)
            }
            Self::Broken { requirement, value, channel, surface_albedo } => {
                if let Some(channel) = channel {
                    write!(f, "{channel} ")?;
                }
                f.write_str(&requirement.wrong.replace("{}", &value.map_or_else(String::new, rounded)))?;
                match surface_albedo {
                    Some(surface_albedo) => write!(f, " at surface albedo {}", rounded(*surface_albedo)),
                    None => Ok(()),
                }
            }
            Self::OutOfNumericRange { quantity, surface_albedo } => {
                let at = rounded(*surface_albedo);
                write!(f, "`{quantity}` is out of the range of numbers at surface albedo {at}")
            }
            Self::OfPart { part, error } => write!(f, "part {part} (from 0): {error}"),
        }
    }
}

impl std::error::Error for ModelError {}
