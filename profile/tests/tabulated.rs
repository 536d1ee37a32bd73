//! Laws of tabulated profiles, and what they make of the data.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::f64::consts::PI;

use proptest::prelude::*;
use subsurface_profile::quadrature::Quadrature;
use subsurface_profile::{
    Channel, Medium, Model, RadialData, RadialProfile, RadialRow, TabulatedError, TabulatedModel,
};

const FRACTIONS: [f64; 17] = [
    0.0,
    1e-300,
    1e-12,
    1e-6,
    1e-3,
    0.01,
    0.1,
    0.3,
    0.5,
    0.7,
    0.9,
    0.99,
    0.999,
    1.0 - 1e-6,
    1.0 - 1e-9,
    1.0 - 1e-12,
    1.0 - f64::EPSILON / 2.0,
];

fn published(stem: &str, surface_albedo: f64) -> Box<dyn RadialProfile> {
    let medium = Medium::new(surface_albedo, 1.0).unwrap();
    Model::published(stem).unwrap().profile(medium, Channel::Red).unwrap()
}

/// Edges that grow with the radius, from 0 to `end`.
fn edges(bins: u32, end: f64) -> Vec<f64> {
    (0..=bins).map(|bin| end * (f64::from(bin) / f64::from(bins)).powi(3)).collect()
}

fn bins_of(stem: &str, surface_albedo: f64, edges: &[f64]) -> RadialData {
    let profile = published(stem, surface_albedo);
    let rows = edges.windows(2).map(|ends| {
        let energy = surface_albedo * (profile.radial_tail(ends[0]) - profile.radial_tail(ends[1]));
        RadialRow::bin(ends[0], ends[1], energy / (2.0 * PI * (ends[1] - ends[0])))
    });
    RadialData::new(surface_albedo, rows.collect()).unwrap()
}

fn points_of(stem: &str, surface_albedo: f64, radii: &[f64]) -> RadialData {
    let profile = published(stem, surface_albedo);
    let value = |r: f64| surface_albedo * profile.radial_pdf(r) / (2.0 * PI);
    let rows = radii.iter().map(|r| RadialRow::point(*r, value(*r)));
    RadialData::new(surface_albedo, rows.collect()).unwrap()
}

fn histogram(surface_albedo: f64, edges: &[f64], values: &[f64]) -> RadialData {
    let bins = edges.windows(2).zip(values);
    let rows = bins.map(|(ends, value)| RadialRow::bin(ends[0], ends[1], *value));
    RadialData::new(surface_albedo, rows.collect()).unwrap()
}

fn tabulated(data: &[RadialData]) -> Model {
    Model::Tabulated(TabulatedModel::new(data).unwrap())
}

fn models() -> Vec<(&'static str, Model)> {
    let dipole = "exponential_dipole_searchlight";
    vec![
        ("bins", tabulated(&[bins_of(dipole, 0.5, &edges(100, 50.0))])),
        ("points", tabulated(&[points_of("burley_diffuse", 0.3, &edges(80, 20.0))])),
        ("points that begin with 0", tabulated(&[points_of("gaussian_skin", 0.3, &edges(80, 10.0))])),
        ("points that begin late", tabulated(&[points_of(dipole, 0.3, &edges(80, 20.0)[10..])])),
        ("two bins", tabulated(&[histogram(0.5, &[0.0, 0.1, 5.0], &[3.0, 0.2])])),
        (
            "ragged, with bins of 0",
            tabulated(&[histogram(
                0.5,
                &[0.0, 0.1, 0.2, 1.0, 1.5, 4.0, 4.1, 9.0],
                &[0.0, 5.0, 0.1, 0.0, 0.0, 9.0, 0.0],
            )]),
        ),
        (
            "surface albedos on common radii",
            tabulated(&[0.9, 0.1, 0.5].map(|a| bins_of(dipole, a, &edges(60, 80.0)))),
        ),
        (
            "surface albedos on radii of their own",
            tabulated(&[
                bins_of(dipole, 0.2, &edges(30, 10.0)),
                points_of(dipole, 0.6, &edges(41, 30.0)),
                bins_of(dipole, 0.95, &edges(53, 100.0)),
            ]),
        ),
    ]
}

