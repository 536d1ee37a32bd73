//! What must hold for any stack.

use std::ops::ControlFlow;

use proptest::prelude::*;
use subsurface_reference::Estimate;
use subsurface_reference::layers::{Grid, LayerResult, LayerRun, OutputFormat};

use super::{Row, assert_within_noise, run, simulate, stack};

const TURBID: Row = [1.4, 1.0, 20.0, 0.6, 0.1];

#[track_caller]
fn assert_same(what: &str, left: Estimate, right: Estimate) {
    assert_within_noise(what, left.mean - right.mean, left.standard_error.hypot(right.standard_error));
}

/// What specular and diffuse reflectance, transmittance and absorption lack to 1.
fn missing(result: &LayerResult) -> f64 {
    1.0 - result.specular_reflectance
        - result.diffuse_reflectance.mean
        - result.transmittance.mean
        - result.absorbed.mean
}

fn rows() -> impl Strategy<Value = Vec<Row>> {
    let row = (0.8..2.0, 0.0..30.0, 0.0..60.0, -1.0..=1.0, 1e-3..0.3, 0..4).prop_map(
        |(n, mua, mus, g, d, kind)| match kind {
            0 => [n, 0.0, 0.0, 0.0, d],
            1 => [n, mua, 0.0, g, d],
            2 => [n, 0.0, mus, g, d],
            _ => [n, mua, mus, g, d],
        },
    );
    prop::collection::vec(row, 1..5)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn no_energy_is_lost(rows in rows(), above in 0.9..1.6, below in 0.9..1.6, seed in any::<u64>()) {
        let result = simulate(above, &rows, below, 2000, seed);
        // The roulette's books balance to rounding: weights are whole numbers of units.
        prop_assert!((missing(&result) - result.roulette).abs() < 1e-14, "{}", missing(&result));
        // 2000 packets of at most 1e-4, multiplied by at most 10: beyond 1e-3 the roulette would not be fair.
        prop_assert!(result.roulette.abs() < 1e-3);
        let parts: f64 = result.absorbed_by_layer.iter().map(|layer| layer.mean).sum();
        prop_assert!((parts - result.absorbed.mean).abs() < 1e-14);
        prop_assert!(result.diffuse_reflectance.mean >= 0.0 && result.transmittance.mean >= 0.0);
    }
}

#[test]
fn the_roulette_is_fair() {
    // A deep absorbing half-space ends nearly every packet in the roulette. Each of the 10⁵ leaves at most 1e-4 there,
    // survives with 1/10 and then holds at most 1e-3: a deviation of about 3e-4 each, 1e-6 of the mean.
    let result = simulate(1.0, &[[1.0, 5.0, 5.0, 0.9, 1e8]], 1.0, 100_000, 20);
    assert!(result.roulette != 0.0);
    assert_within_noise("roulette", result.roulette, 1e-6);
}

#[test]
fn threads_do_not_change_a_byte() {
    let run = run(1.0, &[TURBID, [1.5, 0.0, 0.0, 0.0, 0.1], [1.33, 3.0, 5.0, -0.2, 0.2]], 1.2, 20_001);
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| run.simulate(21, &mut |_| ControlFlow::Continue(())))
    };
    let one = on(1);
    assert_eq!(one.photons, 20_001);
    for threads in [2, 3, 7] {
        let many = on(threads);
        assert_eq!(one, many);
        assert_eq!(one.to_mco(), many.to_mco());
    }
    assert_ne!(one, run.simulate(22, &mut |_| ControlFlow::Continue(())));
}

