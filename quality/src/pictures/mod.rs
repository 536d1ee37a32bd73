//! Pictures whose diffusion is known exactly.

pub(crate) mod case;
pub(crate) mod patch;
pub(crate) mod reference;
pub(crate) mod scene;
pub(crate) mod stage;