/// Every model at surface albedos within its tables, between them and outside.
fn domain() -> Vec<(String, Box<dyn RadialProfile>)> {
    let mut domain = Vec::new();
    for (name, model) in models() {
        for surface_albedo in [0.0, 0.1, 0.3, 0.5, 0.62, 1.0] {
            for mean_free_path_mm in [1e-3, 1.0, 1e3] {
                let medium = Medium::new(surface_albedo, mean_free_path_mm).unwrap();
                let profile = model.profile(medium, Channel::Red).unwrap();
                domain.push((format!("{name}, A = {surface_albedo}, {mean_free_path_mm} mm"), profile));
            }
        }
    }
    domain
}

#[test]
fn the_cdf_is_the_integral_of_the_pdf_and_reaches_one() {
    for (name, model) in models() {
        let Model::Tabulated(table) = &model else { panic!("it is tabulated") };
        for surface_albedo in [0.0, 0.3, 0.62, 1.0] {
            let profile = table.profile(Medium::new(surface_albedo, 1.0).unwrap()).unwrap();
            let mut integral = 0.0;
            // The density is a parabola between two knots, and has kinks there.
            for ends in table.radii().windows(2) {
                let part = Quadrature::default().integrate(|r| profile.radial_pdf(r), ends[0], ends[1]);
                let by_cdf = profile.radial_cdf(ends[1]) - profile.radial_cdf(ends[0]);
                assert!((part - by_cdf).abs() < 1e-14, "{name}: {part} and {by_cdf} over {ends:?}");
                integral += part;
            }
            // Roundings of some 100 parts.
            assert!((integral - 1.0).abs() < 1e-13, "{name}: {integral}");
        }
    }
    for (name, profile) in domain() {
        let end = profile.max_radius().unwrap();
        assert_eq!((profile.radial_cdf(0.0), profile.radial_tail(0.0)), (0.0, 1.0), "{name}");
        for beyond in [end, 2.0 * end, f64::MAX, f64::INFINITY] {
            assert_eq!((profile.radial_cdf(beyond), profile.radial_tail(beyond)), (1.0, 0.0), "{name}");
            assert_eq!((profile.radial_pdf(beyond), profile.area_pdf(beyond)), (0.0, 0.0), "{name}");
        }
    }
}

#[test]
fn sampling_inverts_the_cdf() {
    for (name, profile) in domain() {
        let mut last = 0.0;
        for u in FRACTIONS {
            let r = profile.sample_radius(u);
            assert!(r >= last && r <= profile.max_radius().unwrap(), "{name} at u = {u}: {r} after {last}");
            last = r;
            // A radius is solved to a few ulps; where a knot stands at cdf c, it is the sum of both. Narrow bins
            // far out multiply the rounding of r by r times the density: 40 here.
            let there = profile.radial_cdf(r);
            // After bins of 0 the first light is a radius beyond that of the bins, to the rounding of that.
            let offset = if name.starts_with("ragged") { 1e-15 } else { 0.0 };
            assert!((there - u).abs() <= 1e-13 * u + offset, "{name} at u = {u}: {there}");
            let (q, tail) = (1.0 - u, profile.radial_tail(r));
            // The last piece falls to 0 as the square of the distance from the end, as a polynomial profile does.
            let bound = 1e-13 + 200.0 * f64::EPSILON / q.sqrt();
            assert!((tail - q).abs() <= bound * q, "{name} at 1 - u = {q}: {tail}");
        }
        assert_eq!(profile.sample_radius(1.0), last, "{name}");
        assert_eq!(profile.sample_radius(-1.0), 0.0, "{name}");
    }
}

