//! How long a kernel takes, so that the cheapest is tried first.

use subsurface_kernel::Estimator;

use crate::device::Device;

/// Time per pixel on a device, as a line over the number of taps.
struct Line {
    setup: f64,
    per_tap: f64,
}

/// Time of a kernel per pixel on `device`; infinite for `Dense`, whose time depends on the scene.
///
/// It only orders kernels on one device. On a GPU it is in cycles of a SIMD, as `cargo xtask shader-cost` estimates them
/// for the compute path and the ready-made materials. On a software driver it is in taps of `ImportanceSampled`, by the
/// times that `cargo bench --bench kernels` gives for Burley's profile at a mean radius of 5 pixels.
#[must_use]
pub fn cost(kernel: Estimator, device: Device) -> f64 {
    let line = |setup, per_tap| Line { setup, per_tap };
    let (taps, Line { setup, per_tap }) = match kernel {
        // On a GPU most of a pixel is its taps: each has a load and the densities of three channels.
        Estimator::ImportanceSampled { taps } => {
            let line = match device {
                Device::Rdna => line(6.1, 2.75),
                Device::Gcn => line(15.1, 8.53),
                Device::Software => line(8.0, 1.0),
            };
            (taps, line)
        }
        // A stage more, a ring of pixels and one of blocks; taps read packed squares.
        Estimator::Interleaved { taps } => {
            let line = match device {
                Device::Rdna => line(15.1, 1.39),
                Device::Gcn => line(34.4, 4.46),
                Device::Software => line(8.5, 0.7),
            };
            (taps, line)
        }
        // Two stages that each set up a pixel and the integrals of its strips.
        Estimator::Separable { taps, .. } => {
            let line = match device {
                Device::Rdna => line(5.4, 7.0),
                Device::Gcn => line(13.4, 16.4),
                Device::Software => line(11.0, 3.3),
            };
            (taps, line)
        }
        Estimator::Dense => return f64::INFINITY,
    };
    setup + per_tap * f64::from(taps)
}

/// Numbers of taps that are tried: steps of a third to a half, since the error falls about with their root.
const TAPS: [u32; 12] = [1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64];

/// The kernels of one kind that are tried, the one with the fewest taps first.
pub(crate) fn counts(kind: Estimator) -> Vec<Estimator> {
    // An odd number: a tap in the middle, and pairs.
    let odd = kind.tap_counts().is_some_and(|counts| counts.odd);
    let with = |taps: u32| kind.with_taps(if odd { taps | 1 } else { taps });
    let mut kernels: Vec<Estimator> =
        TAPS.into_iter().map(with).filter(|kernel| kernel.refused_taps().is_none()).collect();
    kernels.dedup();
    kernels
}

/// The kinds that are tried where a set names none.
pub(crate) fn kinds() -> impl Iterator<Item = Estimator> {
    Estimator::ALL.into_iter().filter(|kind| match kind {
        Estimator::ImportanceSampled { .. } | Estimator::Interleaved { .. } => true,
        // Rotated axes trade stars for noise: they cost the same, and their error is no less.
        Estimator::Separable { rotated, .. } => !rotated,
        // Without an error, and without an end.
        Estimator::Dense => false,
    })
}
