//! What a run promises: the same bytes whatever happens to it, and clear errors.

#![allow(clippy::unwrap_used, reason = "tests")]

use std::ops::ControlFlow;

use subsurface_reference::{
    Entry, EstimateError, Goal, GoalError, HalfSpace, HalfSpaceError, MergeError, Outcome, Run, TruthTable,
};

const BATCH: u64 = 1 << 16;

fn half_space() -> HalfSpace {
    HalfSpace::matched_isotropic(Entry::Searchlight)
}

/// `batches` batches of `seed`, on `threads` threads.
fn run(half_space: HalfSpace, seed: u64, batches: u64, threads: usize) -> Run {
    let mut run = Run::new(half_space, seed);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let goal = Goal::photons(batches * BATCH).unwrap();
    let outcome = pool.install(|| run.simulate(&goal, &mut |_| ControlFlow::Continue(())));
    assert_eq!(outcome, Outcome::Photons);
    assert_eq!(run.photons(), batches * BATCH);
    run
}

#[test]
fn bytes_do_not_depend_on_threads() {
    for half_space in [half_space(), HalfSpace::new(Entry::Diffuse, -0.3, 1.4).unwrap()] {
        let one = run(half_space, 5, 7, 1).to_bytes();
        assert_eq!(one, run(half_space, 5, 7, 2).to_bytes());
        assert_eq!(one, run(half_space, 5, 7, 5).to_bytes());
        assert_ne!(one, run(half_space, 6, 7, 5).to_bytes());
    }
}

#[test]
fn bytes_do_not_depend_on_the_machine() {
    // CRC-32 of the first batches as they were on x86-64 with AVX2. A change of the random numbers, the walk or the
    // rings changes them: then the stored tables have to be made again and the version of the format goes up.
    let media =
        [HalfSpace::matched_isotropic(Entry::Searchlight), HalfSpace::new(Entry::Diffuse, 0.5, 1.4).unwrap()];
    let checksums = media.map(|half_space| {
        let bytes = run(half_space, 1, 1, 1).to_bytes();
        // Without its own checksum: the CRC-32 of anything with its CRC-32 is a constant.
        crc32fast::hash(&bytes[..bytes.len() - 4])
    });
    assert_eq!(checksums, [391_843_364, 1_815_092_775]);
}

#[test]
fn breaks_and_files_leave_no_trace() {
    let whole = run(half_space(), 3, 9, 2);
    let mut pieces = Run::new(half_space(), 3);
    let goal = Goal::photons(9 * BATCH).unwrap();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let mut breaks = 0;
    while pool.install(|| pieces.simulate(&goal, &mut |_| ControlFlow::Break(()))) == Outcome::Interrupted {
        pieces = Run::from_bytes(&pieces.to_bytes()).unwrap();
        breaks += 1;
    }
    assert!(breaks > 1);
    assert_eq!(whole, pieces);
    assert_eq!(whole.to_bytes(), pieces.to_bytes());
}

#[test]
fn a_goal_in_reach_adds_nothing() {
    let mut once = run(half_space(), 3, 2, 1);
    let before = once.to_bytes();
    let goal = Goal::photons(1).unwrap();
    assert_eq!(once.simulate(&goal, &mut |_| unreachable!()), Outcome::Photons);
    assert_eq!(before, once.to_bytes());
}

