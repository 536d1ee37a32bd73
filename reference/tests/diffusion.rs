//! Diffusion theory: its laws, the papers' closed forms, values of an independent quadrature, and how far it is from
//! Monte Carlo.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::f64::consts::{LN_2, PI};

use subsurface_reference::diffusion::{
    BeamDiffusion, BetterDipole, ClassicalDipole, Medium, MediumError, Multipole, Reflectance,
    SingleScattering, ThicknessError, WithSingleScattering,
};
use subsurface_reference::{HalfSpaceError, RadialTable, TruthTable, truth};

/// Every theory of a half-space.
fn theories(medium: Medium) -> Vec<(&'static str, Box<dyn Reflectance>)> {
    vec![
        ("classical dipole", Box::new(ClassicalDipole::new(medium))),
        ("classical dipole, multiple scattering", Box::new(ClassicalDipole::multiple_scattering(medium))),
        ("better dipole", Box::new(BetterDipole::new(medium))),
        ("beam diffusion", Box::new(BeamDiffusion::new(medium))),
        ("beam diffusion, uncorrected", Box::new(BeamDiffusion::uncorrected(medium))),
        ("single scattering", Box::new(SingleScattering::new(medium))),
        (
            "beam diffusion + single scattering",
            Box::new(WithSingleScattering::new(BeamDiffusion::new(medium), medium)),
        ),
    ]
}

/// Media from nearly black to nearly white, scattering backwards and forwards, matched and not.
fn media() -> Vec<Medium> {
    let mut media = Vec::new();
    for single_scattering_albedo in [0.01, 0.5, 0.9, 0.999] {
        for anisotropy in [-0.5, 0.0, 0.9] {
            for refractive_index in [1.0, 1.4, 2.5] {
                media.push(Medium::new(single_scattering_albedo, anisotropy, refractive_index).unwrap());
            }
        }
    }
    media
}

/// ∫ f(r) dr over (0, ∞) by the trapezoidal rule in ln r from e⁻²⁰ to e¹², where nothing is narrower than its
/// step of 0.1.
fn integrate(f: impl Fn(f64) -> f64) -> f64 {
    let (low, high, steps) = (-20.0, 12.0, 320);
    let step = (high - low) / f64::from(steps);
    let term = |i: i32| {
        let r = (low + f64::from(i) * step).exp();
        r * f(r)
    };
    step * (0..=steps).map(term).sum::<f64>()
}

#[track_caller]
fn assert_close(actual: f64, expected: f64, relative: f64, what: &str) {
    assert!((actual - expected).abs() <= relative * expected.abs(), "{what}: {actual} for {expected}");
}

// Laws.

#[test]
fn totals_are_the_integrals_of_the_profiles() {
    for medium in media() {
        for (name, theory) in theories(medium) {
            let integral = integrate(|r| 2.0 * PI * theory.r_reflectance(r));
            // The rule leaves out r < 2e-9, and the energy there: 2π·2e-9·(r·R at 0 ≤ 10) at most.
            assert_close(integral, theory.total(), 1e-6, &format!("{name}, {medium:?}"));
        }
    }
}

#[test]
fn reflectance_is_positive_and_falls_with_the_radius() {
    for medium in media() {
        for (name, theory) in theories(medium) {
            let mut nearer = f64::INFINITY;
            for i in -20..18 {
                let radius = 1.6_f64.powi(i);
                let (reflectance, r_reflectance) = (theory.reflectance(radius), theory.r_reflectance(radius));
                // Far away in a black medium nothing is left in a double.
                assert!(
                    reflectance >= 0.0 && (reflectance > 0.0 || radius > 50.0),
                    "{name}, {medium:?}, {radius}"
                );
                assert!(reflectance <= nearer, "{name}, {medium:?}, {radius}: {reflectance} after {nearer}");
                // Below the smallest normal number digits are lost.
                assert!(
                    (r_reflectance - radius * reflectance).abs() <= 1e-12 * r_reflectance + 1e-300,
                    "{name}"
                );
                nearer = reflectance;
            }
        }
    }
}