#[test]
fn the_cdf_is_monotone_and_the_pdf_continuous() {
    for (name, profile) in domain() {
        let end = profile.max_radius().unwrap();
        let (mut cdf, mut tail) = (0.0, 1.0);
        let peak = (0..1000).map(|step| profile.radial_pdf(end * f64::from(step) / 1e3)).fold(0.0, f64::max);
        for step in 0..=3000 {
            let r = end * (f64::from(step) / 3000.0).powi(2);
            let (next_cdf, next_tail, pdf) =
                (profile.radial_cdf(r), profile.radial_tail(r), profile.radial_pdf(r));
            assert!(pdf >= 0.0 && pdf.is_finite(), "{name} at {r}: {pdf}");
            // A sum of the masses of 100 knots.
            assert!(next_cdf >= cdf - 1e-15 && next_tail <= tail + 1e-15, "{name} at {r}");
            assert!((next_cdf + next_tail - 1.0).abs() < 1e-14, "{name} at {r}: {next_cdf} + {next_tail}");
            let near = profile.radial_pdf(r * (1.0 + 1e-9));
            assert!((near - pdf).abs() < 1e-5 * peak.max(pdf), "{name} jumps at {r}: {pdf}, {near}");
            (cdf, tail) = (next_cdf, next_tail);
        }
    }
}

#[test]
fn the_radial_pdf_is_2_pi_r_times_the_area_pdf() {
    for (name, profile) in domain() {
        for u in &FRACTIONS[2..] {
            let r = profile.sample_radius(*u);
            let (radial, area) = (profile.radial_pdf(r), profile.area_pdf(r));
            // A handful of roundings; where a density begins with 0, 1 - 3(1 - s) cancels to s.
            assert!((2.0 * PI * r * area - radial).abs() <= 1e-12 * radial, "{name} at {r}: {radial}");
        }
        assert!(profile.area_pdf(0.0) >= 0.0, "{name}");
    }
}

#[test]
fn radii_that_are_no_radii_have_a_defined_result() {
    for (name, p) in domain() {
        for f in [
            &(|r| p.area_pdf(r)) as &dyn Fn(f64) -> f64,
            &|r| p.radial_pdf(r),
            &|r| p.radial_cdf(r),
            &|r| p.radial_tail(r),
            &|r| p.transmittance(r),
            &|u| p.sample_radius(u),
        ] {
            assert!(f(f64::NAN).is_nan(), "{name}");
            for below in [-0.0, -1e-300, f64::NEG_INFINITY] {
                assert_eq!(f(below).to_bits(), f(0.0).to_bits(), "{name}: {below}");
            }
        }
    }
}

#[test]
fn the_cdf_is_exact_at_the_edges_of_the_bins() {
    let edges = edges(40, 30.0);
    for (surface_albedo, other) in [(0.3, 0.8), (0.8, 0.3)] {
        let stem = "exponential_dipole_diffuse";
        // The second table has edges of its own, which cut the pieces of the first.
        let ragged: Vec<f64> = edges.iter().map(|r| 0.7 * r).collect();
        let data = [bins_of(stem, surface_albedo, &edges), bins_of(stem, other, &ragged)];
        let medium = Medium::new(surface_albedo, 1.0).unwrap();
        let profile = tabulated(&data).profile(medium, Channel::Red).unwrap();
        let truth = published(stem, surface_albedo);
        for edge in &edges {
            let exact = truth.radial_cdf(*edge) / truth.radial_cdf(30.0);
            // Sums of 80 masses.
            assert!((profile.radial_cdf(*edge) - exact).abs() < 1e-14, "{edge}");
        }
    }
}

#[test]
fn a_fine_table_is_the_profile_it_was_made_from() {
    let stem = "exponential_dipole_searchlight";
    let truth = published(stem, 0.8);
    let medium = Medium::new(0.8, 1.0).unwrap();
    for (data, bound) in [
        // Measured: 1.4e-5, 1.9e-5. The error falls as the square of the width.
        (bins_of(stem, 0.8, &edges(150, 200.0)), 5e-5),
        (points_of(stem, 0.8, &edges(150, 200.0)), 5e-4),
    ] {
        let profile = tabulated(&[data]).profile(medium, Channel::Red).unwrap();
        for step in 1..1000 {
            let r = truth.sample_radius(f64::from(step) / 1000.0);
            let error = (profile.radial_cdf(r) - truth.radial_cdf(r)).abs();
            assert!(error < bound, "{error:e} at {r}");
        }
    }
}

