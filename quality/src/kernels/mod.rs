//! The kernels themselves, as in `shaders/kernels`.

pub(crate) mod importance_sampled;
pub(crate) mod interleaved;
pub(crate) mod separable;
pub(crate) mod twin;