#[test]
fn radii_that_are_no_radii() {
    for medium in media() {
        for (name, theory) in theories(medium) {
            let at_axis = theory.r_reflectance(0.0);
            assert!(at_axis.is_finite(), "{name}");
            // The slowest approach to the limit is that of the logarithm in r·R of the corrected beam.
            assert!((theory.r_reflectance(1e-9) - at_axis).abs() < 1e-6, "{name}: {at_axis}");
            for tiny in [1e-30, 1e-299, 1e-310] {
                assert!((theory.r_reflectance(tiny) - at_axis).abs() < 1e-12, "{name}: {tiny}");
                assert!(!theory.reflectance(tiny).is_nan(), "{name}: {tiny}");
            }
            assert_eq!(theory.reflectance(-1.0), theory.reflectance(0.0), "{name}");
            assert_eq!(theory.r_reflectance(-1.0), at_axis, "{name}");
            assert_eq!(theory.reflectance(f64::INFINITY), 0.0, "{name}");
            assert_eq!(theory.r_reflectance(f64::INFINITY), 0.0, "{name}");
            assert!(theory.reflectance(f64::NAN).is_nan(), "{name}");
            assert!(theory.r_reflectance(f64::NAN).is_nan(), "{name}");
        }
    }
}

#[test]
fn black_medium_sends_nothing_back() {
    let medium = Medium::matched_isotropic(0.0).unwrap();
    for (name, theory) in theories(medium) {
        for radius in [0.0, 1e-3, 1.0, 100.0] {
            assert_eq!(theory.reflectance(radius), 0.0, "{name}");
        }
        assert_eq!(theory.total(), 0.0, "{name}");
    }
}

#[test]
fn white_medium_sends_everything_back_by_multiple_scattering_alone() {
    // Each theory's boundary condition balances its own exitance, so without absorption nothing is lost. Single
    // scattering on top of that is energy out of nowhere, and κ exists to take some of it off.
    for refractive_index in [1.0, 1.33, 1.5, 3.0] {
        let medium = Medium::new(1.0, 0.3, refractive_index).unwrap();
        assert_close(ClassicalDipole::new(medium).total(), 1.0, 1e-12, "classical dipole");
        assert_close(BetterDipole::new(medium).total(), 1.0, 1e-12, "better dipole");
        assert_close(BeamDiffusion::uncorrected(medium).total(), 1.0, 1e-12, "beam");
        let corrected = BeamDiffusion::new(medium).total();
        assert!(corrected < 1.0 && corrected > 0.85, "{corrected}");
    }
}

#[test]
fn similarity_is_a_change_of_the_unit_of_length() {
    // σs′ = (1 - g)σs: with g, the medium is the isotropic one of α′ whose mean free path is 1/σt′.
    let (single_scattering_albedo, anisotropy) = (0.95, 0.7);
    let medium = Medium::new(single_scattering_albedo, anisotropy, 1.4).unwrap();
    let extinction = 1.0 - anisotropy * single_scattering_albedo;
    let reduced_albedo = (1.0 - anisotropy) * single_scattering_albedo / extinction;
    let isotropic = Medium::new(reduced_albedo, 0.0, 1.4).unwrap();
    for ((name, theory), (_, similar)) in theories(medium).iter().zip(theories(isotropic)).take(5) {
        assert_close(theory.total(), similar.total(), 1e-12, name);
        for radius in [0.01, 1.0, 10.0] {
            let expected = extinction * extinction * similar.reflectance(radius * extinction);
            assert_close(theory.reflectance(radius), expected, 1e-11, name);
        }
    }
}

