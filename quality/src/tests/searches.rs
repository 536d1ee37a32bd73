//! The search for the cheapest kernel.

use super::{Sample, deviation, materials, optics_of, published, sample, skin, solved};
use crate::pictures::case::Case;
use crate::report::stated;
use crate::search::cost::{cost, counts, kinds};
use crate::{Device, NoProfile, Quality, SearchError, Tier, search};
use subsurface_kernel::{Estimator, Rejection};

#[test]
fn candidates_are_allowed_and_sorted() {
    for kind in kinds() {
        let kernels = counts(kind);
        assert!(kernels.len() > 5);
        assert!(kernels.iter().all(|kernel| kernel.refused_taps().is_none()));
        for device in Device::ALL {
            let is_cheaper = |a: Estimator, b: Estimator| cost(a, device) < cost(b, device);
            assert!(kernels.is_sorted_by(|a, b| a.taps() < b.taps() && is_cheaper(*a, *b)), "{device:?}");
        }
        assert_eq!(
            kernels.iter().map(|kernel| kernel.taps()).max(),
            Some(if kind.tap_counts().is_some_and(|counts| counts.odd) { 65 } else { 64 })
        );
    }
    let turned = counts(Estimator::Separable { taps: 17, rotated: true });
    assert!(turned.iter().all(|kernel| kernel.is_rotated()));
}

#[test]
fn the_device_says_what_is_cheap() {
    // On a software driver a pixel's setup is worth many taps, and strips are integrated at length.
    let few = Estimator::ImportanceSampled { taps: 6 };
    let interleaved = Estimator::Interleaved { taps: 4 };
    let separable = Estimator::Separable { taps: 3, rotated: false };
    assert!(cost(interleaved, Device::Software) < cost(few, Device::Software));
    assert!(cost(few, Device::Software) < cost(separable, Device::Software));
    for gpu in [Device::Rdna, Device::Gcn] {
        assert!(cost(interleaved, gpu) < cost(few, gpu), "{gpu:?}");
        // Three taps in two directions are no dearer than eight.
        assert!(cost(separable, gpu) < cost(few.with_taps(8), gpu), "{gpu:?}");
    }
    assert_eq!(cost(Estimator::Dense, Device::Rdna), f64::INFINITY);
}

#[test]
fn the_search_finds_what_trying_everything_finds() {
    let samples = [skin(), sample([0.2, 2.0, 1.0], [0.9, 0.99, 0.2])];
    let optics = optics_of(&samples);
    let mut cases = Case::all(&optics, Rejection::default());
    let mut all: Vec<(Estimator, f64)> =
        kinds().flat_map(counts).map(|kernel| (kernel, deviation(&mut cases, kernel).error)).collect();
    all.sort_by(|(a, _), (b, _)| cost(*a, Device::default()).total_cmp(&cost(*b, Device::default())));
    let least = all.iter().map(|(_, error)| *error).fold(f64::INFINITY, f64::min);
    for target in [0.5, 0.06, least] {
        let (kernel, error) = all.iter().find(|(_, error)| *error <= target).expect("one is good enough");
        let report = solved(&samples, Quality::MaxError(target), None);
        assert_eq!((report.estimator, report.error), (*kernel, stated(*error)), "{target}");
        assert!(report.worst_pixel >= report.error);
        for tier in report.tiers {
            let mut of_kind = all.clone();
            of_kind.retain(|(other, _)| other.name() == kernel.name());
            let within = of_kind.iter().find(|(_, error)| *error <= tier.tier.target());
            let best = of_kind.iter().min_by(|(_, a), (_, b)| a.total_cmp(b)).expect("there are some");
            let (kernel, error) = within.unwrap_or(best);
            assert_eq!((tier.taps, tier.error), (kernel.taps(), stated(*error)), "{:?}", tier.tier);
        }
    }
    // Whatever is better than the best is refused, and the best is named.
    let found = search(
        &materials(&samples),
        Rejection::default(),
        Quality::MaxError(0.99 * least),
        None,
        Device::default(),
    );
    let (best, _) = all.iter().find(|(_, error)| *error <= least).expect("the least is there");
    assert_eq!(found, Err(SearchError::OutOfReach { best: *best, error: stated(least) }));
}

#[test]
fn a_named_kernel_is_kept() {
    for kind in kinds() {
        let report = solved(&[skin()], Quality::MaxError(0.2), Some(kind));
        assert_eq!(report.estimator.name(), kind.name());
        assert!(report.error <= 0.2);
    }
}

#[test]
fn materials_that_look_alike_are_tried_once() {
    let twice_as_large = sample([2.60, 1.90, 1.34], [0.83, 0.64, 0.55]);
    let other = sample([1.30, 0.95, 0.67], [0.83, 0.64, 0.5]);
    // And the model where it is white.
    assert_eq!(optics_of(&[skin(), twice_as_large, skin()]).len(), 1 + 1);
    assert_eq!(optics_of(&[skin(), other.clone()]).len(), 2 + 1);
    let gaussian = |of: Sample| published("gaussian_skin", of.mean_free_path_mm, of.surface_albedo);
    assert_eq!(optics_of(&[gaussian(skin()), gaussian(other)]).len(), 1);
}

#[test]
fn a_material_without_a_profile_is_named() {
    let nothing = sample([1.0; 3], [f64::NAN; 3]);
    let found = search(
        &materials(&[skin(), nothing]),
        Rejection::default(),
        Quality::Tier(Tier::Low),
        None,
        Device::default(),
    );
    assert!(matches!(found, Err(SearchError::NoProfile(NoProfile { material: 1, .. }))), "{found:?}");
}

#[test]
fn the_same_set_gives_the_same_report() {
    let solve = || solved(&[skin()], Quality::Tier(Tier::Medium), None);
    assert_eq!(solve(), solve());
}

#[test]
fn stated_errors_are_bounds_of_three_digits() {
    for (error, text) in [
        (0.0, "0"),
        (0.012_301, "0.0124"),
        (0.0123, "0.0123"),
        (0.999_9, "1"),
        (0.100_01, "0.101"),
        (4.561e-5, "0.0000457"),
    ] {
        assert_eq!(stated(error).to_string(), text);
        assert!(stated(error) >= error);
    }
}
