//! Which shaders diffuse.

use subsurface_runtime::{ComputeShape, Path, SubsurfacePass};

use crate::failure::Failure;

/// Which shaders diffuse, where the caller has a choice; by default what suits the device.
#[derive(Clone, Copy, Debug, Default)]
pub struct Route {
    /// Compute or fragment shaders.
    pub path: Option<Path>,
    /// How compute shaders share their work, of a kernel that has two ways.
    pub shape: Option<ComputeShape>,
}

impl Route {
    /// Refuses a shape that `pass` has no choice of.
    pub(crate) fn check(self, pass: &SubsurfacePass) -> Result<(), Failure> {
        if self.shape.is_none() || pass.shape().is_some() {
            return Ok(());
        }
        let problem = match pass.path() {
            Path::Fragment => "--shape: fragment shaders share their work in one way",
            Path::Compute => "--shape: this kernel shares its work in one way on every device",
        };
        Err(Failure::new(problem, "leave out --shape, or take --path compute and a kernel `interleaved`"))
    }
}
