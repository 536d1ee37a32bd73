//! The models against Monte Carlo random walks and the figures that their papers report.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use subsurface_profile::{Channel, Medium, Model, RadialProfile};

/// Radii in mean free paths at which [`SEARCHLIGHT`] and [`DIFFUSE`] give the fraction of energy within.
const RADII: [f64; 8] = [0.05, 0.2, 0.495, 1.03, 2.12, 4.02, 8.32, 15.7];

/// Surface albedo, and the fraction of the energy within each of [`RADII`].
type Truth = [(f64, [f64; 8]); 4];

/// Monte Carlo random walks in a semi-infinite, index-matched, isotropic medium entered perpendicularly: 4e8
/// photons, so the fractions are good to about 5e-5.
const SEARCHLIGHT: Truth = [
    (0.05, [0.1161463, 0.3581428, 0.6261283, 0.8403570, 0.9649055, 0.9966895, 1.0000115, 1.0000379]),
    (0.50, [0.0434806, 0.1518892, 0.3137529, 0.5158084, 0.7487306, 0.9140281, 0.9911195, 0.9997981]),
    (0.80, [0.0290268, 0.1031625, 0.2190336, 0.3753104, 0.5826546, 0.7736640, 0.9274219, 0.9848924]),
    (0.95, [0.0246104, 0.0876582, 0.1868119, 0.3220656, 0.5056906, 0.6834256, 0.8462709, 0.9321751]),
];

/// The same for a cosine-distributed direction of entry.
const DIFFUSE: Truth = [
    (0.05, [0.0957174, 0.3102139, 0.5713797, 0.8032026, 0.9532927, 0.9953894, 1.0000330, 1.0000691]),
    (0.50, [0.0432651, 0.1558118, 0.3296295, 0.5474164, 0.7869044, 0.9383070, 0.9955678, 0.9999544]),
    (0.80, [0.0296686, 0.1089195, 0.2373466, 0.4117306, 0.6343430, 0.8219944, 0.9528893, 0.9925049]),
    (0.95, [0.0252398, 0.0929095, 0.2033589, 0.3553052, 0.5546696, 0.7335023, 0.8811791, 0.9516525]),
];

/// Perpendicular entry into a medium of refractive index 1.4, per energy that entered: 2e8 photons of the crate
/// `subsurface-reference`.
const SEARCHLIGHT_ETA_1_4: Truth = [
    (0.20, [0.062532, 0.197468, 0.367944, 0.559662, 0.779352, 0.934705, 0.996047, 0.999968]),
    (0.50, [0.029205, 0.096143, 0.192328, 0.325807, 0.531919, 0.755474, 0.942259, 0.994410]),
    (0.80, [0.018707, 0.062193, 0.126736, 0.221405, 0.380770, 0.580509, 0.808326, 0.936088]),
    (0.95, [0.015791, 0.052558, 0.107346, 0.188286, 0.326199, 0.502982, 0.716475, 0.856140]),
];

/// The same for light that arrives from all directions.
const DIFFUSE_ETA_1_4: Truth = [
    (0.20, [0.055986, 0.182688, 0.354489, 0.556833, 0.784985, 0.938928, 0.996582, 0.999976]),
    (0.50, [0.026452, 0.090168, 0.188048, 0.328685, 0.542364, 0.767026, 0.947805, 0.995354]),
    (0.80, [0.016980, 0.058501, 0.124372, 0.224262, 0.390049, 0.592893, 0.818631, 0.941410]),
    (0.95, [0.014336, 0.049454, 0.105392, 0.190817, 0.334374, 0.514248, 0.726891, 0.863042]),
];

fn profile(stem: &str, surface_albedo: f64) -> Box<dyn RadialProfile> {
    let medium = Medium::new(surface_albedo, 1.0).unwrap();
    Model::published(stem).unwrap().profile(medium, Channel::Red).unwrap()
}

/// The greatest distance of a model's cdf from the truth.
fn greatest_distance(stem: &str, truth: &Truth) -> f64 {
    let mut greatest = 0.0;
    for (surface_albedo, fractions) in truth {
        let profile = profile(stem, *surface_albedo);
        for (r, fraction) in RADII.iter().zip(fractions) {
            greatest = f64::max(greatest, (profile.radial_cdf(*r) - fraction).abs());
        }
    }
    greatest
}

#[test]
fn exponential_and_dipole_are_the_truth_within_half_a_percent() {
    // Measured over all 15 albedos and all radii of the walks: 0.0045 and 0.0040. (The L1 distance of the density
    // is 1.25 % and 1.03 % in the mean; half of an L1 distance bounds that of the cdf.)
    assert!(greatest_distance("exponential_dipole_searchlight", &SEARCHLIGHT) < 0.0046);
    assert!(greatest_distance("exponential_dipole_diffuse", &DIFFUSE) < 0.0041);
}

#[test]
fn two_exponentials_and_a_dipole_are_the_truth_within_a_quarter_of_a_percent() {
    // Measured over all albedos from 0.01 to 0.99 and all radii of the walks.
    for (stem, truth, measured) in [
        ("two_exponential_dipole_searchlight", &SEARCHLIGHT, 0.0010),
        ("two_exponential_dipole_diffuse", &DIFFUSE, 0.0017),
        ("two_exponential_dipole_searchlight_eta_1_4", &SEARCHLIGHT_ETA_1_4, 0.0023),
        ("two_exponential_dipole_diffuse_eta_1_4", &DIFFUSE_ETA_1_4, 0.0026),
    ] {
        let distance = greatest_distance(stem, truth);
        assert!(distance < measured, "{stem}: {distance}");
    }
}

#[test]
fn each_refractive_index_needs_its_own_coefficients() {
    // Light that the boundary holds back spreads further: measured 0.16 at the radii above.
    for (stem, truth) in [
        ("two_exponential_dipole_searchlight", &SEARCHLIGHT_ETA_1_4),
        ("two_exponential_dipole_diffuse", &DIFFUSE_ETA_1_4),
    ] {
        assert!(greatest_distance(stem, truth) > 0.1, "{stem}: {}", greatest_distance(stem, truth));
    }
}

#[test]
fn each_entry_needs_its_own_coefficients() {
    // (Not so for Burley's profile, whose fits minimise another measure.)
    let (searchlight, diffuse) = ("exponential_dipole_searchlight", "exponential_dipole_diffuse");
    // Measured: 0.069 and 0.077 over all albedos and radii of the walks.
    assert!(greatest_distance(diffuse, &SEARCHLIGHT) > 0.04);
    assert!(greatest_distance(searchlight, &DIFFUSE) > 0.04);
}

#[test]
fn the_older_models_are_as_good_as_measured() {
    // Over all radii and the 15 albedos, A = 0.01 to 0.99, the walks measured 0.125 (A = 0.99), 0.110 and 0.089;
    // these four albedos reach less. A typing error in a coefficient shows as more.
    for (stem, truth, bound) in [
        ("burley_searchlight", &SEARCHLIGHT, 0.105),
        ("burley_diffuse", &DIFFUSE, 0.085),
        ("liang_2023", &SEARCHLIGHT, 0.065),
    ] {
        let distance = greatest_distance(stem, truth);
        assert!(distance < bound, "{stem}: {distance}");
    }
    // The printed constant of L23 puts more than a third of the energy in the wrong place.
    assert!(greatest_distance("liang_2023_printed", &SEARCHLIGHT) > 0.33);
}
