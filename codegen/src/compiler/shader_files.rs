//! The shaders that kernels are linked from.

use subsurface_shaders::{GATHER, KERNELS, LIBRARY, LIGHT, Module, PASSES, PROFILES};

/// The files of all rooms.
#[derive(Clone, Debug)]
pub(super) struct ShaderFiles {
    /// What any kernel may use.
    pub(super) rooms: Vec<Module>,
    /// Profile models: a kernel takes those of its set.
    pub(super) profiles: Vec<Module>,
    /// Bindings and entry points: a kernel takes those of its estimator.
    pub(super) passes: Vec<Module>,
}

impl Default for ShaderFiles {
    fn default() -> Self {
        Self {
            rooms: [LIBRARY, GATHER, KERNELS, LIGHT].concat(),
            profiles: PROFILES.to_vec(),
            passes: PASSES.to_vec(),
        }
    }
}
