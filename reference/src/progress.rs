//! What a simulation is asked for, and what it tells on the way.

/// When a simulation may stop: at a number of photons, or at a standard error if that comes first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Goal {
    photons: u64,
    relative_standard_error: Option<f64>,
}

/// Why a [`Goal`] cannot be.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GoalError {
    /// Zero photons.
    #[error("zero photons say nothing: ask for at least one (they come in batches of 65536)")]
    NoPhotons,
    /// Not positive, or not a number.
    #[error("relative standard error {0} is not positive: 0.001 stops at one part in a thousand")]
    StandardError(f64),
}

impl Goal {
    /// The single-scattering albedo for which [`Progress::relative_standard_error`] is stated.
    pub const SINGLE_SCATTERING_ALBEDO: f64 = 0.9;
    /// A ring counts for [`Progress::relative_standard_error`] if it holds at least this fraction of the reflected energy.
    pub const POPULATED: f64 = 1e-3;

    /// A run that holds at least `photons` in all, those it has already included.
    ///
    /// # Errors
    ///
    /// Zero photons.
    pub fn photons(photons: u64) -> Result<Goal, GoalError> {
        if photons == 0 {
            return Err(GoalError::NoPhotons);
        }
        Ok(Goal { photons, relative_standard_error: None })
    }

    /// The same, or earlier: as soon as [`Progress::relative_standard_error`] is at most `error`. Looked at each time the
    /// run holds a multiple of 2²² photons, so that the stop does not depend on the threads.
    ///
    /// # Errors
    ///
    /// `error` is not positive.
    pub fn or_relative_standard_error(self, error: f64) -> Result<Goal, GoalError> {
        if error.is_nan() || error <= 0.0 {
            return Err(GoalError::StandardError(error));
        }
        Ok(Goal { relative_standard_error: Some(error), ..self })
    }

    pub(crate) fn photon_count(&self) -> u64 {
        self.photons
    }

    pub(crate) fn standard_error(&self) -> Option<f64> {
        self.relative_standard_error
    }
}

/// Where a simulation is. Rates are for the caller, who has a clock.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Progress {
    /// Photons in the run, those of earlier simulations included.
    pub photons: u64,
    /// Photons that the goal asks for.
    pub photons_goal: u64,
    /// Scatterings in the run.
    pub events: u64,
    /// The largest standard error of r·R over its mean, over the rings that hold at least [`Goal::POPULATED`] of the
    /// energy reflected at [`Goal::SINGLE_SCATTERING_ALBEDO`].
    pub relative_standard_error: f64,
}

/// Why a simulation stopped. Nothing is lost in any case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Outcome {
    /// The run holds the photons asked for.
    Photons,
    /// The standard error is small enough.
    StandardError,
    /// The caller's function broke off. The run can go on later.
    Interrupted,
}
