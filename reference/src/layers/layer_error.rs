//! What a layered run cannot be.

use thiserror::Error;

/// A value that no layered run can have, and what to write instead.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum LayerError {
    /// Refractive index outside [0.01, 100].
    #[error(
        "refractive index {value}: expected a number from 0.01 to 100, such as 1.0 for air or 1.37 for tissue"
    )]
    RefractiveIndex {
        /// What was given.
        value: f64,
    },
    /// Absorption coefficient outside [0, 10¹²] cm⁻¹.
    #[error(
        "absorption coefficient {value}: expected 0 to 1e12 per cm; write 0 for a layer that does not absorb"
    )]
    AbsorptionCoefficient {
        /// What was given, cm⁻¹.
        value: f64,
    },
    /// Scattering coefficient outside [0, 10¹²] cm⁻¹.
    #[error(
        "scattering coefficient {value}: expected 0 to 1e12 per cm; write 0 for a layer that does not scatter"
    )]
    ScatteringCoefficient {
        /// What was given, cm⁻¹.
        value: f64,
    },
    /// Anisotropy outside [−1, 1].
    #[error("anisotropy {value}: expected a mean cosine from -1 to 1; write 0 for isotropic scattering")]
    Anisotropy {
        /// What was given.
        value: f64,
    },
    /// Thickness not in (0, 10¹²] cm.
    #[error(
        "thickness {value}: expected more than 0 and at most 1e12 cm; write 1e8 for a semi-infinite layer, and leave \
         out a layer that has no thickness"
    )]
    Thickness {
        /// What was given, cm.
        value: f64,
    },
    /// A name that would not survive in a file of lines and words.
    #[error("output name {name:?}: expected a file name without spaces, control characters and `#`")]
    OutputName {
        /// What was given.
        name: String,
    },
    /// A stack without layers, or with more than 32 767.
    #[error("{count} layers: expected 1 to 32767")]
    LayerCount {
        /// How many were given.
        count: usize,
    },
    /// A layer in which packets would wander practically for ever.
    #[error(
        "layer {layer} scatters a packet about {scatterings:.1e} times before it leaves or is absorbed (the limit is \
         1e4); give the layer a smaller thickness, a larger absorption coefficient or an index nearer to that outside"
    )]
    Endless {
        /// Which layer, from 1.
        layer: usize,
        /// Estimate of the mean number of scattering events in it.
        scatterings: f64,
    },
    /// A cell size that is not positive, or so small or large that indices lose their meaning.
    #[error("cell size {axis} = {value}: expected 1e-12 to 1e12 cm")]
    CellSize {
        /// `dz` or `dr`.
        axis: &'static str,
        /// What was given, cm.
        value: f64,
    },
    /// A number of cells that is zero or above what MCML can hold.
    #[error("{axis} = {value} cells: expected 1 to 32767; write 1 for a direction that need not be resolved")]
    CellCount {
        /// `nz`, `nr` or `na`.
        axis: &'static str,
        /// What was given.
        value: u64,
    },
    /// A run of no photons.
    #[error("0 photons: expected at least 1; 1000000 give three digits of most totals")]
    NoPhotons,
}
