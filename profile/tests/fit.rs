//! Fits recover what data were made from, and improve on where they start.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::f64::consts::PI;

use proptest::prelude::*;
use subsurface_profile::fit::{
    Criterion, Crop, Family, Fit, FitError, Measure, Options, Stop, Weighting, fit,
};
use subsurface_profile::{
    BurleyModel, Channel, ExponentialDipoleModel, GaussianSumModel, GaussianTerm, Medium, Model,
    PolynomialModel, RadialData, RadialRow, TabulatedModel, l1,
};

const SURFACE_ALBEDOS: [f64; 7] = [0.05, 0.2, 0.4, 0.6, 0.8, 0.9, 0.97];

/// Bins of a model's own profile at mean free path 1, growing with the radius up to 30.
fn bins_of(model: &Model, surface_albedo: f64) -> RadialData {
    let profile = model.profile(Medium::new(surface_albedo, 1.0).unwrap(), Channel::Red).unwrap();
    let edge = |bin: i32| 30.0 * (f64::from(bin) / 60.0).powi(3);
    let rows = (0..60).map(|bin| {
        let (r_lo, r_hi) = (edge(bin), edge(bin + 1));
        let energy = surface_albedo * (profile.radial_tail(r_lo) - profile.radial_tail(r_hi));
        let r_reflectance = energy / (2.0 * PI * (r_hi - r_lo));
        RadialRow {
            standard_error: Some(0.01 * r_reflectance + 1e-9),
            ..RadialRow::bin(r_lo, r_hi, r_reflectance)
        }
    });
    RadialData::new(surface_albedo, rows.collect()).unwrap()
}

fn all_of(model: &Model) -> Vec<RadialData> {
    SURFACE_ALBEDOS.map(|a| bins_of(model, a)).to_vec()
}

/// Largest distance of the densities of two models over some data, as an L1.
fn greatest_l1(model: &Model, data: &[RadialData]) -> f64 {
    let of = |data: &RadialData| {
        let medium = Medium::new(data.surface_albedo(), 1.0).unwrap();
        l1(&*model.profile(medium, Channel::Red).unwrap(), data)
    };
    data.iter().map(of).fold(0.0, f64::max)
}

/// A model near `model`: every coefficient off by 2 %.
fn nearby(model: &Model) -> Model {
    let values: Vec<f64> = model.parameters().iter().map(|parameter| 1.02 * parameter.value).collect();
    model.with_parameters(&values).unwrap()
}

fn family(name: &str) -> Family {
    Family::from_name(name).unwrap()
}

fn gaussians() -> Model {
    let term = |variance_mm2, weight| GaussianTerm { variance_mm2, weight: [weight; 3] };
    Model::GaussianSum(GaussianSumModel { terms: vec![term(0.05, 0.5), term(0.8, 0.3), term(9.0, 0.2)] })
}

#[test]
fn a_model_is_recovered_from_its_own_data() {
    for model in [
        Model::Burley(BurleyModel::SEARCHLIGHT),
        Model::Burley(BurleyModel::DIFFUSE),
        Model::ExponentialDipole(ExponentialDipoleModel::SEARCHLIGHT),
        Model::ExponentialDipole(ExponentialDipoleModel::DIFFUSE),
        Model::Polynomial(PolynomialModel::LIANG_2023),
        gaussians(),
    ] {
        let data = all_of(&model);
        let fitted = fit(&nearby(&model), &data, &Options::default()).unwrap();
        assert!(fitted.stop.converged(), "{model:?}: {}", fitted.stop);
        assert!(fitted.cost < 1e-12 * fitted.cost_at_start, "{model:?}: {} left", fitted.cost);
        // Central differences are good to 1e-10, which LM's last steps make up for; measured below 1e-8.
        assert!(greatest_l1(&fitted.model, &data) < 1e-6, "{model:?}: {:?}", fitted.tables);
        // Where the coefficients can be told apart, they are those. (The polynomial's eleven cannot well.)
        if matches!(model, Model::ExponentialDipole(_) | Model::GaussianSum(_)) {
            for (found, given) in fitted.model.parameters().iter().zip(model.parameters()) {
                assert!((found.value - given.value).abs() < 1e-4, "{found:?}, not {given:?}");
            }
        }
    }
}

