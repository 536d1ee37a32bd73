//! Laws that hold for every published model over the whole domain, ends included.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::f64::consts::PI;

use proptest::prelude::*;
use subsurface_profile::description::Dependence;
use subsurface_profile::quadrature::Quadrature;
use subsurface_profile::{
    BurleyModel, BurleyShape, Channel, DipoleModel, ExponentialDipoleModel, GaussianSumModel, GaussianTerm,
    Length, Medium, MixtureModel, MixturePart, Model, ModelKind, PolynomialA, PolynomialB, PolynomialC,
    PolynomialModel, RadialProfile, TwoExponentialDipoleModel,
};

/// Both ends, their neighbourhoods, and the range between in steps of 0.05.
fn surface_albedos() -> impl Iterator<Item = f64> {
    let grid = (1..=19).map(|step| f64::from(step) * 0.05);
    [0.0, 1e-300, 1e-6, 1e-3].into_iter().chain(grid).chain([0.999, 1.0])
}

const LENGTHS_MM: [f64; 3] = [1e-4, 1.0, 1e4];

/// Fractions of the energy from 0 to the last number below 1.
const FRACTIONS: [f64; 21] = [
    0.0,
    1e-300,
    1e-30,
    1e-12,
    1e-6,
    1e-3,
    0.01,
    0.1,
    0.3,
    0.499_999,
    0.5,
    0.500_001,
    0.7,
    0.9,
    0.99,
    0.999,
    1.0 - 1e-6,
    1.0 - 1e-9,
    1.0 - 1e-12,
    1.0 - 1e-15,
    1.0 - f64::EPSILON / 2.0,
];

/// One profile and where it came from.
struct Case {
    name: String,
    model: Model,
    surface_albedo: f64,
    mean_free_path_mm: f64,
    channel: Channel,
    profile: Box<dyn RadialProfile>,
}

impl Case {
    fn new(stem: &str, surface_albedo: f64, mean_free_path_mm: f64, channel: Channel) -> Case {
        let model = Model::published(stem).unwrap();
        let profile =
            model.profile(Medium::new(surface_albedo, mean_free_path_mm).unwrap(), channel).unwrap();
        let name = format!("{stem}, A = {surface_albedo}, length {mean_free_path_mm} mm, {channel}");
        Case { name, model, surface_albedo, mean_free_path_mm, channel, profile }
    }

    /// Radii in mm from 0 to far out, most of them where the energy is.
    fn radii(&self) -> Vec<f64> {
        FRACTIONS.iter().map(|u| self.profile.sample_radius(*u)).collect()
    }
}

/// Every published model over the whole domain.
fn domain() -> impl Iterator<Item = Case> {
    Model::PUBLISHED.into_iter().flat_map(|stem| {
        // Where channels do not differ, one says it all.
        let dependence = Model::published(stem).unwrap().dependence();
        let channels = if dependence.on_channel() { &Channel::ALL[..] } else { &Channel::ALL[..1] };
        channels.iter().flat_map(move |channel| {
            surface_albedos()
                .flat_map(move |a| LENGTHS_MM.into_iter().map(move |l| Case::new(stem, a, l, *channel)))
        })
    })
}

#[test]
fn coefficients_are_valid_and_stems_are_known() {
    for stem in Model::PUBLISHED {
        assert_eq!(Model::published(stem).unwrap().validate(), Ok(()), "{stem}");
    }
    assert_eq!(Model::published("Burley_searchlight"), None);
}

#[test]
fn a_profile_depends_on_what_its_model_says() {
    for stem in Model::PUBLISHED {
        let dependence = Model::published(stem).unwrap().dependence();
        let cdf = |surface_albedo, mean_free_path_mm, channel| {
            Case::new(stem, surface_albedo, mean_free_path_mm, channel).profile.radial_cdf(0.4)
        };
        let [red, green, blue] = Channel::ALL.map(|channel| cdf(0.5, 1.0, channel));
        assert_eq!(red == green && green == blue, !dependence.on_channel(), "{stem}");
        assert_eq!(red == cdf(0.5, 2.0, Channel::Red), !dependence.on_length(), "{stem}");
        assert_eq!(red == cdf(0.9, 1.0, Channel::Red), !dependence.on_length(), "{stem}");
    }
}

