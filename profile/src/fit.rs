//! Fits of a model's coefficients to tabulated data.
//!
//! ```
//! use subsurface_profile::fit::{Family, Options, fit};
//! use subsurface_profile::{RadialData, RadialRow};
//!
//! // Mean r·R of four bins, radii in mean free paths.
//! let rows = vec![
//!     RadialRow::bin(0.0, 0.5, 0.05),
//!     RadialRow::bin(0.5, 1.0, 0.03),
//!     RadialRow::bin(1.0, 2.0, 0.015),
//!     RadialRow::bin(2.0, 4.0, 0.004),
//! ];
//! let data = [RadialData::new(0.4, rows)?];
//! let burley = Family::from_name("burley").ok_or("no such family")?;
//! let fitted = fit(&burley.start(&data), &data, &Options::default())?;
//! assert!(fitted.stop.converged());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Which coefficients are free
//!
//! The coefficients of most models make functions of the surface albedo A. Data of n surface albedos tell n of
//! their terms apart, so that the first n are free and the others keep the values of the start. With data of one
//! surface albedo each function is made a constant, but for a factor 1 - A or α that it may have: the result is
//! right at that one. A Gaussian sum does not depend on A at all; its variances come out in mean free paths squared,
//! to be read as mm² at a mean free path of 1 mm.

mod coefficient;
mod criterion;
mod crop;
mod family;
mod problem;

use thiserror::Error;

use crate::deviation::l1;
use crate::{Channel, Medium, MediumError, Model, ModelError, RadialData, RadialProfile};

pub use coefficient::Parameter;
pub use criterion::{Criterion, Measure, Weighting};
pub use crop::Crop;
pub use family::Family;

/// How to fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// What is to be small.
    pub criterion: Criterion,
    /// How much each row counts.
    pub weighting: Weighting,
    /// Which rows are left out, if any.
    pub crop: Option<Crop>,
    /// How often the model may be evaluated, per free coefficient.
    pub patience: usize,
}

impl Default for Options {
    /// Least squares of 2πr·R/A over r, of all rows.
    fn default() -> Self {
        Options {
            criterion: Criterion::LeastSquares(Measure::RadialDensity),
            weighting: Weighting::Radius,
            crop: None,
            patience: 200,
        }
    }
}

/// The result of a fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The fitted model. Never worse than the start in the chosen criterion.
    pub model: Model,
    /// Half the sum of the squared residuals at the start, in the chosen criterion.
    pub cost_at_start: f64,
    /// The same of the fitted model.
    pub cost: f64,
    /// How often the residuals were evaluated, those for derivatives not counted.
    pub evaluations: usize,
    /// Why the fit ended.
    pub stop: Stop,
    /// Names of the coefficients that were free.
    pub free: Vec<String>,
    /// How well the model fits each of the data, in their order.
    pub tables: Vec<FittedTable>,
}

/// How well a fit describes the data of one surface albedo.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FittedTable {
    /// Surface albedo A.
    pub surface_albedo: f64,
    /// ∫ |p - t| dr of 2πr·R/A over the whole table, cropped or not.
    pub l1: f64,
    /// Rows that took part in the fit.
    pub rows: usize,
    /// The radius beyond which the rows were cropped, where a [`Crop`] was asked for; mean free paths.
    pub cropped_at: Option<f64>,
}

/// Why a fit ended.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Stop {
    /// No step in any direction makes the cost smaller, to the accuracy of the numbers.
    Converged,
    /// The cost falls towards coefficients that describe no profile; `coefficient` cannot go on.
    Bound {
        /// Name of the coefficient.
        coefficient: String,
    },
    /// The evaluations allowed were used up before the cost stopped falling.
    Patience,
    /// The residuals have no derivative there, or one that is out of the range of numbers.
    NoDerivative,
}

impl Stop {
    /// Whether the result is a minimum.
    pub fn converged(&self) -> bool {
        matches!(self, Stop::Converged)
    }
}

impl std::fmt::Display for Stop {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Stop::Converged => f.write_str("converged"),
            Stop::Bound { coefficient } => write!(f, "not converged: `{coefficient}` is at its bound"),
            Stop::Patience => f.write_str("not converged: the evaluations allowed are used up"),
            Stop::NoDerivative => f.write_str("not converged: the residuals have no derivative here"),
        }
    }
}