#[test]
fn every_family_improves_on_its_start() {
    // The exponential + dipole stands for the truth, which it is to 1.25 % (searchlight).
    let truth = Model::ExponentialDipole(ExponentialDipoleModel::DIFFUSE);
    let data = all_of(&truth);
    for family in Family::all() {
        let name = family.name();
        let start = family.start(&data);
        let fitted = fit(&start, &data, &Options::default()).unwrap();
        assert!(fitted.cost < 0.9 * fitted.cost_at_start, "{name}: {fitted:?}");
        assert_eq!(fitted.free.len(), start.parameters().len(), "{name}: all are free");
        assert_eq!(fitted.tables.len(), data.len());
    }
    assert_eq!(Family::from_name("Burley"), None);
}

#[test]
fn one_surface_albedo_frees_the_constant_terms() {
    let truth = Model::ExponentialDipole(ExponentialDipoleModel::SEARCHLIGHT);
    let data = [bins_of(&truth, 0.7)];
    for (name, free, bound) in [
        ("burley", vec!["shape.constant"], 0.2),
        ("polynomial", vec!["a.linear", "b.scale", "c.offset"], 0.2),
        (
            "exponential_dipole",
            vec![
                "exponential_weight[0]",
                "exponential_length[0]",
                "dipole_depth[0]",
                "dipole_attenuation[0]",
            ],
            1e-6,
        ),
        (
            "two_exponential_dipole",
            vec![
                "exponential_weight[0]",
                "exponential_length[0]",
                "dipole_depth[0]",
                "dipole_attenuation[0]",
                "short_weight",
                "short_length",
                "second_weight",
                "second_depth",
            ],
            // The other family is a member of this one, but the start has another shape.
            0.01,
        ),
    ] {
        let family = Family::from_name(name).unwrap();
        let fitted = fit(&family.start(&data), &data, &Options::default()).unwrap();
        assert_eq!(fitted.free, free);
        assert!(fitted.tables[0].l1 < bound, "{name}: {:?}", fitted.tables);
        // The result does not depend on A, so that it is legal at every A.
        for surface_albedo in [0.01, 0.5, 0.99] {
            let medium = Medium::new(surface_albedo, 1.0).unwrap();
            assert!(fitted.model.profile(medium, Channel::Red).is_ok(), "{name} at {surface_albedo}");
        }
    }
}

#[test]
fn a_few_surface_albedos_free_as_many_terms() {
    let truth = Model::ExponentialDipole(ExponentialDipoleModel::SEARCHLIGHT);
    let data = [bins_of(&truth, 0.3), bins_of(&truth, 0.7)];
    let fitted = fit(&nearby(&truth), &data, &Options::default()).unwrap();
    assert_eq!(fitted.free.len(), 8);
    assert!(fitted.free.iter().all(|name| name.ends_with("[0]") || name.ends_with("[1]")), "{fitted:?}");
}

#[test]
fn each_criterion_makes_its_own_measure_small() {
    let truth = Model::ExponentialDipole(ExponentialDipoleModel::SEARCHLIGHT);
    let data = [bins_of(&truth, 0.6)];
    let start = family("burley").start(&data);
    let with = |criterion, weighting| {
        fit(&start, &data, &Options { criterion, weighting, ..Options::default() }).unwrap()
    };
    let shape = |fitted: &Fit| fitted.model.parameters()[0].value;
    let mut shapes = Vec::new();
    for criterion in [
        Criterion::LeastSquares(Measure::RReflectance),
        Criterion::LeastSquares(Measure::Cdf),
        Criterion::RelativeError,
        Criterion::Logarithm,
    ] {
        for weighting in [Weighting::Row, Weighting::Radius, Weighting::StandardError] {
            let fitted = with(criterion, weighting);
            assert!(
                fitted.stop.converged() && fitted.cost <= fitted.cost_at_start,
                "{criterion:?}: {fitted:?}"
            );
            shapes.push(shape(&fitted));
            // It is a minimum: the same cost function is higher on both sides, as a refit from there shows.
            let from_there =
                fit(&fitted.model, &data, &Options { criterion, weighting, ..Options::default() });
            assert!(
                (from_there.unwrap().cost / fitted.cost - 1.0).abs() < 1e-9,
                "{criterion:?} {weighting:?}"
            );
        }
    }
    // One coefficient cannot serve all: r·R and relative errors disagree by more than a tenth.
    let spread =
        shapes.iter().fold(0.0, |m, s| f64::max(m, *s)) - shapes.iter().fold(9.0, |m, s| f64::min(m, *s));
    assert!(spread > 0.1, "{shapes:?}");
}

