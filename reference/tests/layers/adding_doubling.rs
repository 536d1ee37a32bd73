//! Totals of the adding–doubling method (Prahl, van Gemert and Welch 1993, "Determining the optical properties of turbid
//! media by using the adding-doubling method", Applied Optics 32, 559–568), which shares nothing with random walks.
//!
//! Computed with Prahl's iadpython 0.5.3 at 16, 20, 24, 28 and 32 quadrature points. Across mismatched interfaces the
//! values converge as 1/points²; what stands here is extrapolated from 24 and 32 points, and `UNCERTAINTY` is the size
//! of that step.

use super::{Row, assert_within_noise, simulate};

const UNCERTAINTY: f64 = 3e-5;
const PHOTONS: u64 = 400_000;

/// Above, layers, below; total reflectance (specular included) and transmittance.
struct Case {
    name: &'static str,
    rows: &'static [Row],
    reflectance: f64,
    transmittance: f64,
}

/// All in air.
const CASES: [Case; 7] = [
    Case {
        name: "three layers of MCML's sample",
        rows: &[[1.37, 1.0, 100.0, 0.9, 0.1], [1.37, 1.0, 10.0, 0.0, 0.1], [1.37, 2.0, 10.0, 0.7, 0.2]],
        reflectance: 0.262_21,
        transmittance: 0.096_045,
    },
    Case {
        name: "matched, isotropic",
        rows: &[[1.0, 10.0, 90.0, 0.0, 0.02]],
        reflectance: 0.361_649,
        transmittance: 0.356_501,
    },
    Case {
        name: "n = 1.4, isotropic, one mean free path",
        rows: &[[1.4, 1.0, 9.0, 0.0, 0.1]],
        reflectance: 0.223_111,
        transmittance: 0.526_990,
    },
    Case {
        name: "n = 1.4, forward, ten mean free paths",
        rows: &[[1.4, 1.0, 99.0, 0.8, 0.1]],
        reflectance: 0.355_517,
        transmittance: 0.347_742,
    },
    Case {
        name: "n = 1.3, backward",
        rows: &[[1.3, 1.0, 9.0, -0.5, 0.2]],
        reflectance: 0.381_782,
        transmittance: 0.258_517,
    },
    Case {
        name: "between glass plates",
        rows: &[[1.5, 0.0, 0.0, 0.0, 0.1], [1.4, 1.0, 9.0, 0.0, 0.2], [1.5, 0.0, 0.0, 0.0, 0.3]],
        reflectance: 0.272_596,
        transmittance: 0.299_083,
    },
    Case {
        name: "half-space, n = 1.4, little absorption",
        rows: &[[1.4, 0.1, 9.9, 0.0, 1e8]],
        reflectance: 0.631_348,
        transmittance: 0.0,
    },
];

#[test]
fn totals() {
    for (seed, case) in (10..).zip(&CASES) {
        let result = simulate(1.0, case.rows, 1.0, PHOTONS, seed);
        let (reflected, transmitted) = (result.total_reflectance(), result.transmittance);
        // Errors of 0.4 to 0.8 per mille: a wrong Fresnel term, 4 % of the light, stands out fifty-fold.
        assert!(reflected.standard_error < 8e-4 && transmitted.standard_error < 8e-4);
        for (what, estimate, exact) in
            [("reflectance", reflected, case.reflectance), ("transmittance", transmitted, case.transmittance)]
        {
            let name = format!("{}: {what}", case.name);
            assert_within_noise(&name, estimate.mean - exact, estimate.standard_error.hypot(UNCERTAINTY));
        }
    }
}