#[test]
fn every_model_describes_itself() {
    let kinds = ModelKind::ALL;
    let stems: Vec<&str> = kinds.iter().flat_map(|kind| kind.published()).map(|set| set.stem).collect();
    assert_eq!(stems, Model::PUBLISHED);
    for kind in kinds {
        let description = kind.description();
        assert_eq!(ModelKind::named(description.name), Some(*kind));
        assert_eq!(ModelKind::of_stem(description.stem), Some(*kind));
        assert!(description.example.starts_with(description.name), "{kind:?}");
        for set in kind.published() {
            assert_eq!((set.kind, set.model.kind()), (*kind, *kind));
            assert_eq!(set.model.functions_at(0.5).len(), kind.functions().len(), "{}", set.stem);
        }
        // Each field is visited, holds as many numbers as it says, and is written where it is read.
        let Some(mut blank) = kind.blank(2) else { continue };
        let mut visited = Vec::new();
        let mut number = 0.0;
        blank.visit(&mut |slot| {
            assert_eq!(slot.values.len(), slot.field.values.count(), "{}", slot.path());
            for value in slot.values.iter_mut() {
                number += 1.0;
                *value = number;
            }
            visited.push(slot.field.path);
        });
        let fields: Vec<&str> = kind.fields().iter().map(|field| field.path).collect();
        assert_eq!(visited.len() % fields.len(), 0, "{kind:?}");
        assert!(visited.chunks(fields.len()).all(|term| *term == fields[..]), "{kind:?}");
        let mut read = Vec::new();
        blank.visit(&mut |slot| read.extend_from_slice(slot.values));
        assert!(read.iter().zip(1..).all(|(value, number)| *value == f64::from(number)), "{read:?}");
    }
}

#[test]
fn the_cdf_is_the_integral_of_the_pdf_and_reaches_one() {
    for case in domain() {
        let profile = &case.profile;
        let mut radii = case.radii();
        radii.dedup();
        let mut integral = 0.0;
        for ends in radii.windows(2) {
            let part = Quadrature::default().integrate(|r| profile.radial_pdf(r), ends[0], ends[1]);
            let by_cdf = profile.radial_cdf(ends[1]) - profile.radial_cdf(ends[0]);
            let by_tail = profile.radial_tail(ends[0]) - profile.radial_tail(ends[1]);
            // Quadrature stops at 1e-13 or 1e-11 of the part; each cdf is rounded once near 1.
            assert!((part - by_cdf).abs() < 1e-12, "{}: {part} and {by_cdf} over {ends:?}", case.name);
            assert!((part - by_tail).abs() < 1e-12, "{}: {part} and {by_tail} over {ends:?}", case.name);
            integral += part;
        }
        // The last radius leaves out 2⁻⁵³.
        assert!((integral - 1.0).abs() < 1e-11, "{}: {integral}", case.name);
    }
}

#[test]
fn the_radial_pdf_is_the_derivative_of_the_cdf() {
    for case in domain() {
        for r in &case.radii()[3..] {
            let h = 1e-4 * r;
            let p = &case.profile;
            // Differences of the smaller of cdf and tail keep their digits.
            let difference = if p.radial_cdf(*r) < 0.5 {
                p.radial_cdf(r + h) - p.radial_cdf(r - h)
            } else {
                p.radial_tail(r - h) - p.radial_tail(r + h)
            };
            let pdf = p.radial_pdf(*r);
            // The error of a central difference is (h²/6) pdf″. Its scale: out to r = 100 decay lengths
            // h is 0.01 of one, so 1e-4/6 of the pdf, twice that for a Gaussian; the polynomial has a kink at
            // its r_max, where pdf itself is 1e-16 of its maximum.
            let kink = p.max_radius().is_some_and(|end| (end - r).abs() < 2.0 * h);
            let bound = 1e-4 * pdf + 1e-12 / r;
            assert!(kink || (difference / (2.0 * h) - pdf).abs() <= bound, "{} at {r}", case.name);
        }
    }
}

