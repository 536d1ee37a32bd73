//! How long a kernel takes, so that the cheapest is tried first.

use subsurface_kernel::Estimator;

/// Time per pixel in units of one tap of `ImportanceSampled`.
///
/// Lines through the times that `cargo bench --bench kernels` gives for Burley's profile at a mean radius of 5 pixels
/// on a software driver, where a tap costs what it computes. They only order the search: a GPU has other figures.
pub(crate) fn cost(kernel: Estimator) -> f64 {
    match kernel {
        // What a pixel sets up is worth eight taps.
        Estimator::ImportanceSampled { taps } => 8.0 + f64::from(taps),
        // The ring of eight pixels, nine blocks to mix and a stage more; taps read packed pixels.
        Estimator::Interleaved { taps } => 8.5 + 0.7 * f64::from(taps),
        // Two stages that each set up a pixel and the integrals of its strips.
        Estimator::Separable { taps, .. } => 42.0 + 1.8 * f64::from(taps),
        Estimator::Dense => f64::INFINITY,
    }
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