#[test]
fn a_relative_fit_is_better_in_the_tail_and_cropping_leaves_the_tail_out() {
    let truth = Model::ExponentialDipole(ExponentialDipoleModel::SEARCHLIGHT);
    let data = [bins_of(&truth, 0.8)];
    let start = family("burley").start(&data);
    let relative = Options { criterion: Criterion::Logarithm, ..Options::default() };
    let far = |model: &Model| {
        let profile = model.profile(Medium::new(0.8, 1.0).unwrap(), Channel::Red).unwrap();
        subsurface_profile::mean_relative_error(&*profile, &data[0], [10.0, 20.0])
    };
    let (absolute, relative) = (
        fit(&start, &data, &Options::default()).unwrap().model,
        fit(&start, &data, &relative).unwrap().model,
    );
    assert!(far(&relative) < far(&absolute), "{} and {}", far(&relative), far(&absolute));
    let cropped =
        fit(&start, &data, &Options { crop: Some(Crop::LIANG_2023), ..Options::default() }).unwrap();
    let end = cropped.tables[0].cropped_at.unwrap();
    // The data fall to 0.5 % of r·R(0) at 15.6 mean free paths.
    assert_eq!(end, 16.0);
    assert!(cropped.tables[0].rows < 60 && cropped.tables[0].rows > 10, "{:?}", cropped.tables);
}

#[test]
fn a_fit_is_the_same_every_time() {
    let data = all_of(&Model::ExponentialDipole(ExponentialDipoleModel::DIFFUSE));
    for family in Family::all() {
        let (name, start) = (family.name(), family.start(&data));
        let run = || {
            let fitted = fit(&start, &data, &Options::default()).unwrap();
            fitted.model.parameters().iter().map(|p| p.value.to_bits()).collect::<Vec<_>>()
        };
        assert_eq!(run(), run(), "{name}");
    }
}

#[test]
fn names_and_values_of_coefficients_correspond() {
    for stem in Model::PUBLISHED {
        let model = Model::published(stem).unwrap();
        let parameters = model.parameters();
        let values: Vec<f64> = parameters.iter().map(|parameter| parameter.value).collect();
        assert!(!values.is_empty() && model.with_parameters(&values[1..]).is_none(), "{stem}");
        if !model.dependence().on_channel() {
            assert_eq!(model.with_parameters(&values), Some(model.clone()), "{stem}");
        }
        // The names are those that errors use.
        let nan = model.with_parameters(&vec![f64::NAN; values.len()]).unwrap();
        for error in nan.errors() {
            let text = error.to_string();
            assert!(parameters.iter().any(|p| text.contains(&p.name)), "{stem}: {text}");
        }
    }
}

