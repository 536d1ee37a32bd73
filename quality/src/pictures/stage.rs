//! A material at a footprint, with the kernel that was drawn there last.

use std::cell::RefCell;

use subsurface_kernel::Estimator;

use crate::gather::gathered::Rgb;
use crate::gather::point::Point;
use crate::kernels::twin::Twin;
use crate::pictures::patch::Patch;
use crate::pictures::scene::{Scene, Surface};

/// A material at a footprint. Its pictures share the kernel's taps.
#[derive(Debug)]
pub(crate) struct Stage<'a> {
    pub(crate) point: Point<'a>,
    /// The kernel, on the material's own surface, then on its others.
    last: RefCell<Option<(Estimator, Vec<Twin<'a>>)>>,
}

impl<'a> Stage<'a> {
    pub(crate) fn new(point: Point<'a>) -> Self {
        Self { point, last: RefCell::new(None) }
    }

    /// The pixels of a scene, patch by patch; `None` for `Dense`, which has no twin.
    pub(crate) fn draw(&self, kernel: Estimator, scene: Scene, patches: &[Patch]) -> Option<Vec<Rgb>> {
        let known = self.last.take().filter(|(known, _)| *known == kernel);
        let mut twins = match known {
            Some((_, twins)) => twins,
            None => vec![Twin::new(kernel, self.point)?],
        };
        if scene == Scene::AlbedoEdge && twins.len() == 1 {
            for surface in Surface::OTHERS {
                twins.push(Twin::new(kernel, self.point.on(surface))?);
            }
        }
        let (own, others) = twins.split_first()?;
        let pixels = patches.iter().flat_map(|patch| own.draw(others, scene, *patch)).collect();
        self.last.replace(Some((kernel, twins)));
        Some(pixels)
    }
}
