//! The medium of a half-space run: how light enters, how it scatters, how its boundary reflects.

/// How light enters the medium.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Entry {
    /// A pencil of light that meets the surface perpendicularly at one point.
    Searchlight,
    /// Light that meets one point of the surface from all directions with the same radiance: the cosine of its angle
    /// with the normal, outside, has the density 2μ.
    Diffuse,
}

/// A homogeneous medium that fills everything below a flat surface. Its mean free path is the unit of length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace {
    entry: Entry,
    anisotropy: f64,
    refractive_index: f64,
}

/// Why a [`HalfSpace`] cannot be.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum HalfSpaceError {
    /// g is outside (-1, 0.999] or not a number.
    #[error(
        "anisotropy {0} is not in (-1, 0.999]: give the mean cosine of the scattering angle, 0 for isotropic"
    )]
    Anisotropy(f64),
    /// The relative refractive index is below 1, above 4, or not a number.
    #[error(
        "refractive index {0} is not in [1, 4]: give that of the medium over that of the outside, 1 if matched"
    )]
    RefractiveIndex(f64),
}

impl HalfSpace {
    /// The largest mean cosine of the scattering angle taken. Walks get longer as 1/(1 - g)², which at 0.999 is half a minute
    /// for 65536 photons.
    pub const MAXIMUM_ANISOTROPY: f64 = 0.999;
    /// The largest relative refractive index taken. Germanium has 4.0; no translucent material has more.
    pub const MAXIMUM_REFRACTIVE_INDEX: f64 = 4.0;

    /// A medium with Henyey-Greenstein scattering of mean cosine `anisotropy`, and of `refractive_index` relative to
    /// the outside (1 = matched).
    ///
    /// # Errors
    ///
    /// `anisotropy` outside (-1, 0.999], `refractive_index` outside [1, 4], or NaN.
    pub fn new(entry: Entry, anisotropy: f64, refractive_index: f64) -> Result<HalfSpace, HalfSpaceError> {
        if !(anisotropy > -1.0 && anisotropy <= Self::MAXIMUM_ANISOTROPY) {
            return Err(HalfSpaceError::Anisotropy(anisotropy));
        }
        if !(1.0..=Self::MAXIMUM_REFRACTIVE_INDEX).contains(&refractive_index) {
            return Err(HalfSpaceError::RefractiveIndex(refractive_index));
        }
        // -0.0 and 0.0 are one medium, and must be one medium in a file too.
        Ok(HalfSpace { entry, anisotropy: anisotropy + 0.0, refractive_index })
    }

    /// The index-matched, isotropically scattering medium of the papers.
    pub fn matched_isotropic(entry: Entry) -> HalfSpace {
        HalfSpace { entry, anisotropy: 0.0, refractive_index: 1.0 }
    }

    /// How light enters.
    pub fn entry(&self) -> Entry {
        self.entry
    }

    /// Mean cosine of the scattering angle, in (-1, 0.999].
    pub fn anisotropy(&self) -> f64 {
        self.anisotropy
    }

    /// Refractive index of the medium over that of the outside, at least 1.
    pub fn refractive_index(&self) -> f64 {
        self.refractive_index
    }

    /// No reflection at the surface.
    pub fn is_matched(&self) -> bool {
        self.refractive_index == 1.0
    }
}