#[test]
fn uncorrected_beam_exceeds_the_corrected_one_and_meets_it_far_away() {
    let medium = Medium::new(0.9, 0.0, 1.4).unwrap();
    let (with, without) = (BeamDiffusion::new(medium), BeamDiffusion::uncorrected(medium));
    for radius in [0.01, 0.1, 1.0, 3.0] {
        assert!(with.reflectance(radius) < without.reflectance(radius));
        // κ ≥ 1 - e^{-2r}.
        assert!(with.reflectance(radius) > (1.0 - (-2.0 * radius).exp()) * without.reflectance(radius));
    }
    assert_close(with.reflectance(20.0), without.reflectance(20.0), 1e-12, "far away");
}

// Slabs.

#[test]
fn thick_slab_is_a_half_space() {
    for medium in media() {
        let (dipole, slab) = (ClassicalDipole::new(medium), Multipole::new(medium, 3e4).unwrap());
        // At α = 0.999 and g = 0.9 light goes 43 mean free paths before it is absorbed: nothing of it meets the
        // far side.
        assert_close(slab.total(), dipole.total(), 1e-12, "total");
        for radius in [0.0, 0.1, 1.0, 10.0] {
            assert_close(slab.reflectance(radius), dipole.reflectance(radius), 1e-12, "reflectance");
        }
        assert!(slab.total_transmittance() < 1e-100);
    }
    // Without absorption the far side takes 2z_b + … of the thickness.
    let medium = Medium::matched_isotropic(1.0).unwrap();
    assert_close(Multipole::new(medium, 1e9).unwrap().total(), 1.0, 2e-9, "white");
}

#[test]
fn slab_gains_no_energy_and_without_absorption_loses_none() {
    for anisotropy in [0.0, 0.8] {
        for refractive_index in [1.0, 1.5] {
            for thickness in [6.0, 20.0, 1e5] {
                let white = Medium::new(1.0, anisotropy, refractive_index).unwrap();
                let slab = Multipole::new(white, thickness).unwrap();
                assert_close(slab.total() + slab.total_transmittance(), 1.0, 1e-12, "white");
                let (mut reflected, mut transmitted) = (1.0, 1.0);
                for single_scattering_albedo in [1.0 - 1e-9, 0.999, 0.9, 0.5, 0.0] {
                    let medium = Medium::new(single_scattering_albedo, anisotropy, refractive_index).unwrap();
                    let slab = Multipole::new(medium, thickness).unwrap();
                    let (r, t) = (slab.total(), slab.total_transmittance());
                    assert!(r >= 0.0 && t >= 0.0 && r + t <= 1.0);
                    assert!(
                        r < reflected && (t < transmitted || t == 0.0),
                        "absorption takes from both sides"
                    );
                    (reflected, transmitted) = (r, t);
                }
            }
        }
    }
}

#[test]
fn totals_of_a_slab_are_the_integrals_of_its_profiles() {
    for (single_scattering_albedo, thickness) in
        [(1.0, 1.5), (1.0, 4.0), (0.95, 1.01), (0.95, 30.0), (0.3, 3.0)]
    {
        let slab =
            Multipole::new(Medium::new(single_scattering_albedo, 0.0, 1.4).unwrap(), thickness).unwrap();
        let reflected = integrate(|r| 2.0 * PI * slab.r_reflectance(r));
        let transmitted = integrate(|r| 2.0 * PI * r * slab.transmittance(r));
        // Images and modes are good to 1e-9 of the profile where it is large.
        assert_close(reflected, slab.total(), 1e-7, "reflected");
        assert_close(transmitted, slab.total_transmittance(), 1e-7, "transmitted");
    }
}