#[test]
fn an_interrupted_run_gives_what_it_has() {
    let run = run(1.0, &[TURBID], 1.0, u64::MAX);
    let mut calls = 0;
    let result = run.simulate(23, &mut |progress| {
        calls += 1;
        assert_eq!(progress.requested, u64::MAX);
        if calls == 3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert_eq!(calls, 3);
    assert!(result.photons > 0 && result.photons.is_multiple_of(3));
    assert!((missing(&result) - result.roulette).abs() < 1e-14);
    // The same packets as a run of that length.
    let whole = simulate(1.0, &[TURBID], 1.0, result.photons, 23);
    assert_eq!(result.diffuse_reflectance, whole.diffuse_reflectance);
    assert_eq!(result.reflectance_by_radius, whole.reflectance_by_radius);
}

#[test]
fn standard_errors_are_those_of_repeated_runs() {
    let results: Vec<_> = (0..200).map(|seed| simulate(1.0, &[TURBID], 1.0, 1024, 1000 + seed)).collect();
    type Total = fn(&LayerResult) -> Estimate;
    let totals: [(&str, Total); 4] = [
        ("Rd", |result| result.diffuse_reflectance),
        ("Tt", |result| result.transmittance),
        ("A", |result| result.absorbed),
        ("Rd_r[5]", |result| result.reflectance_by_radius[5]),
    ];
    for (what, total) in totals {
        let estimates: Vec<_> = results.iter().map(total).collect();
        let count = estimates.len() as f64;
        let mean = estimates.iter().map(|estimate| estimate.mean).sum::<f64>() / count;
        let scatter =
            estimates.iter().map(|estimate| (estimate.mean - mean).powi(2)).sum::<f64>() / (count - 1.0);
        let stated = estimates.iter().map(|estimate| estimate.standard_error.powi(2)).sum::<f64>() / count;
        // A variance from 200 samples has a relative deviation of √(2/199) = 0.10; 0.4 is four of it.
        assert!((scatter / stated - 1.0).abs() < 0.4, "{what}: {}", scatter / stated);
    }
}

/// Transmittance and reflectance of a slab that only absorbs, for perpendicular light and without interference:
/// Beer–Lambert with all reflections between the faces.
fn absorbing_plate(index: f64, optical_thickness: f64) -> (f64, f64) {
    let face = ((index - 1.0) / (index + 1.0)).powi(2);
    let once = (-optical_thickness).exp();
    let echo = 1.0 - (face * once).powi(2);
    let transmitted = (1.0 - face).powi(2) * once / echo;
    (face + face * once * transmitted, transmitted)
}

#[test]
fn a_slab_that_only_absorbs_obeys_beer_and_lambert() {
    for (seed, (index, optical_thickness)) in (30..).zip([(1.0, 0.5), (1.5, 0.1), (3.0, 1.0), (0.5, 2.0)]) {
        let result = simulate(1.0, &[[index, 10.0, 0.0, 0.3, optical_thickness / 10.0]], 1.0, 400_000, seed);
        let (reflected, transmitted) = absorbing_plate(index, optical_thickness);
        let (r, t) = (result.total_reflectance(), result.transmittance);
        // Where nothing is reflected the estimate is exact and has no error; 1e-12 is rounding.
        assert_within_noise(&format!("n {index}: R"), r.mean - reflected, r.standard_error.max(1e-12));
        assert_within_noise(&format!("n {index}: T"), t.mean - transmitted, t.standard_error);
        // Unscattered light leaves where it came in.
        assert!(result.transmittance_by_radius[1..].iter().all(|cell| cell.mean == 0.0));
        assert!(result.transmittance_by_angle[1..].iter().all(|cell| cell.mean == 0.0));
    }
}

#[test]
fn a_turned_slab_transmits_alike() {
    // Reciprocity for perpendicular light *and* perpendicular detection is exact for any stack; the total transmittance
    // is the same from both sides where the slab is its own mirror image, or homogeneous.
    let turbid = [[1.0, 1.0, 20.0, 0.6, 0.1], [1.0, 4.0, 3.0, 0.0, 0.05], [1.0, 1.0, 20.0, 0.6, 0.1]];
    let down = simulate(1.0, &turbid, 1.0, 200_000, 40);
    let turned: Vec<_> = turbid.iter().rev().copied().collect();
    assert_same("T", down.transmittance, simulate(1.0, &turned, 1.0, 200_000, 41).transmittance);

    // Layers that differ: what reciprocity equates is the light that leaves along the normal, per solid angle. The cell
    // from 6° to 12° has no unscattered light, and is near enough: cos 9° = 0.988.
    let two = [[1.0, 0.5, 30.0, 0.0, 0.1], [1.0, 4.0, 30.0, 0.0, 0.1]];
    let swapped = [two[1], two[0]];
    let perpendicular = |rows: &[Row], seed| {
        let grid = Grid::new(0.01, 0.01, 1, 1, 15).unwrap();
        let run = LayerRun::new("t", OutputFormat::Ascii, 400_000, grid, stack(1.0, rows, 1.0)).unwrap();
        run.simulate(seed, &mut |_| ControlFlow::Continue(()))
    };
    let (above, below) = (perpendicular(&two, 42), perpendicular(&swapped, 43));
    let (there, back) = (above.transmittance_by_angle[1], below.transmittance_by_angle[1]);
    assert!(there.standard_error < 0.03 * there.mean, "{there:?}");
    assert_same("T at 9°", there, back);
    // The two orders do differ in what comes back.
    assert!(above.diffuse_reflectance.mean > 1.2 * below.diffuse_reflectance.mean);
}

#[test]
fn a_thick_slab_is_a_half_space() {
    // 30 cm are 47 diffusion lengths: e^(−47) of the light would come back from the bottom.
    let rows = |thickness| [[1.4, 0.5, 9.5, 0.2, thickness]];
    let slab = simulate(1.0, &rows(30.0), 1.0, 200_000, 50);
    let half_space = simulate(1.0, &rows(1e8), 1.0, 200_000, 51);
    assert_same("Rd", slab.diffuse_reflectance, half_space.diffuse_reflectance);
    assert_eq!(slab.transmittance.mean, 0.0);
}

#[test]
fn two_halves_are_one_layer() {
    let half = [TURBID[0], TURBID[1], TURBID[2], TURBID[3], TURBID[4] / 2.0];
    let whole = simulate(1.0, &[TURBID], 1.33, 200_000, 60);
    let halves = simulate(1.0, &[half, half], 1.33, 200_000, 61);
    assert_same("Rd", whole.diffuse_reflectance, halves.diffuse_reflectance);
    assert_same("Tt", whole.transmittance, halves.transmittance);
    assert_same("A", whole.absorbed, halves.absorbed);
    let (first, second) = (halves.absorbed_by_layer[0], halves.absorbed_by_layer[1]);
    assert!((first.mean + second.mean - halves.absorbed.mean).abs() < 1e-14);
}

#[test]
fn clear_layers_reflect_as_plates() {
    // A plate in air: R = 2r/(1 + r), and nothing is random.
    let plate = simulate(1.0, &[[1.5, 0.0, 0.0, 0.0, 1.0]], 1.0, 10, 70);
    assert!((plate.specular_reflectance - 0.08 / 1.04).abs() < 1e-13);
    assert!((plate.transmittance.mean - (1.0 - 0.08 / 1.04)).abs() < 1e-13);
    assert_eq!((plate.diffuse_reflectance.mean, plate.absorbed.mean), (0.0, 0.0));

    // Where indices match, clear layers above and below change no total.
    let bare = simulate(1.0, &[[1.0, 1.0, 20.0, 0.6, 0.1]], 1.0, 200_000, 71);
    let clear = [1.0, 0.0, 0.0, 0.0, 5.0];
    let wrapped = simulate(1.0, &[clear, clear, [1.0, 1.0, 20.0, 0.6, 0.1], clear], 1.0, 200_000, 72);
    assert_same("Rd", bare.diffuse_reflectance, wrapped.diffuse_reflectance);
    assert_same("Tt", bare.transmittance, wrapped.transmittance);
}

#[test]
fn only_ratios_of_indices_count() {
    let scaled = |factor: f64| {
        simulate(factor, &[[1.4 * factor, 1.0, 20.0, 0.6, 0.1]], 1.2 * factor, 20_000, 80).diffuse_reflectance
    };
    // A factor of two is exact in binary, so the very same paths are walked.
    assert_eq!(scaled(1.0), scaled(2.0));
}

#[test]
fn total_reflection_keeps_conserved_light_in() {
    // Without absorption all light leaves, however often it is reflected inside.
    let result = simulate(1.0, &[[2.5, 0.0, 30.0, 0.0, 0.2]], 1.0, 20_000, 90);
    assert_eq!((result.absorbed.mean, result.roulette), (0.0, 0.0));
    assert!(missing(&result).abs() < 1e-14);
}
