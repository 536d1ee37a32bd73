//! Exact totals: the equation that H solves, limits, round trips, and digits that were computed elsewhere.

#![allow(
    clippy::unwrap_used,
    clippy::print_stderr,
    reason = "tests may panic, and say what they could not do"
)]

use subsurface_reference::Entry;
use subsurface_reference::chandrasekhar::{TotalError, h_function, single_scattering_albedo, surface_albedo};

/// A, α searchlight, α diffuse: from a program that shares nothing with this crate.
const DIGITS: [(f64, f64, f64); 10] = [
    (0.005, 0.0319275722, 0.0241073508),
    (0.05, 0.2689552547, 0.2141022169),
    (0.1, 0.4548662894, 0.3790866910),
    (0.2, 0.6857461748, 0.6096750763),
    (0.3, 0.8149690074, 0.7555373585),
    (0.5, 0.9381719387, 0.9113361304),
    (0.7, 0.9840855909, 0.9759700954),
    (0.9, 0.9986617439, 0.9979070223),
    (0.95, 0.9996858422, 0.9995051832),
    (0.995, 0.9999970256, 0.9999952874),
];

#[test]
fn digits_are_those_of_another_program() {
    for (known_surface_albedo, searchlight, diffuse) in DIGITS {
        // Ten digits are given.
        assert!(
            (single_scattering_albedo(Entry::Searchlight, known_surface_albedo).unwrap() - searchlight).abs()
                < 1e-10
        );
        assert!(
            (single_scattering_albedo(Entry::Diffuse, known_surface_albedo).unwrap() - diffuse).abs() < 1e-10
        );
    }
}

#[test]
fn h_has_chandrasekhars_moments() {
    for alpha in [0.1, 0.5, 0.9, 0.999, 1.0_f64] {
        let q = (1.0 - alpha).sqrt();
        // μ = t² smooths H's μ ln μ; the midpoint rule with 2000 points is then good to about 10⁻⁶.
        let moment: f64 = (0..2000)
            .map(|index| (f64::from(index) + 0.5) / 2000.0)
            .map(|t| 2.0 * t * h_function(t * t, q) / 2000.0)
            .sum();
        // Chandrasekhar 1960, ch. V: (α/2) ∫ H dμ = 1 - √(1 - α).
        assert!((0.5 * alpha * moment - (1.0 - q)).abs() < 2e-6, "{alpha}");
    }
    // Chandrasekhar's table of H for α = 1 ends with H(1) = 2.9078.
    assert!((h_function(1.0, 0.0) - 2.907_81).abs() < 1e-5);
    assert_eq!(h_function(0.0, 0.5), 1.0);
}

#[test]
fn albedos_invert_each_other_and_end_at_0_and_1() {
    for entry in [Entry::Searchlight, Entry::Diffuse] {
        assert_eq!(surface_albedo(entry, 0.0).unwrap(), 0.0);
        assert_eq!(surface_albedo(entry, 1.0).unwrap(), 1.0);
        assert_eq!(single_scattering_albedo(entry, 0.0).unwrap(), 0.0);
        assert_eq!(single_scattering_albedo(entry, 1.0).unwrap(), 1.0);
        for percent in (1..100).step_by(7) {
            let known_surface_albedo = f64::from(percent) / 100.0;
            let alpha = single_scattering_albedo(entry, known_surface_albedo).unwrap();
            // α has 16 digits, and A moves by up to 10³ times as much as α near 1.
            assert!((surface_albedo(entry, alpha).unwrap() - known_surface_albedo).abs() < 1e-12);
        }
    }
}

#[test]
fn impossible_albedos_are_errors() {
    for value in [-0.1, 1.1, f64::NAN, f64::INFINITY] {
        assert!(matches!(surface_albedo(Entry::Diffuse, value), Err(TotalError::SingleScatteringAlbedo(_))));
        assert!(matches!(single_scattering_albedo(Entry::Diffuse, value), Err(TotalError::SurfaceAlbedo(_))));
    }
}

#[test]
fn all_digits_of_the_shared_table() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/truth/A_alpha_exact.csv");
    let Ok(text) = std::fs::read_to_string(path) else {
        eprintln!("not compared: there is no ../shared/truth beside this repository");
        return;
    };
    for row in text.lines().skip(1) {
        let values: Vec<f64> = row.split(',').map(|field| field.parse().unwrap()).collect();
        for (entry, alpha) in [(Entry::Searchlight, values[1]), (Entry::Diffuse, values[2])] {
            assert!((single_scattering_albedo(entry, values[0]).unwrap() - alpha).abs() < 1e-10, "{row}");
        }
    }
}