#[test]
fn slab_with_its_source_in_the_middle_is_the_same_from_both_sides() {
    // The source is one reduced mean free path deep: twice that is a symmetric slab.
    for (single_scattering_albedo, anisotropy) in [(1.0, 0.0), (0.9, 0.0), (0.9, 0.8)] {
        let medium = Medium::new(single_scattering_albedo, anisotropy, 1.3).unwrap();
        let slab = Multipole::new(medium, 2.0 / (1.0 - anisotropy * single_scattering_albedo)).unwrap();
        assert_close(slab.total(), slab.total_transmittance(), 1e-12, "total");
        for radius in [0.0, 0.5, 3.0, 30.0] {
            assert_close(slab.reflectance(radius), slab.transmittance(radius), 1e-9, "profile");
        }
    }
}

#[test]
fn multipole_has_the_totals_of_adding_and_doubling() {
    // Adding-doubling with 32 angles (Prahl's iadpython; its digits change by 2e-4 from 16 angles), perpendicular
    // entry into an isotropic slab, light that entered = 1: α, η, thickness, R, T, and how far diffusion may be off.
    for [single_scattering_albedo, index, thickness, reflected, transmitted, tolerance] in [
        [1.0, 1.0, 4.0, 0.6908, 0.3090, 0.012],
        [1.0, 1.0, 10.0, 0.8525, 0.1467, 0.005],
        [0.99, 1.0, 4.0, 0.6449, 0.2754, 0.012],
        [0.99, 1.0, 10.0, 0.7406, 0.0846, 0.013],
        [0.99, 1.4, 4.0, 0.5379, 0.3167, 0.036],
        // Half of the light is absorbed here, and diffusion is not made for that.
        [0.9, 1.0, 4.0, 0.4081, 0.1285, 0.16],
    ] {
        let slab =
            Multipole::new(Medium::new(single_scattering_albedo, 0.0, index).unwrap(), thickness).unwrap();
        assert_close(slab.total(), reflected, tolerance, "reflected");
        assert_close(slab.total_transmittance(), transmitted, tolerance, "transmitted");
    }
}

#[test]
fn profiles_of_a_slab_are_positive_and_fall_with_the_radius() {
    for medium in media() {
        for factor in [1.01, 2.0, 10.0, 100.0] {
            let extinction = 1.0 - medium.anisotropy() * medium.single_scattering_albedo();
            let slab = Multipole::new(medium, factor / extinction).unwrap();
            let (mut r, mut t) = (f64::INFINITY, f64::INFINITY);
            for i in -20..20 {
                let radius = 1.4_f64.powi(i);
                let nearer = (r, t);
                (r, t) = (slab.reflectance(radius), slab.transmittance(radius));
                assert!(r >= 0.0 && r <= nearer.0, "{medium:?} {factor} {radius}: {r} after {}", nearer.0);
                // The profile is flat near the axis, where the last digit may go either way.
                assert!(
                    t >= 0.0 && t <= nearer.1 * (1.0 + 1e-9),
                    "{medium:?} {factor} {radius}: {t} after {}",
                    nearer.1
                );
            }
            assert!(slab.transmittance(f64::NAN).is_nan() && slab.reflectance(f64::NAN).is_nan());
            assert_eq!(slab.transmittance(f64::INFINITY), 0.0);
        }
    }
}

// Published closed forms.

#[test]
fn total_of_the_classical_dipole_is_the_published_one() {
    // Jensen and Buhler 2002, with A = 1 at a matched boundary.
    for reduced_albedo in [0.1_f64, 0.5, 0.9, 0.99, 0.9999] {
        let root = (3.0 * (1.0 - reduced_albedo)).sqrt();
        let published = 0.5 * reduced_albedo * (1.0 + (-4.0 / 3.0 * root).exp()) * (-root).exp();
        let medium = Medium::matched_isotropic(reduced_albedo).unwrap();
        assert_close(ClassicalDipole::new(medium).total(), published, 1e-12, "R_d");
    }
}

