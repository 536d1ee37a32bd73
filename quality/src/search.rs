//! The search: candidates by cost, the first within the error wins.

pub(crate) mod cost;

use subsurface_kernel::Estimator;
use subsurface_kernel::Rejection;

use crate::device::Device;
use crate::material::Material;
use crate::optics::Optics;
use crate::pictures::case::{Case, Deviation, FOOTPRINTS};
use crate::pictures::scene::Scene;
use crate::quality::{Quality, Tier};
use crate::report::{PictureReport, QualityReport, TierReport, stated};
use crate::search_error::SearchError;
use cost::{cost, counts, kinds};

/// Searches the kernel for `materials` that is the cheapest on `device` and as good as `quality` asks for: of one `kind`,
/// whatever its taps, or of all.
///
/// # Errors
/// No kernel within the error, or a material without a profile at a surface albedo that is tried.
pub fn search(
    materials: &[Material<'_>],
    rejection: Rejection,
    quality: Quality,
    kind: Option<Estimator>,
    device: Device,
) -> Result<QualityReport, SearchError> {
    let optics = Optics::of_all(materials).map_err(SearchError::NoProfile)?;
    let mut trial = Trial { cases: Case::all(&optics, rejection) };
    let mut candidates: Vec<Estimator> = match kind {
        Some(kind) => trial.counts(kind),
        None => kinds().flat_map(|kind| trial.counts(kind)).collect(),
    };
    // Stable: of two that cost the same, the kind that comes first.
    candidates.sort_by(|a, b| cost(*a, device).total_cmp(&cost(*b, device)));
    let Some((kernel, deviation)) = trial.first_within(&candidates, quality.target()) else {
        let (best, deviation) = trial.best(&candidates).unwrap_or((Estimator::Dense, Deviation::default()));
        return Err(SearchError::OutOfReach { best, error: stated(deviation.error) });
    };
    let counts = trial.counts(kernel);
    let tiers = Tier::ALL.map(|tier| {
        let found = trial.first_within(&counts, tier.target()).or_else(|| trial.best(&counts));
        let (kernel, deviation) = found.unwrap_or((kernel, deviation));
        TierReport { tier, taps: kernel.taps(), error: stated(deviation.error) }
    });
    let Deviation { error, worst_pixel } = deviation;
    let pictures = trial.pictures(kernel);
    Ok(QualityReport {
        estimator: kernel,
        error: stated(error),
        worst_pixel: stated(worst_pixel),
        tiers,
        pictures,
    })
}

/// A candidate, and how far it is from the exact result.
type Found = (Estimator, Deviation);

/// The cases, the one first that was the last to be hard: it is likely to refuse the next candidate as well.
struct Trial<'a> {
    cases: Vec<Case<'a>>,
}

impl Trial<'_> {
    /// Those numbers of taps of a kind that make a difference: footprints put an end to them.
    fn counts(&self, kind: Estimator) -> Vec<Estimator> {
        let mut kernels = counts(kind);
        kernels.dedup_by(|next, last| !self.cases.iter().any(|case| case.tells_apart(*next, *last)));
        kernels
    }

    /// The first candidate within `target`.
    fn first_within(&mut self, candidates: &[Estimator], target: f64) -> Option<Found> {
        candidates
            .iter()
            .find_map(|&kernel| self.deviation_within(kernel, target).map(|deviation| (kernel, deviation)))
    }

    /// The candidate with the least error; the first of equals.
    fn best(&mut self, candidates: &[Estimator]) -> Option<Found> {
        // The most promising on the hardest case first: few of the others have to be tried on all.
        let mut order: Vec<(usize, f64)> = Vec::new();
        for (place, &kernel) in candidates.iter().enumerate() {
            let hardest = self.cases.first_mut().and_then(|case| case.deviation(kernel));
            order.push((place, hardest?.error));
        }
        order.sort_by(|(_, a), (_, b)| a.total_cmp(b));
        let mut best: Option<(usize, Deviation)> = None;
        for (place, _) in order {
            let limit = best.map_or(f64::INFINITY, |(_, best)| best.error);
            let Some(deviation) = self.deviation_within(candidates[place], limit) else { continue };
            if best.is_none_or(|(first, best)| deviation.error < best.error || place < first) {
                best = Some((place, deviation));
            }
        }
        best.map(|(place, deviation)| (candidates[place], deviation))
    }

    fn move_to_front(&mut self, case: usize) {
        if let Some(cases) = self.cases.get_mut(..=case) {
            cases.rotate_right(1);
        }
    }

    /// Deviations of a kernel by picture and footprint, whatever the material.
    fn pictures(&mut self, kernel: Estimator) -> Vec<PictureReport> {
        let mut pictures = Vec::new();
        for mean_radius_pixels in FOOTPRINTS {
            for scene in Scene::all(mean_radius_pixels) {
                let all = self.cases.iter_mut().filter(|case| {
                    case.scene == scene && case.mean_radius_pixels.total_cmp(&mean_radius_pixels).is_eq()
                });
                let deviation =
                    all.filter_map(|case| case.deviation(kernel)).fold(Deviation::default(), Deviation::and);
                pictures.push(PictureReport {
                    name: scene.name(),
                    mean_radius_pixels,
                    error: stated(deviation.error),
                    worst_pixel: stated(deviation.worst_pixel),
                });
            }
        }
        pictures
    }

    /// Deviation of a kernel over all cases; `None` when its error is above `limit`, or for a kernel without a twin.
    fn deviation_within(&mut self, kernel: Estimator, limit: f64) -> Option<Deviation> {
        let mut all = Deviation::default();
        let mut hardest = 0;
        for index in 0..self.cases.len() {
            let deviation = self.cases[index].deviation(kernel)?;
            if deviation.error > limit {
                self.move_to_front(index);
                return None;
            }
            if deviation.error > all.error {
                hardest = index;
            }
            all = all.and(deviation);
        }
        self.move_to_front(hardest);
        Some(all)
    }
}
