//! Ground truth of subsurface scattering.
//!
//! The central type is [`Run`]: photons that walked at random through a [`HalfSpace`], counted by where they left and
//! after how many scatterings. Paths do not depend on the single-scattering albedo α, so one run serves all of them:
//! R_α = Σ αⁿ Hₙ.
//!
//! ```
//! use std::ops::ControlFlow;
//! use subsurface_reference::{Entry, Goal, HalfSpace, Run, chandrasekhar};
//!
//! let mut run = Run::new(HalfSpace::new(Entry::Searchlight, 0.0, 1.0)?, 7);
//! run.simulate(&Goal::photons(100_000)?, &mut |_| ControlFlow::Continue(()));
//!
//! let simulated = run.surface_albedo(0.9)?;
//! let exact = chandrasekhar::surface_albedo(Entry::Searchlight, 0.9)?;
//! assert!((simulated.mean - exact).abs() < 4.0 * simulated.standard_error);
//!
//! let profile = run.radial_profile(0.9)?;
//! assert!(profile.bins[0].r_reflectance > profile.bins[40].r_reflectance);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Rules
//!
//! - Lengths are in mean free paths of the half-space; [`layers`] have MCML's centimetres.
//! - R(r) is per unit area and per energy that *entered*: with a refractive mismatch, what the surface reflects before
//!   any light enters is left out. Tables hold the mean of r·R(r) over a ring.
//! - *Surface albedo* A = ∫ R(r) 2πr dr is what the surface reflects of it in all; *single-scattering albedo* α = σs/σt
//!   belongs to the medium.
//! - A run is a set of photons. The same photons are the same bytes, on any number of threads and on any machine, however
//!   often the simulation broke off or was [merged](Run::merge) from others.
//! - A stated error is one standard deviation. What is not random is exact to more digits than are printed, but for the
//!   light that scatters more than 10⁴/(1 - g) times: diffusion theory takes over there, and is off by 10⁻³ of these 1 %
//!   of the photons.
//! - The light of one table is the light of one run: errors at different albedos belong together, and so do those of rings
//!   beyond [`RadialTable::INDEPENDENT_UP_TO`].
//!
//! # What this crate does not know
//!
//! Profile models (it judges them, and shares no formula with them), materials, files (it turns runs and tables into
//! bytes and text, and back), progress bars, clocks.

mod batch_set;
pub mod chandrasekhar;
pub mod diffusion;
mod elementary;
mod estimate;
mod fresnel;
mod gauss_legendre;
mod half_space;
mod histogram;
pub mod layers;
mod progress;
mod radial_grid;
mod radial_table;
mod random;
mod root;
mod run;
mod run_format;
mod scattering_count;
pub mod single_scattering;
pub mod truth;
mod truth_table;
mod walk;

pub use estimate::{Estimate, EstimateError};
pub use half_space::{Entry, HalfSpace, HalfSpaceError};
pub use progress::{Goal, GoalError, Outcome, Progress};
pub use radial_grid::RING_EDGES;
pub use radial_table::{ChiSquared, RadialBin, RadialTable};
pub use run::{MergeError, Run};
pub use run_format::RunFormatError;
pub use truth_table::{TruthTable, TruthTableError};
