//! The medium of a diffusion theory, and what similarity makes of it.

use crate::{Entry, HalfSpace, HalfSpaceError};

/// A homogeneous medium below a flat surface, which light enters perpendicularly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Medium {
    single_scattering_albedo: f64,
    half_space: HalfSpace,
}

/// Why a [`Medium`] cannot be.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MediumError {
    /// α is outside [0, 1] or not a number.
    #[error("single-scattering albedo {0} is not in [0, 1]: give σs / (σs + σa)")]
    SingleScatteringAlbedo(f64),
    /// The anisotropy or the refractive index is out of range.
    #[error(transparent)]
    HalfSpace(#[from] HalfSpaceError),
}

impl Medium {
    /// A medium with Henyey-Greenstein scattering.
    ///
    /// `single_scattering_albedo` α = σs/σt in [0, 1]; `anisotropy` g in (-1, [`HalfSpace::MAXIMUM_ANISOTROPY`]], the
    /// mean cosine of the scattering angle; `refractive_index` relative to the outside, in
    /// [1, [`HalfSpace::MAXIMUM_REFRACTIVE_INDEX`]].
    ///
    /// # Errors
    ///
    /// A value out of its range, or NaN.
    pub fn new(
        single_scattering_albedo: f64,
        anisotropy: f64,
        refractive_index: f64,
    ) -> Result<Medium, MediumError> {
        if !(0.0..=1.0).contains(&single_scattering_albedo) {
            return Err(MediumError::SingleScatteringAlbedo(single_scattering_albedo));
        }
        let half_space = HalfSpace::new(Entry::Searchlight, anisotropy, refractive_index)?;
        // The sum turns -0.0, which the range admits, into 0.0.
        Ok(Medium { single_scattering_albedo: single_scattering_albedo + 0.0, half_space })
    }

    /// The index-matched, isotropically scattering medium of the papers.
    ///
    /// # Errors
    ///
    /// `single_scattering_albedo` outside [0, 1], or NaN.
    pub fn matched_isotropic(single_scattering_albedo: f64) -> Result<Medium, MediumError> {
        Medium::new(single_scattering_albedo, 0.0, 1.0)
    }

    /// α = σs/σt, in [0, 1].
    pub fn single_scattering_albedo(&self) -> f64 {
        self.single_scattering_albedo
    }

    /// g, the mean cosine of the scattering angle, in (-1, 0.999].
    pub fn anisotropy(&self) -> f64 {
        self.half_space.anisotropy()
    }

    /// η, the refractive index of the medium over that of the outside, at least 1.
    pub fn refractive_index(&self) -> f64 {
        self.half_space.refractive_index()
    }

    /// The same medium as a run of photons knows it.
    pub(super) fn half_space(&self) -> &HalfSpace {
        &self.half_space
    }

    /// σt′ = σa + (1 - g)σs per mean free path: 1 - gα. A diffusion theory's own unit of length is its reciprocal.
    pub(super) fn reduced_extinction(&self) -> f64 {
        1.0 - self.anisotropy() * self.single_scattering_albedo
    }

    /// α′ = σs′/σt′, in [0, 1].
    pub(super) fn reduced_albedo(&self) -> f64 {
        (1.0 - self.anisotropy()) * self.single_scattering_albedo / self.reduced_extinction()
    }

    /// σa/σt′ = 1 - α′, without the cancellation as α′ → 1.
    pub(super) fn reduced_absorption(&self) -> f64 {
        (1.0 - self.single_scattering_albedo) / self.reduced_extinction()
    }
}