#[test]
fn total_of_the_better_dipole_is_the_published_one() {
    // d'Eon 2012, with C_φ = 1/4, C_E = 1/2 and A = 1 at a matched boundary.
    for reduced_albedo in [0.1_f64, 0.5, 0.9, 0.99, 0.9999] {
        let (black, grey) = (1.0 - reduced_albedo, 2.0 - reduced_albedo);
        let transport_times_diffusion = (black * grey / 3.0).sqrt();
        let image = (-4.0 * transport_times_diffusion).exp();
        let published = 0.5
            * reduced_albedo
            * reduced_albedo
            * (-(3.0 * black / grey).sqrt()).exp()
            * (0.5 * (1.0 + image) + 0.25 / transport_times_diffusion * (1.0 - image));
        let medium = Medium::matched_isotropic(reduced_albedo).unwrap();
        assert_close(BetterDipole::new(medium).total(), published, 1e-12, "R_d");
    }
}

#[test]
fn single_scattering_sums_up_to_its_closed_form() {
    // ½ ∫ μ/(1 + μ) dμ of an isotropic medium with a matched boundary.
    let total = SingleScattering::new(Medium::matched_isotropic(0.7).unwrap()).total();
    assert_close(total, 0.7 * 0.5 * (1.0 - LN_2), 1e-10, "α(1 - ln 2)/2");
}

// Independent values.

#[test]
fn profiles_are_those_of_an_independent_quadrature() {
    // The papers' formulas with C₁ and C₂, by adaptive Gauss-Kronrod quadrature over the depth (SciPy's quad, relative
    // 1e-12) that shares nothing with this crate: α, g, η, r; corrected beam, better dipole, classical dipole, single
    // scattering.
    const VALUES: [[f64; 8]; 7] = [
        [
            0.6857461748,
            0.0,
            1.0,
            0.001,
            4.0844717689071e-1,
            2.4016227909446e-2,
            4.4129688539890e-2,
            5.3862120205502e1,
        ],
        [
            0.6857461748,
            0.0,
            1.0,
            20.0,
            1.1450453113592e-11,
            1.2315790410452e-11,
            1.5347762761210e-12,
            1.2155923291516e-14,
        ],
        [
            0.9938825994,
            0.0,
            1.0,
            1.0,
            3.3043495703833e-2,
            3.6897548668176e-2,
            3.8258878575219e-2,
            5.2027682001344e-3,
        ],
        [0.9, 0.0, 1.4, 0.1, 9.5616628962494e-2, 2.9616930606916e-2, 6.3622025728390e-2, 2.3830760632089e-1],
        [0.9, 0.0, 1.4, 5.0, 2.6497307180433e-4, 2.8719445538737e-4, 2.1492307795617e-4, 2.7505522789267e-9],
        [0.9, 0.8, 1.4, 0.1, 6.7508967472187e-3, 8.8706042398386e-4, 2.8988367356895e-3, 1.6226240985950e-2],
        [0.9, 0.8, 1.4, 5.0, 1.4309420995926e-4, 1.6947515040631e-4, 3.7187706839092e-4, 2.0894975123103e-10],
    ];
    for [single_scattering_albedo, anisotropy, index, radius, beam, better, classical, single] in VALUES {
        let medium = Medium::new(single_scattering_albedo, anisotropy, index).unwrap();
        // Both sides claim 1e-12; the printed digits are good to 1e-13.
        assert_close(BeamDiffusion::new(medium).reflectance(radius), beam, 3e-12, "beam");
        assert_close(BetterDipole::new(medium).reflectance(radius), better, 3e-12, "better dipole");
        assert_close(ClassicalDipole::new(medium).reflectance(radius), classical, 3e-12, "classical dipole");
        // Single scattering claims 1e-10 of its value at r = 0.
        let difference = SingleScattering::new(medium).r_reflectance(radius) - radius * single;
        assert!(
            difference.abs() < 1e-10 * SingleScattering::new(medium).r_reflectance(0.0),
            "single scattering"
        );
    }
}

// Monte Carlo.

