//! What every profile model answers.

use std::fmt::Debug;

/// Largest u that [`RadialProfile::sample_radius`] tells apart from 1: 1 - 2⁻⁵³, the `f64` just below 1.
pub(crate) const MAXIMUM_U: f64 = 1.0 - f64::EPSILON / 2.0;

/// A normalised radial diffusion profile: where the energy that entered at one point leaves.
///
/// The energy that leaves within a radius r of the point of entry is A·`radial_cdf(r)`; the four functions
/// below are that one statement in four forms:
///
/// - `radial_cdf(r)` = ∫₀ʳ `radial_pdf`,
/// - `radial_pdf(r)` = 2πr·`area_pdf(r)`,
/// - `sample_radius(radial_cdf(r))` = r.
///
/// # Radii that are no radii
///
/// A negative radius is read as 0, so callers may pass the result of a subtraction that rounds below it.
/// An infinite radius is legal and gives the limit. NaN gives NaN.
pub trait RadialProfile: Debug + Send + Sync {
    /// Surface albedo A = ∫ R(r) 2πr dr of the medium, in [0, 1].
    ///
    /// It scales no density: those are normalised to 1 even at A = 0, where they are the limit A → 0.
    fn surface_albedo(&self) -> f64;

    /// Normalised profile R(r)/A per unit area, mm⁻². May be infinite at r = 0, nowhere else.
    fn area_pdf(&self, radius_mm: f64) -> f64;

    /// Density of the exit radius, 2πr·R(r)/A per unit length, mm⁻¹. Finite everywhere, r = 0 included.
    fn radial_pdf(&self, radius_mm: f64) -> f64;

    /// Fraction of the reflected energy that leaves within `radius_mm`, in [0, 1].
    ///
    /// Keeps its relative accuracy as r → 0.
    fn radial_cdf(&self, radius_mm: f64) -> f64;

    /// Fraction of the reflected energy that leaves beyond `radius_mm`: 1 - `radial_cdf`, in [0, 1].
    ///
    /// Models that can, keep its relative accuracy as r → ∞, where the difference has none.
    fn radial_tail(&self, radius_mm: f64) -> f64 {
        1.0 - self.radial_cdf(radius_mm)
    }

    /// The radius in mm within which the fraction `u` of the energy leaves: the true inverse of `radial_cdf`.
    ///
    /// `u` is clamped to [0, 1 - 2⁻⁵³], so the result is finite also where the profile has no end. u = 0
    /// gives 0, NaN gives NaN.
    fn sample_radius(&self, u: f64) -> f64;

    /// The radius in mm that a filter must reach to gather the fraction `quantile` of the energy.
    ///
    /// Equal to [`sample_radius`](Self::sample_radius); the name tells the intention.
    fn filter_radius(&self, quantile: f64) -> f64 {
        self.sample_radius(quantile)
    }

    /// What Jimenez et al. 2010 and those after them take for the light that comes through `thickness_mm`:
    /// A·(1 - `radial_cdf`).
    ///
    /// A point at depth t below a uniformly lit plane receives ∫ R(√(r² + t²)) 2πr dr. With ρ² = r² + t²,
    /// r dr = ρ dρ, this is ∫ R(ρ) 2πρ dρ over ρ > t: the tail of the profile, for any model. It is the light of a
    /// half-space at that distance; a slab lets two to seven times more through where it is some mean free paths
    /// thick, see [`Slab`](crate::Slab).
    fn transmittance(&self, thickness_mm: f64) -> f64 {
        self.surface_albedo() * self.radial_tail(thickness_mm)
    }

    /// The radius in mm beyond which the profile is exactly 0, where the model has one.
    fn max_radius(&self) -> Option<f64> {
        None
    }
}

/// A radius as the profiles read it: negative means 0, infinite means the largest finite radius (so that no
/// `0·∞` arises from a vanishing density), NaN stays NaN.
pub(crate) fn legal_radius(radius: f64) -> f64 {
    // The sum turns -0.0 into 0.0, whose reciprocal is the right infinity.
    radius.clamp(0.0, f64::MAX) + 0.0
}

/// A uniform number as the samplers read it: clamped to [0, 1 - 2⁻⁵³], NaN stays NaN.
pub(crate) fn legal_u(u: f64) -> f64 {
    u.clamp(0.0, MAXIMUM_U) + 0.0
}