#[test]
fn between_two_surface_albedos_the_cdfs_mix() {
    let stem = "exponential_dipole_searchlight";
    let data = [0.8, 0.4].map(|a| bins_of(stem, a, &edges(50, 50.0)));
    let model = tabulated(&data);
    let at = |surface_albedo| model.profile(Medium::new(surface_albedo, 1.0).unwrap(), Channel::Red).unwrap();
    for r in [0.01, 0.5, 3.0, 40.0] {
        let (lower, upper) = (at(0.4).radial_cdf(r), at(0.8).radial_cdf(r));
        // Roundings of the mixed masses.
        assert!((at(0.5).radial_cdf(r) - (0.75 * lower + 0.25 * upper)).abs() < 1e-14);
        assert_eq!(at(0.0).radial_cdf(r), lower, "clamped below");
        assert_eq!(at(1.0).radial_cdf(r), upper, "clamped above");
    }
    assert_eq!(at(0.55).surface_albedo(), 0.55);
    let Model::Tabulated(table) = &model else { panic!("it is tabulated") };
    let truth = published(stem, 0.4).radial_cdf(50.0);
    assert!((table.energy_before_normalization(0.1) - truth).abs() < 1e-14);
}

#[test]
fn values_at_the_ends_of_the_range_of_numbers_count_by_their_ratios() {
    let medium = Medium::new(0.5, 1.0).unwrap();
    let cdf = |radii: [f64; 2], values: [f64; 2]| {
        let rows = [0, 1].map(|row| RadialRow::point(radii[row], values[row]));
        let table = TabulatedModel::new(&[RadialData::new(0.5, rows.to_vec()).unwrap()]).unwrap();
        assert!(table.energy_before_normalization(0.5).is_finite());
        let profile = table.profile(medium).unwrap();
        assert!(profile.sample_radius(0.997) < radii[1]);
        profile.radial_cdf(0.5 * radii[0])
    };
    // A constant r·R up to 0.99 of the end: half of that radius holds 0.99/2 of the energy. What lies before the first
    // point has an infinite integral in the first case, and most digits of the second are lost in the last place.
    assert!((cdf([9.9e11, 1e12], [1e297; 2]) - 0.495).abs() < 1e-15);
    assert!((cdf([9.9, 10.0], [1e-322; 2]) - 0.495).abs() < 1e-15);
}

#[test]
fn the_order_of_the_tables_does_not_matter_and_roundings_of_radii_merge() {
    let stem = "burley_searchlight";
    let fine = edges(50, 50.0);
    let noisy: Vec<f64> = fine.iter().map(|r| r * (1.0 + 1e-15)).collect();
    let (low, high) = (bins_of(stem, 0.3, &fine), bins_of(stem, 0.7, &noisy));
    let model = TabulatedModel::new(&[high.clone(), low.clone()]).unwrap();
    assert_eq!(model, TabulatedModel::new(&[low, high]).unwrap());
    assert_eq!(model.radii().len(), fine.len());
    assert_eq!(model.knots().count(), 2 * fine.len());
    assert_eq!(model.surface_albedos().collect::<Vec<_>>(), [0.3, 0.7]);
}

#[test]
fn what_makes_no_model_says_why() {
    use TabulatedError as E;
    let table = |a| bins_of("burley_searchlight", a, &edges(5, 5.0));
    let refuse = |data: &[RadialData]| TabulatedModel::new(data).unwrap_err();
    assert_eq!(refuse(&[]), E::NoData);
    assert_eq!(
        refuse(&[table(0.5), table(0.2), table(0.5)]),
        E::RepeatedSurfaceAlbedo { surface_albedo: 0.5 }
    );
    let rows = |rows: &[RadialRow]| RadialData::new(0.5, rows.to_vec()).unwrap();
    let gap = rows(&[RadialRow::bin(0.0, 1.0, 1.0), RadialRow::bin(1.5, 2.0, 1.0)]);
    assert_eq!(refuse(&[gap]), E::Gap { surface_albedo: 0.5, row: 1, from: 1.0, to: 1.5 });
    let late = rows(&[RadialRow::bin(0.5, 1.0, 1.0), RadialRow::bin(1.0, 2.0, 1.0)]);
    assert_eq!(refuse(&[late]), E::Gap { surface_albedo: 0.5, row: 0, from: 0.0, to: 0.5 });
    let close =
        rows(&[RadialRow::point(0.0, 1.0), RadialRow::point(1.0, 1.0), RadialRow::point(1.0 + 1e-9, 1.0)]);
    assert!(matches!(refuse(&[close]), E::TooClose { row: 2, .. }));
    let narrow = rows(&[RadialRow::bin(0.0, 1.0, 1.0), RadialRow::bin(1.0, 1.0 + 1e-7, 1.0)]);
    assert!(matches!(refuse(&[narrow]), E::TooClose { row: 1, .. }));
    // 600 surface albedos, each with 599 radii of its own.
    let many: Vec<RadialData> = (1..=600)
        .map(|n| {
            let a = f64::from(n) / 600.0;
            let values = vec![1.0; 599];
            histogram(a, &edges(599, 5.0 + a), &values)
        })
        .collect();
    assert!(matches!(refuse(&many), E::TooLarge { surface_albedos: 600, .. }));
}

