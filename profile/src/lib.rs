//! Radial diffusion profiles of subsurface scattering, in `f64`.
//!
//! The central type is [`RadialProfile`]: how the energy that entered a flat, semi-infinite, index-matched
//! medium at one point leaves it again around that point. A [`Model`] is a family of profiles given by its
//! coefficients; [`Model::profile`] picks the member that belongs to a [`Medium`] and a colour [`Channel`].
//!
//! ```
//! use subsurface_profile::{Channel, Medium, Model};
//!
//! let model = Model::published("two_exponential_dipole_searchlight").ok_or("no such model")?;
//! let skin = Medium::new(0.83, 1.30)?; // surface albedo, mean free path in mm
//! let profile = model.profile(skin, Channel::Red)?;
//!
//! let radius_mm = profile.sample_radius(0.5); // half of the energy leaves within this radius
//! assert!((profile.radial_cdf(radius_mm) - 0.5).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Rules
//!
//! - Lengths are in millimetres, areas in mm².
//! - Three measures of one profile are easily mixed up, so every name says which it is: R(r)/A per area
//!   ([`area_pdf`](RadialProfile::area_pdf)), 2πr·R(r)/A per radius ([`radial_pdf`](RadialProfile::radial_pdf)),
//!   and its integral ([`radial_cdf`](RadialProfile::radial_cdf)).
//! - *Surface albedo* A = ∫ R(r) 2πr dr is what the surface reflects in all; *single-scattering albedo*
//!   α = σs/σt belongs to the medium. [`single_scattering_albedo`] converts.
//! - Every [`sample_radius`](RadialProfile::sample_radius) is the true inverse of the model's own
//!   [`radial_cdf`](RadialProfile::radial_cdf), never a fit to it.
//! - Published coefficients are named constants and exist once, beside the model they belong to.
//!
//! # What this crate does not know
//!
//! Files, file formats, the GPU and shader text.
//!
//! # Sources
//!
//! - \[L23\] Liang, Gao, Cong, Hao 2023, "Subsurface Scattering Computation with Accurate Reflectance Profile
//!   Fitting", Journal of Software 34(8).
//! - \[CB15\] Christensen, Burley 2015, "Approximate Reflectance Profiles for Efficient Subsurface Scattering",
//!   Pixar Technical Memo 15-04.
//! - \[J01\] Jensen, Marschner, Levoy, Hanrahan 2001, "A Practical Model for Subsurface Light Transport",
//!   SIGGRAPH.
//! - \[GG3\] d'Eon, Luebke 2007, "Advanced Techniques for Realistic Real-Time Skin Rendering", GPU Gems 3, ch. 14.

mod burley;
mod channel;
pub mod description;
mod deviation;
mod dipole;
mod dipole_source;
mod edge_spread;
mod exponential_dipole;
mod exponential_source_sum;
#[cfg(feature = "fit")]
pub mod fit;
mod gaussian_sum;
mod half_space;
mod inverse;
mod length;
mod medium;
mod mixture;
mod model;
mod model_error;
mod polynomial;
pub mod quadrature;
mod quantity;
mod radial_data;
mod radial_profile;
mod shared_constant;
pub mod single_scattering_albedo;
mod slab;
mod tabulated;
mod two_exponential_dipole;

pub use burley::{BurleyModel, BurleyProfile, BurleyShape};
pub use channel::Channel;
pub use deviation::{Deviation, SquaredError, l1, mean_relative_error};
pub use dipole::{DipoleModel, DipoleProfile};
pub use edge_spread::EdgeSpread;
pub use exponential_dipole::{ExponentialDipoleModel, ExponentialDipoleProfile};
pub use exponential_source_sum::ExponentialSourceSum;
pub use gaussian_sum::{GaussianSumModel, GaussianSumProfile, GaussianTerm};
pub use half_space::HalfSpace;
pub use length::Length;
pub use medium::{Medium, MediumError};
pub use mixture::{MixtureModel, MixturePart, MixtureProfile};
pub use model::{FunctionOfAlbedo, Model, ModelKind, PublishedSet};
pub use model_error::{ModelError, Requirement};
pub use polynomial::{PolynomialA, PolynomialB, PolynomialC, PolynomialModel, PolynomialProfile};
pub use quantity::{Bounds, Quantity, rounded};
pub use radial_data::{RadialData, RadialDataError, RadialRow};
pub use radial_profile::RadialProfile;
pub use shared_constant::{SHARED_CONSTANTS, SharedConstant};
pub use slab::Slab;
pub use tabulated::{TabulatedError, TabulatedKnot, TabulatedModel, TabulatedProfile};
pub use two_exponential_dipole::{TwoExponentialDipoleModel, TwoExponentialDipoleProfile};
