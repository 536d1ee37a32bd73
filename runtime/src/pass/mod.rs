//! The four passes.

pub mod composite;
pub mod gbuffer;
pub mod shadow;
pub mod subsurface;
