//! Totals that the literature prints, and MCML's own sample.

use std::f64::consts::PI;
use std::ops::ControlFlow;

use subsurface_reference::Estimate;
use subsurface_reference::layers::{LayerResult, parse_mci};

use super::{assert_within_noise, simulate};

/// Half a unit of the fifth printed decimal, as the deviation of an even distribution of that width.
const FIVE_DECIMALS: f64 = 0.29e-5;

#[test]
fn slab_of_van_de_hulst() {
    // van de Hulst 1980, "Multiple Light Scattering", as quoted by Wang, Jacques and Zheng 1995: single-scattering
    // albedo 0.9, optical thickness 2, g = 0.75, matched. MCML: 0.09734 ± 0.00035 and 0.66096 ± 0.00020.
    // A million photons: standard errors of 2.3e-4 and 3.3e-4, so that an error of 1.5 per mille of the energy fails.
    let slab = simulate(1.0, &[[1.0, 10.0, 90.0, 0.75, 0.02]], 1.0, 1_000_000, 1);
    let (reflected, transmitted) = (slab.diffuse_reflectance, slab.transmittance);
    assert!(reflected.standard_error < 3e-4 && transmitted.standard_error < 4e-4);
    assert_eq!(slab.specular_reflectance, 0.0);
    assert_within_noise("Rd", reflected.mean - 0.09739, reflected.standard_error.hypot(FIVE_DECIMALS));
    assert_within_noise("Tt", transmitted.mean - 0.66096, transmitted.standard_error.hypot(FIVE_DECIMALS));
}

#[test]
fn half_space_of_giovanelli() {
    // Giovanelli 1955, "Reflection by semi-infinite diffusers", Optica Acta 2, 153–162, as quoted by Wang, Jacques
    // and Zheng 1995: single-scattering albedo 0.9, isotropic, n = 1.5 against 1, total reflectance 0.2600.
    // MCML: 0.25907 ± 0.00170.
    let half_space = simulate(1.0, &[[1.5, 10.0, 90.0, 0.0, 1e8]], 1.0, 1_000_000, 2);
    let total = half_space.total_reflectance();
    assert!((half_space.specular_reflectance - 0.04).abs() < 1e-12);
    // Four printed decimals: 0.29e-4 of rounding beside 2.9e-4 of noise.
    assert!(total.standard_error < 5e-4);
    assert_within_noise("R", total.mean - 0.2600, total.standard_error.hypot(0.29e-4));
    assert_eq!(half_space.transmittance.mean, 0.0);
}

/// `example.mci` of the MCML 1.2.2 distribution, and columns of the `example.mco` that its authors computed from it with
/// 10⁶ photons.
const SAMPLE: &str = "
1.0                     # file version
1                       # number of runs
example.mco A           # output filename, ASCII/Binary
1000000                 # No. of photons
0.01 0.01               # dz, dr
40 50 1                 # No. of dz, dr & da.
3                       # No. of layers
1.0                     # n for medium above.
1.37 1 100 0.90 0.1     # layer 1
1.37 1 10 0 0.1         # layer 2
1.37 2 10 0.70 0.2      # layer 3
1.0                     # n for medium below.
";

fn sample(photons: &str) -> LayerResult {
    let text = SAMPLE.replace("1000000", photons);
    parse_mci(&text).unwrap()[0].simulate(3, &mut |_| ControlFlow::Continue(()))
}

/// `Rd_r` without its last cell, which also holds what lies beyond.
const SAMPLE_REFLECTANCE: [f64; 49] = [
    3.0924E+01, 1.0071E+01, 6.1187E+00, 4.4015E+00, 3.5138E+00, 2.8528E+00, 2.4344E+00, 2.0692E+00,
    1.7715E+00, 1.5409E+00, 1.3425E+00, 1.2006E+00, 1.0319E+00, 8.9424E-01, 7.9300E-01, 7.0183E-01,
    6.1493E-01, 5.4537E-01, 4.8518E-01, 4.2576E-01, 3.7759E-01, 3.2900E-01, 2.9997E-01, 2.6421E-01,
    2.3595E-01, 2.0775E-01, 1.8657E-01, 1.6498E-01, 1.4860E-01, 1.4064E-01, 1.2364E-01, 1.0955E-01,
    9.9937E-02, 8.9281E-02, 8.3917E-02, 7.1952E-02, 6.5441E-02, 5.8384E-02, 5.3626E-02, 4.8753E-02,
    4.5503E-02, 3.8753E-02, 3.6688E-02, 3.1858E-02, 3.1348E-02, 2.6778E-02, 2.5402E-02, 2.2791E-02,
    2.0812E-02,
];

