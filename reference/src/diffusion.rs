//! Diffusion theory, as the papers compare it.
//!
//! What each theory says of the light that leaves a [`Medium`] at a distance from where it perpendicularly entered:
//!
//! | Type | Source in the medium | Green's function | Exitance |
//! |---|---|---|---|
//! | [`ClassicalDipole`] | one point, one mean free path deep | classical | flux |
//! | [`BetterDipole`] | one point, one mean free path deep | Grosjean's | flux and fluence |
//! | [`BeamDiffusion`] | the whole refracted beam | Grosjean's | flux and fluence |
//! | [`Multipole`] | one point, in a slab | classical | flux |
//!
//! Grosjean's function leaves out the light that has not scattered since the source; the theories built on it need the
//! light that scattered once to be added, which [`WithSingleScattering`] does.
//!
//! **How good they are.** ∫ |error of 2πrR| dr over the surface albedo A, single scattering added, at A = 0.2, 0.5 and 0.8
//! against Monte Carlo; `tests/diffusion.rs` holds these numbers:
//!
//! | Refractive index | Classical dipole | Better dipole | Beam diffusion |
//! |---|---|---|---|
//! | 1 | 38, 28, 22 % | 19, 24, 22 % | 13, 14, 11 % |
//! | 1.4 | 47, 21, 14 % | 16, 13, 11 % | 5, 3, 3 % |
//!
//! **Units.** Lengths are in mean free paths 1/σt of the medium (of all scattering, not of the reduced one); a
//! reflectance is per unit area, mean free paths⁻². The energy that *entered* is 1: what the surface reflects before
//! any light enters is left out, what it reflects back inside is accounted for.
//!
//! **Radii.** A negative radius is read as 0, an infinite one gives the limit, NaN gives NaN.
//!
//! **Anisotropy.** Diffusion knows it by similarity alone: σs′ = (1 - g)σs. Single scattering is exact.
//!
//! - Jensen, Marschner, Levoy, Hanrahan 2001, "A Practical Model for Subsurface Light Transport".
//! - Donner, Jensen 2005, "Light Diffusion in Multi-Layered Translucent Materials".
//! - d'Eon, Irving 2011, "A Quantized-Diffusion Model for Rendering Translucent Materials".
//! - d'Eon 2012, "A Better Dipole".
//! - Habel, Christensen, Jarosz 2013, "Photon Beam Diffusion: A Hybrid Monte Carlo Method for Subsurface Scattering".
//!
//! ```
//! use subsurface_reference::diffusion::{BeamDiffusion, Medium, Reflectance, WithSingleScattering};
//!
//! let medium = Medium::matched_isotropic(0.9382)?; // surface albedo 0.5
//! let profile = WithSingleScattering::new(BeamDiffusion::new(medium), medium);
//! assert!(profile.reflectance(1.0) > profile.reflectance(2.0));
//! assert!((profile.total() - 0.5).abs() < 0.08); // what diffusion theory is worth here
//! # Ok::<(), subsurface_reference::diffusion::MediumError>(())
//! ```

mod beam;
mod boundary;
mod dipole;
mod medium;
mod multipole;
mod quadrature;
mod reflectance;
mod single_scattering;
mod source;

pub use beam::BeamDiffusion;
pub use dipole::{BetterDipole, ClassicalDipole};
pub use medium::{Medium, MediumError};
pub use multipole::{Multipole, ThicknessError};
pub use reflectance::{Reflectance, WithSingleScattering};
pub use single_scattering::SingleScattering;

use reflectance::legal_radius;