proptest! {
    /// Any histogram gives a whole profile.
    #[test]
    fn any_histogram_obeys_the_laws(
        widths in prop::collection::vec(-3.0..3.0f64, 2..20),
        values in prop::collection::vec(prop_oneof![Just(0.0), -6.0..6.0f64], 20),
        u in 0.0..1.0f64,
    ) {
        let mut edges = vec![0.0];
        for width in &widths {
            edges.push(edges[edges.len() - 1] + 10f64.powf(*width));
        }
        let values: Vec<f64> = values.iter().map(|v| if *v == 0.0 { 0.0 } else { 10f64.powf(*v) }).collect();
        let bins = edges.windows(2).zip(&values).map(|(ends, value)| RadialRow::bin(ends[0], ends[1], *value));
        let Ok(data) = RadialData::new(0.5, bins.collect()) else { return Ok(()) };
        // A narrow bin far out is refused.
        let Ok(model) = TabulatedModel::new(&[data]) else { return Ok(()) };
        let profile = model.profile(Medium::new(0.5, 1.0).unwrap()).unwrap();
        let r = profile.sample_radius(u);
        // A few roundings of r times the density, which is at most 3 over the width of the narrowest bin.
        let narrowest = widths.iter().copied().fold(3.0, f64::min);
        let bound = 1e-13 + 12.0 * f64::EPSILON * r / 10f64.powf(narrowest);
        prop_assert!((profile.radial_cdf(r) - u).abs() < bound, "{} at u = {u}", profile.radial_cdf(r));
        prop_assert!(profile.radial_pdf(r) >= 0.0);
        prop_assert!((profile.radial_cdf(r) + profile.radial_tail(r) - 1.0).abs() < 1e-13);
    }

    /// Whatever the numbers, there is a model or an error, never a panic, and never NaN.
    #[test]
    fn no_numbers_panic(values in prop::collection::vec(prop::num::f64::ANY, 8), albedos in prop::collection::vec(prop::num::f64::ANY, 2)) {
        let mut data = Vec::new();
        for (rows, surface_albedo) in values.chunks(4).zip(&albedos) {
            let mut radii: Vec<f64> = rows[..2].iter().map(|r| r.abs()).collect();
            radii.sort_by(f64::total_cmp);
            let points = vec![RadialRow::point(radii[0], rows[2].abs()), RadialRow::point(radii[1], rows[3].abs())];
            let bins = vec![RadialRow::bin(0.0, radii[0], rows[2].abs()), RadialRow::bin(radii[0], radii[1], rows[3].abs())];
            let raw = vec![RadialRow::bin(rows[0], rows[1], rows[2]), RadialRow::point(rows[1], rows[3])];
            let albedo = surface_albedo.abs().fract();
            for rows in [points, bins, raw] {
                data.extend(RadialData::new(albedo, rows));
            }
        }
        for data in data.chunks(1).chain([&data[..]]) {
            let Ok(model) = TabulatedModel::new(data) else { continue };
            let medium = Medium::new(0.5, 1.0).unwrap();
            let Ok(profile) = model.profile(medium) else { continue };
            for x in [0.0, 1e-300, 0.5, 1.0, 1e300] {
                let (r, cdf) = (profile.sample_radius(x), profile.radial_cdf(x));
                prop_assert!(r.is_finite() && (0.0..=1.0).contains(&cdf), "{profile:?}: {r}, {cdf}");
                prop_assert!(!profile.radial_pdf(x).is_nan() && !profile.area_pdf(x).is_nan(), "{profile:?}");
            }
        }
    }
}