/// How far a theory is from a table of Monte Carlo.
#[derive(Debug)]
struct Deviation {
    /// Total over the surface albedo.
    total: f64,
    /// ∫ |difference of 2πrR| dr over the surface albedo.
    l1: f64,
    /// Mean of |difference|/truth over uniform radii in [0, 3] mean free paths.
    mean_relative_error: f64,
}

fn deviation(theory: &dyn Reflectance, truth: &RadialTable) -> Deviation {
    let (mut l1, mut relative_error) = (0.0, 0.0);
    for bin in &truth.bins {
        let width = bin.r_hi - bin.r_lo;
        // The mean of r·R over a ring, by three-point Gauss-Legendre; rings are at most a tenth as wide as far away.
        let node = 0.5 * 0.6_f64.sqrt();
        let at = |offset: f64| theory.r_reflectance(bin.r_lo + width * (0.5 + offset));
        let mean = (5.0 * at(-node) + 8.0 * at(0.0) + 5.0 * at(node)) / 18.0;
        let difference = (mean - bin.r_reflectance).abs();
        l1 += 2.0 * PI * difference * width / truth.surface_albedo;
        if bin.r_hi < 3.01 {
            relative_error += difference / bin.r_reflectance * width / 3.0;
        }
    }
    Deviation { total: theory.total() / truth.surface_albedo, l1, mean_relative_error: relative_error }
}

/// Deviations of "dipole", "better dipole" and "photon beam diffusion", each "+ single scattering", from a profile.
fn deviations(table: &TruthTable, surface_albedo: f64) -> [Deviation; 3] {
    let truth = table
        .tables
        .iter()
        .find(|t| (t.surface_albedo - surface_albedo).abs() < 1e-3)
        .expect("the albedo is stored");
    let medium =
        Medium::new(truth.single_scattering_albedo, 0.0, table.half_space.refractive_index()).unwrap();
    [
        deviation(&WithSingleScattering::new(ClassicalDipole::new(medium), medium), truth),
        deviation(&WithSingleScattering::new(BetterDipole::new(medium), medium), truth),
        deviation(&WithSingleScattering::new(BeamDiffusion::new(medium), medium), truth),
    ]
}

#[test]
fn beam_diffusion_is_the_best_of_the_theories_that_were_compared() {
    // Christensen and Burley 2015, figure 6, at the same surface albedos; index-matched. The figure has no numbers:
    // these are ours, L1 of 2πrR. Beam diffusion is the best at each; the better dipole is better than the classical
    // one except at 0.8, where it is worse by 3 %.
    for (surface_albedo, measured) in
        [(0.2, [0.379, 0.188, 0.134]), (0.5, [0.278, 0.240, 0.138]), (0.8, [0.215, 0.222, 0.113])]
    {
        let deviations = deviations(truth::searchlight(), surface_albedo);
        for (deviation, l1) in deviations.iter().zip(measured) {
            // The table's noise adds up to less than a thousandth of L1; the rest is for another table's rings.
            assert!((deviation.l1 - l1).abs() < 0.01, "A = {surface_albedo}: {deviation:?} for L1 {l1}");
        }
        let [classical, better, beam] = deviations;
        assert!(beam.l1 < classical.l1.min(better.l1));
        assert!(beam.mean_relative_error < classical.mean_relative_error.min(better.mean_relative_error));
        assert!(beam.total > 1.0 && beam.total < 1.2, "single scattering on top is too much: {beam:?}");
    }
}

#[test]
fn theories_are_at_their_best_at_a_refractive_mismatch() {
    // A surface that reflects leaves more of the light to the many scatterings that diffusion describes. Here the
    // order of the papers holds without exception.
    for (surface_albedo, measured) in
        [(0.2, [0.473, 0.159, 0.049]), (0.5, [0.213, 0.133, 0.034]), (0.8, [0.139, 0.113, 0.033])]
    {
        let deviations = deviations(truth::searchlight_eta_1_4(), surface_albedo);
        for (deviation, l1) in deviations.iter().zip(measured) {
            assert!((deviation.l1 - l1).abs() < 0.01, "A = {surface_albedo}: {deviation:?} for L1 {l1}");
        }
        let [classical, better, beam] = deviations;
        assert!(beam.l1 < better.l1 && better.l1 < classical.l1);
        assert!(beam.mean_relative_error < better.mean_relative_error);
        assert!(better.mean_relative_error < classical.mean_relative_error);
    }
}

