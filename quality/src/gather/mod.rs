//! What all kernels share, as in `shaders/gather`.

pub mod curve;
mod footprint;
pub(crate) mod gathered;
pub(crate) mod point;
pub(crate) mod tap;