#[test]
fn the_radial_pdf_is_2_pi_r_times_the_area_pdf() {
    for case in domain() {
        // From the fraction 1e-30 on: at 1e-300 the pole of 1/(r l) leaves the range of numbers.
        for r in &case.radii()[2..] {
            let (radial, area) = (case.profile.radial_pdf(*r), case.profile.area_pdf(*r));
            assert!(area.is_finite() && area >= 0.0, "{} at {r}: {area}", case.name);
            // A handful of roundings.
            assert!((2.0 * PI * r * area - radial).abs() <= 1e-14 * radial, "{} at {r}", case.name);
        }
    }
}

#[test]
fn the_cdf_is_monotone_and_within_0_and_1() {
    for case in domain() {
        let p = &case.profile;
        assert_eq!(p.radial_cdf(0.0), 0.0, "{}", case.name);
        let median = p.sample_radius(0.5);
        let (mut cdf, mut tail) = (0.0, 1.0);
        for step in -400..=400 {
            let r = median * 10f64.powf(f64::from(step) / 20.0);
            let (next_cdf, next_tail) = (p.radial_cdf(r), p.radial_tail(r));
            assert!(
                (0.0..=1.0).contains(&next_cdf) && (0.0..=1.0).contains(&next_tail),
                "{} at {r}",
                case.name
            );
            // Where the curve is flat to the last place, the exponentials of the system library may step back
            // by one unit in it, once per term.
            assert!(next_cdf >= cdf - 1e-15, "{} at {r}: {next_cdf} after {cdf}", case.name);
            assert!(next_tail <= tail + 1e-15, "{} at {r}: {next_tail} after {tail}", case.name);
            assert!((next_cdf + next_tail - 1.0).abs() < 2e-15, "{} at {r}", case.name);
            (cdf, tail) = (next_cdf, next_tail);
        }
    }
}

#[test]
fn sampling_inverts_the_cdf() {
    for case in domain() {
        let p = &case.profile;
        for u in FRACTIONS {
            let r = p.sample_radius(u);
            let there = p.radial_cdf(r);
            // Relative for small u: a radius is solved to a few ulps, and dlog(cdf)/dlog(r) ≤ 2.
            assert!((there - u).abs() <= 1e-13 * u, "{} at u = {u}: {there}", case.name);
            // And relative for small 1 - u: one rounding of r is multiplied by r times the hazard rate, at most
            // 73 at the last u for a Gaussian. The polynomial ends at r_max, from which r has to be subtracted,
            // and its tail falls with the square of that distance: √q of 1 - u is left, so 2 ε/√q is lost.
            let q = 1.0 - u;
            let bound = if p.max_radius().is_some() { 1e-13 + 20.0 * f64::EPSILON / q.sqrt() } else { 1e-13 };
            assert!(
                (p.radial_tail(r) - q).abs() <= bound * q,
                "{} at 1 - u = {q}: {}",
                case.name,
                p.radial_tail(r)
            );
        }
    }
}

#[test]
fn samples_begin_at_0_increase_and_stay_finite() {
    for case in domain() {
        let p = &case.profile;
        assert_eq!(p.sample_radius(0.0), 0.0, "{}", case.name);
        let mut last = 0.0;
        for u in FRACTIONS {
            let r = p.sample_radius(u);
            assert!(r >= last && r.is_finite(), "{} at u = {u}: {r} after {last}", case.name);
            last = r;
        }
        for beyond in [1.0, 2.0, f64::INFINITY] {
            assert_eq!(p.sample_radius(beyond), last, "{}: u = {beyond} is clamped", case.name);
        }
        assert_eq!(p.sample_radius(-1.0), 0.0, "{}", case.name);
        assert_eq!(p.filter_radius(0.9), p.sample_radius(0.9), "{}", case.name);
        if let Some(end) = p.max_radius() {
            assert!(last <= end, "{}: {last} beyond {end}", case.name);
            assert_eq!(
                (p.radial_cdf(end), p.radial_pdf(end), p.area_pdf(end)),
                (1.0, 0.0, 0.0),
                "{}",
                case.name
            );
            assert_eq!(p.radial_pdf(2.0 * end), 0.0, "{}", case.name);
        }
    }
}