/// `Tt_r` without its last cell.
const SAMPLE_TRANSMITTANCE: [f64; 49] = [
    5.8942E-01, 6.0085E-01, 5.6453E-01, 5.5132E-01, 5.3655E-01, 5.3603E-01, 5.2027E-01, 4.9193E-01,
    4.6582E-01, 4.3591E-01, 4.1109E-01, 3.9854E-01, 3.6636E-01, 3.3945E-01, 3.2122E-01, 2.9694E-01,
    2.8041E-01, 2.6182E-01, 2.3866E-01, 2.2141E-01, 2.1004E-01, 1.9047E-01, 1.7161E-01, 1.6091E-01,
    1.5083E-01, 1.3239E-01, 1.2549E-01, 1.1543E-01, 9.9789E-02, 9.4186E-02, 8.4806E-02, 7.8703E-02,
    7.4215E-02, 6.6476E-02, 6.0723E-02, 5.6045E-02, 5.1798E-02, 4.6792E-02, 4.3551E-02, 4.0498E-02,
    3.6332E-02, 3.4432E-02, 3.0875E-02, 2.9627E-02, 2.6649E-02, 2.3876E-02, 2.2584E-02, 2.1318E-02,
    1.8962E-02,
];

/// The first five and the last rows of each layer in `A_z`.
const SAMPLE_ABSORPTION: [(usize, f64); 12] = [
    (0, 2.7990),
    (1, 2.8099),
    (2, 2.8125),
    (3, 2.7845),
    (4, 2.7265),
    (9, 2.2037),
    (10, 2.0549),
    (15, 1.4102),
    (19, 0.959_71),
    (20, 1.7314),
    (30, 1.0698),
    (38, 0.847_70),
];

#[test]
fn sample_of_mcml() {
    let sample = sample("1000000");
    // MCML's file is not exact either: its Tt is 2.3 of its standard errors above adding–doubling (adding_doubling.rs), and
    // 8·10⁶ packets of ours put A_l[1] 4.6 of them above its value.
    // Both are estimates from 10⁶ packets of the same process, so the difference has √2 of one's error.
    let both = 2.0_f64.sqrt();
    assert!((sample.specular_reflectance - 0.024_372_9).abs() < 5e-8);
    for (what, ours, theirs) in [
        ("Rd", sample.diffuse_reflectance, 0.237_544),
        ("A", sample.absorbed, 0.641_594),
        ("Tt", sample.transmittance, 0.096_489_6),
        ("A_l[1]", sample.absorbed_by_layer[0], 0.2612),
        ("A_l[2]", sample.absorbed_by_layer[1], 0.1488),
        ("A_l[3]", sample.absorbed_by_layer[2], 0.2316),
    ] {
        // A_l is printed to four places: 0.29e-4 of rounding.
        assert_within_noise(what, ours.mean - theirs, (both * ours.standard_error).hypot(0.29e-4));
    }
    for (what, ours, theirs) in [
        ("Rd_r", &sample.reflectance_by_radius, SAMPLE_REFLECTANCE),
        ("Tt_r", &sample.transmittance_by_radius, SAMPLE_TRANSMITTANCE),
    ] {
        let chi_square: f64 = ours
            .iter()
            .zip(theirs)
            .map(|(ours, theirs)| ((ours.mean - theirs) / (both * ours.standard_error)).powi(2))
            .sum();
        // 49 degrees of freedom: mean 49, deviation 9.9. Right results lie outside [22, 89] once in 2000.
        assert!((22.0..89.0).contains(&chi_square), "{what}: chi² = {chi_square:.1} of 49");
    }
    for (index, theirs) in SAMPLE_ABSORPTION {
        let ours = sample.absorbed_by_depth[index];
        // No error is kept per depth. The scatter of neighbouring rows of MCML's A_z is 0.5 %; 2 % is four of it.
        assert!((ours / theirs - 1.0).abs() < 0.02, "A_z[{index}]: {ours} against {theirs}");
    }
}

#[test]
fn cells_sum_to_totals() {
    let sample = sample("10000");
    let ring = |(index, cell): (usize, &Estimate)| cell.mean * 2.0 * PI * (index as f64 + 0.5) * 0.01 * 0.01;
    let reflected: f64 = sample.reflectance_by_radius.iter().enumerate().map(ring).sum();
    let transmitted: f64 = sample.transmittance_by_radius.iter().enumerate().map(ring).sum();
    let absorbed: f64 = sample.absorbed_by_layer.iter().map(|layer| layer.mean).sum();
    let by_depth: f64 = sample.absorbed_by_depth.iter().map(|density| density * 0.01).sum();
    // Rounding of some fifty terms.
    assert!((reflected - sample.diffuse_reflectance.mean).abs() < 1e-14);
    assert!((transmitted - sample.transmittance.mean).abs() < 1e-14);
    assert!((absorbed - sample.absorbed.mean).abs() < 1e-14);
    assert!((by_depth - sample.absorbed.mean).abs() < 1e-14);
}
