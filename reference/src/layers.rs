//! Layered media in the sense of MCML: a pencil beam falls perpendicularly on a stack of layers, each with its own
//! refractive index, absorption, scattering and thickness.
//!
//! Lengths are centimetres and coefficients cm⁻¹, as in MCML (Wang, Jacques and Zheng 1995, "MCML — Monte Carlo
//! modeling of light transport in multi-layered tissues", *Computer Methods and Programs in Biomedicine* 47, 131–146;
//! below: \[WJZ95\]). Every fraction refers to the energy of the beam **before** it meets the surface, so specular
//! reflection is a part of the whole and not subtracted.
//!
//! [`parse_mci`] reads MCML's input, [`LayerRun::simulate`] traces the packets, [`LayerResult::to_mco`] writes what
//! MCML writes:
//!
//! ```
//! use std::ops::ControlFlow;
//! use subsurface_reference::layers::parse_mci;
//!
//! let runs = parse_mci(
//!     "1.0                     # file version
//!      1                       # number of runs
//!      slab.mco A              # output file, format
//!      2000                    # photons
//!      0.001 0.01              # dz dr [cm]
//!      20 50 1                 # nz nr na
//!      1                       # layers
//!      1.0                     # n above
//!      1.0 10 90 0.75 0.02     # n mua mus g d
//!      1.0                     # n below",
//! )?;
//! let result = runs[0].simulate(7, &mut |_| ControlFlow::Continue(()));
//! assert!((result.transmittance.mean - 0.66).abs() < 0.1);
//! assert!(result.to_mco().contains("Rd_r"));
//! # Ok::<(), subsurface_reference::layers::MciError>(())
//! ```
//!
//! # What is as in MCML, and what is not
//!
//! As in MCML: a packet loses weight μa/(μa + μs) where it scatters, plays roulette below a weight of 10⁻⁴ with a chance
//! of 1/10, and is reflected or refracted whole, by chance, at each interface; the last cell of every grid also holds
//! what falls beyond it; the densities of angles divide by 2π sin(α) dα at the middle of the cell.
//!
//! Different: absorption is counted per layer where it happens instead of being gathered from the depth grid, so a cell
//! may straddle an interface; *all* clear layers at the top belong to the specular reflection, not the first one only;
//! anisotropy may be negative; two-dimensional grids (`A_rz`, `Rd_ra`, `Tt_ra`) are not kept; every estimate has a
//! standard error.
//!
//! The same run and seed give the same bytes on any machine and any number of threads: weights are whole multiples of
//! 2⁻⁴⁸, so sums do not depend on their order, and no function of the platform's libm is called.

mod endless;
mod grid;
mod interface;
mod layer;
mod layer_error;
mod mci;
mod mci_error;
mod mco;
mod number;
mod result;
mod run;
mod simulation;
mod tally;
mod walk;

pub use grid::Grid;
pub use layer::{Layer, LayerStack};
pub use layer_error::LayerError;
pub use mci::parse_mci;
pub use mci_error::{MciError, MciProblem};
pub use result::LayerResult;
pub use run::{LayerRun, OutputFormat};
pub use simulation::LayerProgress;