#[test]
fn a_profile_scales_with_its_length() {
    for case in domain().filter(|case| case.model.dependence() == Dependence::Medium) {
        let l = case.mean_free_path_mm;
        let unit = case.model.profile(Medium::new(case.surface_albedo, 1.0).unwrap(), case.channel).unwrap();
        for r in &case.radii()[2..] {
            // R_l(r) = R₁(r/l)/l². One rounding of r/l is multiplied by at most 40 decay lengths; at the end of
            // the polynomial it is one of r_max.
            let slack = unit.max_radius().map_or(0.0, |end| 1e-15 / (1.0 - r / l / end).abs());
            let (here, there) = (case.profile.area_pdf(*r), unit.area_pdf(r / l) / (l * l));
            assert!((here - there).abs() <= (1e-13 + slack) * there, "{} at {r}", case.name);
            assert!(
                (case.profile.radial_cdf(*r) - unit.radial_cdf(r / l)).abs() < 1e-15,
                "{} at {r}",
                case.name
            );
        }
    }
}

#[test]
fn transmittance_falls_from_the_surface_albedo_to_0() {
    for case in domain() {
        let p = &case.profile;
        assert_eq!(p.surface_albedo(), case.surface_albedo);
        let mut last = p.transmittance(0.0);
        // The weights of the terms sum to 1 up to rounding.
        assert!((last - case.surface_albedo).abs() <= 1e-15 * case.surface_albedo, "{}: {last}", case.name);
        for thickness in &case.radii()[6..] {
            let next = p.transmittance(*thickness);
            assert!(next < last || case.surface_albedo == 0.0 && next == 0.0, "{} at {thickness}", case.name);
            last = next;
        }
        assert!(p.transmittance(f64::INFINITY) < 1e-16, "{}", case.name);
    }
}

#[test]
fn transmittance_is_the_profile_seen_through_a_slab() {
    // ∫ R(√(r² + t²)) 2πr dr, integrated without the substitution that the model uses.
    for case in domain().filter(|case| case.mean_free_path_mm == 1.0 && case.surface_albedo > 0.0) {
        for thickness in [0.03, 0.4, 2.0] {
            let mut radii = case.radii();
            radii.truncate(17);
            radii.extend(
                case.profile.max_radius().map(|end| (end * end - thickness * thickness).max(0.0).sqrt()),
            );
            radii.sort_by(f64::total_cmp);
            let seen = case.surface_albedo
                * Quadrature::default().integrate_between(
                    |r| case.profile.area_pdf(f64::hypot(r, thickness)) * 2.0 * PI * r,
                    &radii,
                );
            let transmittance = case.profile.transmittance(thickness);
            // The range holds all but 1e-6 of the energy.
            assert!(
                (seen - transmittance).abs() < 2e-6,
                "{} at {thickness}: {seen}, {transmittance}",
                case.name
            );
        }
    }
}

#[test]
fn radii_that_are_no_radii_have_a_defined_result() {
    for case in domain() {
        let p = &case.profile;
        for (name, f) in [
            ("area_pdf", &(|r| p.area_pdf(r)) as &dyn Fn(f64) -> f64),
            ("radial_pdf", &|r| p.radial_pdf(r)),
            ("radial_cdf", &|r| p.radial_cdf(r)),
            ("radial_tail", &|r| p.radial_tail(r)),
            ("transmittance", &|r| p.transmittance(r)),
            ("sample_radius", &|u| p.sample_radius(u)),
        ] {
            assert!(f(f64::NAN).is_nan(), "{}: {name}(NaN)", case.name);
            for below in [-0.0, -1e-300, -1.0, f64::NEG_INFINITY] {
                assert_eq!(f(below).to_bits(), f(0.0).to_bits(), "{}: {name}({below})", case.name);
            }
        }
        assert!(p.radial_pdf(0.0).is_finite(), "{}", case.name);
        assert!(p.area_pdf(0.0) > 0.0, "{}", case.name);
        for far in [1e300, f64::MAX, f64::INFINITY] {
            assert!(p.area_pdf(far) < 1e-290, "{}: area_pdf({far}) = {}", case.name, p.area_pdf(far));
            assert!(p.radial_pdf(far) < 1e-290, "{}: radial_pdf({far}) = {}", case.name, p.radial_pdf(far));
            assert!((p.radial_cdf(far) - 1.0).abs() < 1e-15, "{}: radial_cdf({far})", case.name);
            assert!(p.radial_tail(far) < 1e-290, "{}: radial_tail({far})", case.name);
        }
    }
}

