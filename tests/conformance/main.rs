//! The numbers that the papers print, recomputed and set beside what is true.
//!
//! \[L23\] Liang et al. 2023 and \[CB15\] Christensen and Burley 2015, see `subsurface_profile`. Truth is the stored
//! tables of `subsurface_reference::truth` and Chandrasekhar's exact totals. Every test prints a table
//! `what | printed | measured | verdict`; see them with
//!
//! ```text
//! cargo test --test conformance -- --nocapture --test-threads 1
//! ```
//!
//! A number that cannot be reproduced is printed with both values and the reason, and the measured one is held in
//! place: nothing here is bent to a misprint. A change of a model, of the truth or of a measure shows as a failure.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

mod cb15;
mod cb15_figure_6;
mod comparison;
mod default_profile;
mod distance;
mod half_space;
mod j01;
mod l23;
mod l23_refit;
mod l23_sampler;
mod l23_table_1;
mod minimum;
mod rational;
mod slab;
mod stored;