#[test]
fn merging_commutes_and_associates() {
    let [one, two, three] = [1, 2, 3].map(|seed| run(half_space(), seed, seed, 2));
    let merged = |runs: [&Run; 3]| {
        let mut sum = runs[0].clone();
        sum.merge(runs[1]).unwrap();
        sum.merge(runs[2]).unwrap();
        sum.to_bytes()
    };
    let expected = merged([&one, &two, &three]);
    assert_eq!(expected, merged([&three, &one, &two]));
    let mut last_two = two.clone();
    last_two.merge(&three).unwrap();
    let mut all = one.clone();
    all.merge(&last_two).unwrap();
    assert_eq!(expected, all.to_bytes());
    assert_eq!(all.photons(), 6 * BATCH);
    assert_eq!(all.seeds().collect::<Vec<_>>(), [1, 2, 3]);
    // It goes on with the smallest seed, and ends up where that would have been.
    all.simulate(&Goal::photons(7 * BATCH).unwrap(), &mut |_| ControlFlow::Continue(()));
    assert_eq!(all.to_bytes(), merged([&run(half_space(), 1, 2, 1), &two, &three]));
}

#[test]
fn photons_are_not_counted_twice() {
    let mut long = run(half_space(), 1, 3, 2);
    let before = long.to_bytes();
    assert_eq!(long.merge(&run(half_space(), 1, 1, 1)), Err(MergeError::Overlap(1)));
    let other = Run::new(HalfSpace::matched_isotropic(Entry::Diffuse), 9);
    assert!(matches!(long.merge(&other), Err(MergeError::HalfSpace(..))));
    assert_eq!(before, long.to_bytes());
    // Nothing in common: an empty run of the same seed.
    long.merge(&Run::new(half_space(), 1)).unwrap();
    assert_eq!(before, long.to_bytes());
}

#[test]
fn a_standard_error_stops_earlier() {
    let mut once = Run::new(half_space(), 1);
    let goal = Goal::photons(1 << 40).unwrap().or_relative_standard_error(0.05).unwrap();
    let mut last = f64::INFINITY;
    let outcome = once.simulate(&goal, &mut |progress| {
        last = progress.relative_standard_error;
        ControlFlow::Continue(())
    });
    assert_eq!(outcome, Outcome::StandardError);
    assert!(last <= 0.05);
    // 2²² photons are where it looks first; they suffice for 5 %.
    assert_eq!(once.photons(), 1 << 22);
}

#[test]
fn impossible_requests_are_errors() {
    assert_eq!(Goal::photons(0), Err(GoalError::NoPhotons));
    let goal = Goal::photons(1).unwrap();
    for error in [0.0, -1.0, f64::NAN] {
        assert!(matches!(goal.or_relative_standard_error(error), Err(GoalError::StandardError(_))));
    }
    for anisotropy in [-1.0, 0.9999, 1.0, 2.0, f64::NAN] {
        let error = HalfSpace::new(Entry::Diffuse, anisotropy, 1.0);
        assert!(matches!(error, Err(HalfSpaceError::Anisotropy(_))));
    }
    for refractive_index in [0.9, 4.1, f64::NAN, f64::INFINITY] {
        let error = HalfSpace::new(Entry::Diffuse, 0.0, refractive_index);
        assert!(matches!(error, Err(HalfSpaceError::RefractiveIndex(_))));
    }
    let empty = Run::new(half_space(), 1);
    assert_eq!(empty.surface_albedo(0.5), Err(EstimateError::NoPhotons));
    let some = run(half_space(), 1, 1, 1);
    for value in [-0.1, 1.1, f64::NAN] {
        assert!(matches!(some.surface_albedo(value), Err(EstimateError::SingleScatteringAlbedo(_))));
        assert!(matches!(some.radial_profile(value), Err(EstimateError::SingleScatteringAlbedo(_))));
        assert!(matches!(some.single_scattering_albedo(value), Err(EstimateError::SurfaceAlbedo(_))));
    }
    for surface_albedos in [[0.5, 0.2], [0.5, 0.5]] {
        let table = TruthTable::from_run(&some, &surface_albedos, "");
        assert_eq!(table, Err(EstimateError::Order(surface_albedos[1])));
    }
    for edges in [&[0.0, 0.3][..], &[0.0, 0.01, 0.005], &[0.0, f64::NAN]] {
        assert!(matches!(some.radial_profile_on(0.5, edges), Err(EstimateError::Edge(_))));
    }
}