#[test]
fn beam_diffusion_at_a_refractive_mismatch_has_the_published_total() {
    // Giovanelli 1955, as quoted by Wang, Jacques and Zheng 1995: a half-space with α = 0.9 and η = 1.5 reflects
    // 0.2600, specular reflection 0.04 included: 0.2292 of what enters.
    let medium = Medium::new(0.9, 0.0, 1.5).unwrap();
    let published = (0.2600 - 0.04) / (1.0 - 0.04);
    let beam = WithSingleScattering::new(BeamDiffusion::new(medium), medium).total();
    let better = WithSingleScattering::new(BetterDipole::new(medium), medium).total();
    let classical = WithSingleScattering::new(ClassicalDipole::new(medium), medium).total();
    // Measured: +1.9 %, +2.7 %, +36 %.
    assert_close(beam, published, 0.025, "beam");
    assert_close(better, published, 0.035, "better dipole");
    assert!(classical > 1.3 * published, "the classical sum counts single scattering twice: {classical}");
}

// Bad input.

#[test]
fn media_that_cannot_be_are_refused() {
    for bad in [-0.1, 1.0 + 1e-12, f64::NAN, f64::INFINITY] {
        let error = Medium::matched_isotropic(bad).unwrap_err();
        assert!(matches!(error, MediumError::SingleScatteringAlbedo(_)), "{error}");
    }
    for bad in [-1.0, 1.0, 2.0, f64::NAN] {
        let error = Medium::new(0.5, bad, 1.0).unwrap_err();
        assert!(matches!(error, MediumError::HalfSpace(HalfSpaceError::Anisotropy(_))), "{error}");
    }
    for bad in [0.99, 0.0, -1.4, f64::NAN, f64::INFINITY] {
        let error = Medium::new(0.5, 0.0, bad).unwrap_err();
        assert!(matches!(error, MediumError::HalfSpace(HalfSpaceError::RefractiveIndex(_))), "{error}");
    }
    assert_eq!(
        Medium::matched_isotropic(1.5).unwrap_err().to_string(),
        "single-scattering albedo 1.5 is not in [0, 1]: give σs / (σs + σa)"
    );
}

#[test]
fn slabs_that_cannot_be_are_refused() {
    let medium = Medium::new(0.5, 0.5, 1.0).unwrap();
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = Multipole::new(medium, bad).unwrap_err();
        assert!(matches!(error, ThicknessError::NotPositive(_)), "{error}");
    }
    // The largest of numbers is a thickness too.
    for single_scattering_albedo in [0.5, 1.0] {
        let medium = Medium::new(single_scattering_albedo, 0.5, 1.0).unwrap();
        let slab = Multipole::new(medium, f64::MAX).unwrap();
        assert_close(slab.reflectance(1.0), ClassicalDipole::new(medium).reflectance(1.0), 1e-12, "thick");
        assert_eq!(slab.transmittance(1.0), 0.0);
    }
    // σt′ = 0.75: the source is 4/3 mean free paths deep.
    assert!(Multipole::new(medium, 1.34).is_ok());
    let error = Multipole::new(medium, 1.0).unwrap_err();
    assert_eq!(
        error,
        ThicknessError::ThinnerThanSource { thickness: 1.0, reduced_mean_free_path: 1.0 / 0.75 }
    );
    assert_eq!(
        error.to_string(),
        "thickness 1 does not exceed the 1.3333333333333333 mean free paths at which the multipole has its source: \
         simulate so thin a layer instead"
    );
}