#[test]
fn samples_follow_the_cdf() {
    const SAMPLES: u32 = 20_000;
    const BINS: usize = 40;
    let some = [0.0, 0.5, 0.95, 1.0];
    for case in domain().filter(|case| case.mean_free_path_mm == 1.0 && some.contains(&case.surface_albedo)) {
        let p = &case.profile;
        // Bins of equal width in the logarithm of the radius, not of equal probability, so that the expected
        // counts come from the cdf and not from the inverse under test.
        let (near, far) = (p.sample_radius(0.01), p.sample_radius(0.99));
        let edges: Vec<f64> =
            (0..=BINS).map(|bin| near * (far / near).powf(bin as f64 / BINS as f64)).collect();
        let mut counts = [0u32; BINS + 2];
        // Knuth's MMIX generator, its upper 53 bits.
        let mut state = 0x853c_49e6_748f_ea9b_u64;
        for _ in 0..SAMPLES {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let u = (state >> 11) as f64 * f64::EPSILON / 2.0;
            let r = p.sample_radius(u);
            counts[edges.partition_point(|edge| *edge <= r)] += 1;
        }
        let mut cdfs = vec![0.0];
        cdfs.extend(edges.iter().map(|edge| p.radial_cdf(*edge)));
        cdfs.push(1.0);
        let chi_squared: f64 = counts
            .iter()
            .zip(cdfs.windows(2))
            .map(|(count, ends)| {
                let expected = f64::from(SAMPLES) * (ends[1] - ends[0]);
                (f64::from(*count) - expected).powi(2) / expected
            })
            .sum();
        // 41 degrees of freedom, standard deviation √82 = 9.1. Four deviations above the mean are exceeded by one
        // draw in 1800; each profile sorts the same numbers into bins of its own, so this is some 40 draws of a
        // fixed seed. A density wrong by ±5 % would add 20 000·0.05² = 50.
        assert!(chi_squared < 41.0 + 4.0 * 82f64.sqrt(), "{}: {chi_squared}", case.name);
    }
}

proptest! {
    /// The laws of the inverse between the points of the grid.
    #[test]
    fn the_inverse_anywhere(
        stem in prop::sample::select(&Model::PUBLISHED[..]),
        surface_albedo in 0.0..=1.0f64,
        log_length in -4.0..=4.0f64,
        u in 0.0..1.0f64,
        step in 0.0..1.0f64,
    ) {
        let case = Case::new(stem, surface_albedo, 10f64.powf(log_length), Channel::Red);
        let (lower, upper) = (case.profile.sample_radius(u), case.profile.sample_radius(u + (1.0 - u) * step));
        prop_assert!((case.profile.radial_cdf(lower) - u).abs() < 1e-13, "{}", case.name);
        // Two neighbouring u are solved apart from each other, each to a few ulps of its logarithm.
        prop_assert!(lower <= upper * (1.0 + 1e-13), "{}: {lower}, {upper}", case.name);
    }

    /// Coefficients that nobody published, many decades apart, obey the laws too.
    #[test]
    fn any_coefficients_that_give_a_profile_give_a_whole_one(
        model in any_model(),
        surface_albedo in 0.0..=1.0f64,
        u in 0.0..1.0f64,
    ) {
        prop_assert_eq!(model.validate(), Ok(()));
        let p = model.profile(Medium::new(surface_albedo, 1.0).unwrap(), Channel::Red).unwrap();
        let r = p.sample_radius(u);
        prop_assert!(r.is_finite() && p.radial_pdf(r) >= 0.0, "{p:?}: {r}");
        // A rounding of r multiplied by r·radial_pdf, which is at most a few where u is not within 1e-16 of 1.
        prop_assert!((p.radial_cdf(r) - u).abs() < 1e-13, "{p:?}: {} at u = {u}", p.radial_cdf(r));
        prop_assert!((p.radial_cdf(r) + p.radial_tail(r) - 1.0).abs() < 1e-14, "{p:?}");
    }

    /// Whatever the numbers, a caller gets a profile or an error, never a panic.
    #[test]
    fn no_coefficients_panic(values in prop::collection::vec(prop::num::f64::ANY, 12), surface_albedo in 0.0..=1.0f64) {
        // Each number as it is, and within bounds that it may have: a share, or 0 or more.
        let as_is: fn(f64) -> f64 = |value| value;
        let models = ModelKind::ALL.iter().filter_map(|kind| kind.blank(3)).flat_map(|blank| {
            let values = &values;
            [as_is, f64::abs, |value| value.abs().min(1.0)].map(|legal| {
                let (mut model, mut next) = (blank.clone(), values.iter().cycle());
                model.visit(&mut |slot| {
                    for (place, value) in slot.values.iter_mut().zip(next.by_ref()) {
                        *place = legal(*value);
                    }
                });
                model
            })
        });
        for model in models {
            for channel in Channel::ALL {
                if let Ok(p) = model.profile(Medium::new(surface_albedo, 1.0).unwrap(), channel) {
                    for x in [0.0, 1e-300, 0.5, 1.0, 1e300] {
                        let _ = (p.sample_radius(x), p.radial_cdf(x), p.radial_tail(x), p.area_pdf(x));
                    }
                }
            }
        }
    }
}

