//! A kernel at a footprint, whichever it is.

use subsurface_kernel::Estimator;
use subsurface_kernel::constants::{EVEN_WINDOW_TAPS, PIXELS_OF_BLOCK};

use super::gathered::Rgb;
use super::importance_sampled::ImportanceSampled;
use super::interleaved::Interleaved;
use super::patch::Patch;
use super::point::Point;
use super::scene::Scene;
use super::separable::Separable;

/// A kernel as the processor runs it.
#[derive(Debug)]
pub(super) enum Twin<'a> {
    ImportanceSampled(ImportanceSampled<'a>),
    Separable(Separable<'a>),
    Interleaved(Interleaved<'a>),
}

impl<'a> Twin<'a> {
    /// The twin of a kernel; `None` for `Dense`, which has no error.
    pub(super) fn new(kernel: Estimator, point: Point<'a>) -> Option<Self> {
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
    pub(super) fn effective(kernel: Estimator, point: &Point<'_>) -> Estimator {
        match kernel {
            Estimator::ImportanceSampled { taps } => {
                Estimator::ImportanceSampled { taps: point.footprint_taps(taps) }
            }
            Estimator::Separable { taps, rotated } => {
                Estimator::Separable { taps: point.footprint_taps(taps - 1) + 1, rotated }
            }
            // Its window narrows with the taps that are asked for, however many the footprint takes.
            Estimator::Interleaved { taps } if f64::from(taps) > EVEN_WINDOW_TAPS => {
                Estimator::Interleaved { taps: taps * PIXELS_OF_BLOCK }
            }
            Estimator::Interleaved { taps } => {
                Estimator::Interleaved { taps: point.footprint_taps(taps * PIXELS_OF_BLOCK) }
            }
            Estimator::Dense => Estimator::Dense,
        }
    }

    /// The pixels of a patch, row by row.
    pub(super) fn draw(&self, scene: Scene, patch: Patch) -> Vec<Rgb> {
        match self {
            Self::ImportanceSampled(twin) => twin.draw(scene, patch),
            Self::Separable(twin) => twin.draw(scene, patch),
            Self::Interleaved(twin) => twin.draw(scene, patch),
        }
    }
}
