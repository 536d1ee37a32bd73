//! A kernel at a footprint, whichever it is.

use std::collections::HashMap;

use subsurface_kernel::Estimator;
use subsurface_kernel::constants::EVEN_WINDOW_TAPS;

use crate::gather::gathered::Rgb;
use crate::gather::point::Point;
use crate::kernels::importance_sampled::ImportanceSampled;
use crate::kernels::interleaved::Interleaved;
use crate::kernels::interleaved::far::far_taps;
use crate::kernels::separable::Separable;
use crate::pictures::patch::Patch;
use crate::pictures::scene::Scene;

/// A kernel as the processor runs it.
#[derive(Debug)]
pub(crate) enum Twin<'a> {
    ImportanceSampled(ImportanceSampled<'a>),
    Separable(Separable<'a>),
    Interleaved(Interleaved<'a>),
}

impl<'a> Twin<'a> {
    /// The twin of a kernel; `None` for `Dense`, which has no error.
    pub(crate) fn new(kernel: Estimator, point: Point<'a>) -> Option<Self> {
        Some(match kernel {
            Estimator::ImportanceSampled { taps } => {
                Self::ImportanceSampled(ImportanceSampled::new(point, taps))
            }
            Estimator::Separable { taps, rotated } => Self::Separable(Separable::new(point, taps, rotated)),
            Estimator::Interleaved { taps } => Self::Interleaved(Interleaved::new(point, taps)),
            Estimator::Dense => return None,
        })
    }

    /// A kernel with the taps that the footprint leaves of its own: those with the same draw the same.
    pub(crate) fn effective(kernel: Estimator, point: &Point<'_>) -> Estimator {
        match kernel {
            Estimator::ImportanceSampled { taps } => {
                Estimator::ImportanceSampled { taps: point.footprint_taps(taps) }
            }
            Estimator::Separable { taps, rotated } => {
                Estimator::Separable { taps: point.footprint_taps(taps - 1) + 1, rotated }
            }
            // Its window narrows with the taps that are asked for, however many the footprint takes.
            Estimator::Interleaved { taps } if f64::from(taps) > EVEN_WINDOW_TAPS => {
                Estimator::Interleaved { taps: far_taps(taps) }
            }
            Estimator::Interleaved { taps } => {
                Estimator::Interleaved { taps: point.footprint_taps(far_taps(taps)) }
            }
            Estimator::Dense => Estimator::Dense,
        }
    }

    /// The pixels of a patch, row by row; `others` show the material's other surfaces where the scene has some.
    pub(crate) fn draw(&self, others: &[Self], scene: Scene, patch: Patch) -> Vec<Rgb> {
        let on =
            |first: i32, last: i32| scene.surface(first, last).place().and_then(|place| others.get(place));
        let column = |pixel: [i32; 2]| patch.in_scene(pixel)[0];
        match self {
            Self::ImportanceSampled(own) => {
                let at = |pixel| match on(column(pixel), column(pixel)) {
                    Some(Self::ImportanceSampled(other)) => other,
                    _ => own,
                };
                patch.pixels().map(|pixel| at(pixel).pixel(scene, patch, pixel)).collect()
            }
            Self::Separable(own) => {
                let at = |pixel| match on(column(pixel), column(pixel)) {
                    Some(Self::Separable(other)) => other,
                    _ => own,
                };
                let mut first = HashMap::new();
                patch.pixels().map(|pixel| at(pixel).pixel(&at, scene, patch, pixel, &mut first)).collect()
            }
            Self::Interleaved(own) => {
                let at = |[first, last]: [i32; 2]| match on(first, last) {
                    Some(Self::Interleaved(other)) => other,
                    _ => own,
                };
                Interleaved::draw(&at, scene, patch)
            }
        }
    }
}
