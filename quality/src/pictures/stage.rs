//! A material at a footprint, with the kernel that was drawn there last.

use std::cell::RefCell;

use subsurface_kernel::Estimator;

use crate::gather::gathered::Rgb;
use crate::gather::point::Point;
use crate::kernels::twin::Twin;
use crate::pictures::patch::Patch;
use crate::pictures::scene::Scene;

/// A material at a footprint. Its pictures share the kernel's taps.
#[derive(Debug)]
pub(crate) struct Stage<'a> {
    pub(crate) point: Point<'a>,
    last: RefCell<Option<(Estimator, Twin<'a>)>>,
}

impl<'a> Stage<'a> {
    pub(crate) fn new(point: Point<'a>) -> Self {
        Self { point, last: RefCell::new(None) }
    }

    /// The pixels of a scene, patch by patch; `None` for `Dense`, which has no twin.
    pub(crate) fn draw(&self, kernel: Estimator, scene: Scene, patches: &[Patch]) -> Option<Vec<Rgb>> {
        let known = self.last.take().filter(|(known, _)| *known == kernel);
        let twin = match known {
            Some((_, twin)) => twin,
            None => Twin::new(kernel, self.point)?,
        };
        let pixels = patches.iter().flat_map(|patch| twin.draw(scene, *patch)).collect();
        self.last.replace(Some((kernel, twin)));
        Some(pixels)
    }
}