/// Why there is no fit.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum FitError {
    /// No data.
    #[error("there are no data to fit to: give a table of at least one surface albedo")]
    NoData,
    /// The model has no coefficients.
    #[error("a tabulated profile has no coefficients to fit: choose another family")]
    NoCoefficients,
    /// The start describes no profile at a surface albedo of the data.
    #[error("the start has no profile at surface albedo {surface_albedo}: {reason}; start elsewhere")]
    NoProfile {
        /// Surface albedo of the data.
        surface_albedo: f64,
        /// What is wrong there.
        reason: ModelError,
    },
    /// Fewer rows than free coefficients.
    #[error(
        "{rows} rows cannot determine {coefficients} coefficients: give more rows, crop less or choose a \
         model with fewer"
    )]
    TooFewRows {
        /// Rows that take part.
        rows: usize,
        /// Free coefficients.
        coefficients: usize,
    },
    /// Weights by standard error were asked for, and a row has none above 0.
    #[error(
        "surface albedo {surface_albedo}: row {row} (from 0) has no standard error above 0; weight by radius \
         or by row instead"
    )]
    NoStandardError {
        /// Surface albedo of the data.
        surface_albedo: f64,
        /// The row, from 0.
        row: usize,
    },
    /// The criterion cannot be computed at the start.
    #[error("the criterion is out of the range of numbers at the start: start elsewhere or scale the data")]
    OutOfNumericRange,
    /// ε of the cropping rule.
    #[error("the cropping threshold {threshold} is outside (0, 1): the paper has 0.005")]
    CropOutOfRange {
        /// The value given.
        threshold: f64,
    },
    /// No evaluation allowed.
    #[error("a fit needs a patience of at least 1 evaluation per coefficient")]
    NoPatience,
    /// A medium that the data describe does not exist.
    #[error(transparent)]
    Medium(#[from] MediumError),
}

/// Fits the coefficients of `start` to `data`, by the Levenberg–Marquardt method.
///
/// The same arguments give the same result. See the module for which coefficients are free.
///
/// # Errors
/// Data that cannot determine the coefficients, or a start that has no profile there. That the method does not
/// converge is no error: [`Fit::stop`] says so.
pub fn fit(start: &Model, data: &[RadialData], options: &Options) -> Result<Fit, FitError> {
    let Options { criterion, weighting, crop, patience } = *options;
    if data.is_empty() {
        return Err(FitError::NoData);
    }
    if patience == 0 {
        return Err(FitError::NoPatience);
    }
    let mut tables = Vec::with_capacity(data.len());
    for data in data {
        tables.push(criterion::Target::new(data, criterion, weighting, crop)?);
    }
    let mut start = start.clone();
    let free = coefficient::free(&mut start, data)?;
    for data in data {
        profile_of(&start, data)?
            .map_err(|reason| FitError::NoProfile { surface_albedo: data.surface_albedo(), reason })?;
    }
    let rows = tables.iter().map(|table| table.rows()).sum();
    if rows < free.len() {
        return Err(FitError::TooFewRows { rows, coefficients: free.len() });
    }
    let solution = problem::solve(start, free, &tables, patience)?;
    let mut fitted = Vec::with_capacity(data.len());
    for table in &tables {
        // Every model that the solver returns has had its residuals computed, so there is a profile.
        let reason = |reason| FitError::NoProfile { surface_albedo: table.data.surface_albedo(), reason };
        let profile = profile_of(&solution.model, table.data)?.map_err(reason)?;
        fitted.push(FittedTable {
            surface_albedo: table.data.surface_albedo(),
            l1: l1(&*profile, table.data),
            rows: table.rows(),
            cropped_at: table.cropped_at,
        });
    }
    Ok(Fit {
        model: solution.model,
        cost_at_start: solution.cost_at_start,
        cost: solution.cost,
        evaluations: solution.evaluations,
        stop: solution.stop,
        free: solution.free,
        tables: fitted,
    })
}

/// The profile that `model` has for the medium of `data`, at mean free path 1 mm.
fn profile_of(
    model: &Model,
    data: &RadialData,
) -> Result<Result<Box<dyn RadialProfile>, ModelError>, MediumError> {
    let medium = Medium::new(data.surface_albedo(), 1.0)?;
    Ok(model.profile(medium, Channel::Red))
}