#[test]
fn what_cannot_be_fitted_says_why() {
    let truth = Model::Burley(BurleyModel::SEARCHLIGHT);
    let data = [bins_of(&truth, 0.5)];
    let options = Options::default();
    assert_eq!(fit(&truth, &[], &options), Err(FitError::NoData));
    let table = Model::Tabulated(TabulatedModel::new(&data).unwrap());
    assert_eq!(fit(&table, &data, &options), Err(FitError::NoCoefficients));
    assert_eq!(fit(&truth, &data, &Options { patience: 0, ..options }), Err(FitError::NoPatience));
    let crop = Some(Crop { threshold: 2.0 });
    assert_eq!(
        fit(&truth, &data, &Options { crop, ..options }),
        Err(FitError::CropOutOfRange { threshold: 2.0 })
    );
    let two = RadialData::new(0.5, data[0].rows()[..2].to_vec()).unwrap();
    let six = family("gaussian_sum").with_terms(3).unwrap().start(&data);
    assert_eq!(
        fit(&six, std::slice::from_ref(&two), &options),
        Err(FitError::TooFewRows { rows: 2, coefficients: 6 })
    );
    let unknown =
        RadialData::new(0.5, vec![RadialRow::bin(0.0, 1.0, 1.0), RadialRow::bin(1.0, 2.0, 0.5)]).unwrap();
    let by_error = Options { weighting: Weighting::StandardError, ..options };
    assert_eq!(
        fit(&truth, &[unknown], &by_error),
        Err(FitError::NoStandardError { surface_albedo: 0.5, row: 0 })
    );
    let mut bad = BurleyModel::SEARCHLIGHT;
    bad.shape.constant = -10.0;
    assert!(matches!(fit(&Model::Burley(bad), &data, &options), Err(FitError::NoProfile { .. })));
    bad.shape.constant = f64::NAN;
    assert!(matches!(fit(&Model::Burley(bad), &data, &options), Err(FitError::NoProfile { .. })));
}

#[test]
fn impatience_and_bounds_are_no_convergence() {
    let data = all_of(&Model::ExponentialDipole(ExponentialDipoleModel::SEARCHLIGHT));
    let start = family("polynomial").start(&data);
    let impatient = fit(&start, &data, &Options { patience: 1, ..Options::default() }).unwrap();
    assert_eq!(impatient.stop, Stop::Patience);
    assert!(impatient.cost <= impatient.cost_at_start);

    // Light that leaves in a ring: no exponential near the entry, whose weight cannot fall below 0.
    let ring = (0..20).map(|bin| {
        let r = f64::from(bin) * 0.5;
        RadialRow::bin(r, r + 0.5, if bin == 8 { 0.1 } else { 1e-6 })
    });
    let ring = [RadialData::new(0.5, ring.collect()).unwrap()];
    let fitted = fit(&family("exponential_dipole").start(&ring), &ring, &Options::default()).unwrap();
    assert!(matches!(fitted.stop, Stop::Bound { .. }), "{}", fitted.stop);
    assert!(fitted.cost <= fitted.cost_at_start);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, ..ProptestConfig::default() })]

    /// Whatever the data, the answer is defined: a fit that is no worse than its start, or an error.
    #[test]
    fn any_data_have_an_answer(
        values in prop::collection::vec(prop_oneof![Just(0.0), -9.0..9.0f64], 12),
        surface_albedo in 0.001..1.0f64,
        family in prop::sample::select(Family::all().collect::<Vec<_>>()),
        criterion in prop::sample::select(vec![
            Criterion::LeastSquares(Measure::RadialDensity),
            Criterion::LeastSquares(Measure::Cdf),
            Criterion::RelativeError,
            Criterion::Logarithm,
        ]),
    ) {
        let rows = (0..12).zip(&values).map(|(bin, value)| {
            let r = f64::from(bin) * 0.3;
            RadialRow::bin(r, r + 0.3, if *value == 0.0 { 0.0 } else { 10f64.powf(*value) })
        });
        let Ok(data) = RadialData::new(surface_albedo, rows.collect()) else { return Ok(()) };
        let start = family.start(std::slice::from_ref(&data));
        let options = Options { criterion, patience: 20, ..Options::default() };
        if let Ok(fitted) = fit(&start, &[data], &options) {
            prop_assert!(fitted.cost <= fitted.cost_at_start, "{fitted:?}");
            prop_assert!(fitted.model.parameters().iter().all(|p| p.value.is_finite()), "{fitted:?}");
        }
    }
}