/// A number over twelve decades.
fn decades() -> impl Strategy<Value = f64> {
    (-6.0..=6.0f64).prop_map(|exponent| 10f64.powf(exponent))
}

/// A model that has a profile at every surface albedo.
fn any_model() -> impl Strategy<Value = Model> {
    let mixture = (any_leaf(), any_leaf(), decades()).prop_map(|(model, other, weight)| {
        let parts = vec![MixturePart { weight: 1.0, model }, MixturePart { weight, model: other }];
        Model::Mixture(MixtureModel { parts })
    });
    prop_oneof![4 => any_leaf(), 1 => mixture]
}

/// The same, but no mixture. A table obeys the laws of `tabulated.rs`.
fn any_leaf() -> impl Strategy<Value = Model> {
    prop_oneof![
        (decades(), decades(), 0.5..=2.5f64).prop_map(|(scattering, absorption, refractive_index)| {
            Model::Dipole(DipoleModel {
                reduced_scattering_per_mm: [scattering; 3],
                absorption_per_mm: [absorption; 3],
                refractive_index,
            })
        }),
        (decades(), decades(), 0.0..=1.0f64, 0.5..=6.0f64).prop_map(
            |(constant, amplitude, pivot, exponent)| {
                let shape = BurleyShape { constant, slope: 0.0, amplitude, pivot, exponent };
                Model::Burley(BurleyModel { length: Length::MeanFreePath, shape })
            }
        ),
        (decades(), decades(), decades()).prop_map(|(a, b, c)| {
            Model::Polynomial(PolynomialModel {
                a: PolynomialA { linear: 0.0, amplitude: -a, decades: 0.0 },
                b: PolynomialB { scale: b, curvature: 0.0, pivot: 0.0, offset: 0.0, exponent: 0.0 },
                c: PolynomialC { amplitude: 0.0, rate: 0.0, offset: c },
            })
        }),
        prop::collection::vec((decades(), decades()), 1..8).prop_map(|terms| {
            let terms = terms
                .into_iter()
                .map(|(variance_mm2, weight)| GaussianTerm { variance_mm2, weight: [weight; 3] })
                .collect();
            Model::GaussianSum(GaussianSumModel { terms })
        }),
        (
            [0.0..=1.0f64, 0.0..=1.0f64, 0.0..=1.0f64],
            [decades(), decades(), decades(), decades(), decades()],
        )
            .prop_map(|([w, a, h], [d, b, z, k, s])| {
                Model::TwoExponentialDipole(TwoExponentialDipoleModel {
                    exponential_weight: [w, 0.0, 0.0, 0.0],
                    exponential_length: [d, 0.0, 0.0, 0.0],
                    dipole_depth: [z, 0.0, 0.0, 0.0],
                    dipole_attenuation: [s, 0.0, 0.0, 0.0],
                    short_weight: a,
                    short_length: b,
                    second_weight: h,
                    second_depth: k,
                })
            }),
        (0.0..=1.0f64, decades(), decades(), decades()).prop_map(|(w, d, z, s)| {
            Model::ExponentialDipole(ExponentialDipoleModel {
                exponential_weight: [w, 0.0, 0.0],
                exponential_length: [d, 0.0, 0.0],
                dipole_depth: [z, 0.0, 0.0],
                dipole_attenuation: [s, 0.0, 0.0],
            })
        }),
    ]
}
