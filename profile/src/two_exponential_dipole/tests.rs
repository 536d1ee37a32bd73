#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::f64::consts::PI;

use super::*;

const ALL: [TwoExponentialDipoleModel; 4] = [
    TwoExponentialDipoleModel::SEARCHLIGHT,
    TwoExponentialDipoleModel::DIFFUSE,
    TwoExponentialDipoleModel::SEARCHLIGHT_ETA_1_4,
    TwoExponentialDipoleModel::DIFFUSE_ETA_1_4,
];

fn profile(model: &TwoExponentialDipoleModel, surface_albedo: f64) -> TwoExponentialDipoleProfile {
    model.profile(Medium::new(surface_albedo, 1.0).unwrap()).unwrap()
}

#[test]
fn the_profile_is_its_equation() {
    for model in ALL {
        for surface_albedo in [0.0, 0.3, 0.9, 1.0] {
            let x = 6.0 * surface_albedo / (1.0 + 5.0 * surface_albedo);
            let cubic = |c: [f64; 4]| c[0] + c[1] * x + c[2] * x * x + c[3] * x * x * x;
            let (w, d, z) =
                (cubic(model.exponential_weight), cubic(model.exponential_length), cubic(model.dipole_depth));
            let s = (1.0 - surface_albedo) * cubic(model.dipole_attenuation);
            let (a, b, h, k) =
                (model.short_weight, model.short_length, model.second_weight, model.second_depth);
            let p = profile(&model, surface_albedo);
            for r in [0.01, 0.3, 1.0, 4.0, 20.0] {
                let source = |z: f64| {
                    let rho = f64::hypot(r, z);
                    let tail = z / rho * (-s * (rho - z)).exp();
                    [tail, tail * r * (1.0 + s * rho) / (rho * rho)]
                };
                let exponential = |d: f64| [(-r / d).exp(), (-r / d).exp() / d];
                let [tail, pdf] = [0, 1].map(|which| {
                    w * ((1.0 - a) * exponential(d)[which] + a * exponential(b * d)[which])
                        + (1.0 - w) * ((1.0 - h) * source(z)[which] + h * source(k * z)[which])
                });
                // As printed, the cdf cancels to an absolute rounding, and s(ρ - z) < 20 multiplies one.
                assert!((p.radial_cdf(r) - (1.0 - tail)).abs() < 4e-15);
                assert!((p.radial_pdf(r) / pdf - 1.0).abs() < 2e-14);
                assert!((p.area_pdf(r) * 2.0 * PI * r / pdf - 1.0).abs() < 2e-14);
            }
        }
    }
}

#[test]
fn nothing_is_absorbed_at_surface_albedo_one() {
    for model in ALL {
        let p = profile(&model, 1.0);
        assert_eq!(p.dipole_attenuation_per_mm().to_bits(), 0);
        // The tail is then Σ w z/r over the sources.
        let ([first, second], [.., v, w]) = (p.dipole_depths_mm(), p.weights());
        assert!((p.radial_tail(1e12) / ((v * first + w * second) / 1e12) - 1.0).abs() < 1e-14);
    }
}

/// Fractions of the energy for the tests of the samplers: a fixed sequence of evenly spread numbers.
fn golden(count: u32) -> impl Iterator<Item = f64> {
    // Multiples of the golden ratio, modulo 1, fill every interval as evenly as any sequence can.
    (0..count).map(|n| (0.5 + f64::from(n) * 0.618_033_988_749_894_9).fract())
}

#[test]
fn composition_follows_the_cdf() {
    const SAMPLES: u32 = 40_000;
    const BINS: usize = 50;
    for model in ALL {
        for surface_albedo in [0.0, 0.1, 0.5, 0.9, 0.99, 1.0] {
            let p = profile(&model, surface_albedo);
            let mut counts = [0u32; BINS];
            for u in golden(SAMPLES) {
                let bin = p.radial_cdf(p.sample_by_composition(u)) * BINS as f64;
                counts[(bin as usize).min(BINS - 1)] += 1;
            }
            let expected = f64::from(SAMPLES) / BINS as f64;
            let chi_squared: f64 = counts.iter().map(|n| (f64::from(*n) - expected).powi(2) / expected).sum();
            // 49 degrees of freedom would reach 85 once in 1000 independent sequences. These numbers are spread more
            // evenly than independent ones: a bin is off by a few numbers of each part. Measured: 0.15.
            assert!(chi_squared < 1.0, "A = {surface_albedo}: {chi_squared}");
        }
    }
}

#[test]
fn composition_inverts_each_part() {
    for model in ALL {
        let p = profile(&model, 0.7);
        let mut below = 0.0;
        for (part, weight) in p.weights().into_iter().enumerate() {
            if weight == 0.0 {
                continue;
            }
            for v in [1e-9, 0.1, 0.5, 0.9, 0.999] {
                let r = p.sample_by_composition(below + v * weight);
                let tail = match part {
                    0 | 1 => (-r / p.exponentials[part].length).exp(),
                    _ => p.sources[part - 2].1.tail(r),
                };
                // The subtraction of the shares before costs an absolute rounding, divided by the share.
                assert!((tail - (1.0 - v)).abs() < 1e-14 + 4.0 * f64::EPSILON / weight, "part {part} at {v}");
            }
            below += weight;
        }
        for u in [-1.0, 0.0, 1.0, f64::INFINITY] {
            let r = p.sample_by_composition(u);
            assert!(r >= 0.0 && r.is_finite(), "{u}: {r}");
        }
        assert!(p.sample_by_composition(f64::NAN).is_nan());
    }
}

#[test]
fn the_inverse_is_found_in_a_few_steps() {
    let (mut worst, mut sum, mut count) = (0, 0, 0);
    for model in ALL {
        for surface_albedo in [0.0, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1.0] {
            let p = profile(&model, surface_albedo);
            for u in golden(500).chain([1e-12, 1e-6, 0.999_999, 1.0 - 1e-12]) {
                let (_, evaluations) = p.log_quantile(u);
                worst = worst.max(evaluations);
                sum += evaluations;
                count += 1;
            }
        }
    }
    // Measured: 4.9 and 7. Bisection alone would take some 50.
    let mean = f64::from(sum) / f64::from(count);
    assert!(mean < 5.5 && worst <= 9, "mean {mean}, worst {worst}");
}

#[test]
fn each_part_alone_is_a_profile() {
    for (weight, short_weight, second_weight) in
        [(0.0, 0.3, 0.0), (0.0, 0.3, 1.0), (1.0, 0.0, 0.5), (1.0, 1.0, 0.5), (1.0, 0.3, 0.5), (0.0, 0.0, 0.4)]
    {
        let model = TwoExponentialDipoleModel {
            exponential_weight: [weight, 0.0, 0.0, 0.0],
            short_weight,
            second_weight,
            ..TwoExponentialDipoleModel::SEARCHLIGHT
        };
        let p = profile(&model, 0.5);
        for u in [0.0, 1e-12, 0.3, 0.7, 1.0 - 1e-12] {
            assert!((p.radial_cdf(p.sample_radius(u)) - u).abs() < 1e-14);
        }
        for u in [0.0, 0.3, 0.7, 1.0] {
            assert!(p.sample_by_composition(u).is_finite());
        }
        assert_eq!(p.area_pdf(0.0).is_finite(), weight == 0.0);
    }
}

#[test]
fn what_is_no_profile_says_why() {
    let good = TwoExponentialDipoleModel::SEARCHLIGHT;
    let fail = |model: TwoExponentialDipoleModel| {
        let error = model.profile(Medium::new(0.5, 1.0).unwrap()).unwrap_err();
        [error.coefficient(), error.to_string(), error.expected()]
    };
    let at = |value: f64| [value, 0.0, 0.0, 0.0];
    for (model, expected) in [
        (
            TwoExponentialDipoleModel { exponential_weight: at(1.25), ..good },
            [
                "exponential_weight",
                "the exponential's weight is 1.25 at surface albedo 0.5",
                "w(A) must be from 0 to 1",
            ],
        ),
        (
            TwoExponentialDipoleModel { dipole_attenuation: at(-1.0), ..good },
            [
                "dipole_attenuation",
                "the dipole's attenuation is -0.5 at surface albedo 0.5",
                "s(A) must be 0 or more",
            ],
        ),
        (
            TwoExponentialDipoleModel { short_weight: 1.5, ..good },
            ["short_weight", "`short_weight` is 1.5", "expected a share from 0 to 1"],
        ),
        (
            TwoExponentialDipoleModel { second_depth: 0.0, ..good },
            ["second_depth", "`second_depth` is 0", "expected a ratio above 0"],
        ),
        (
            TwoExponentialDipoleModel { short_length: f64::NAN, ..good },
            ["short_length", "coefficient `short_length` is not a finite number", "not a finite number"],
        ),
        (
            TwoExponentialDipoleModel { short_length: 1e-300, exponential_length: at(1e-300), ..good },
            ["", "`b d` is out of the range of numbers at surface albedo 0.5", "this model has no profile"],
        ),
    ] {
        assert_eq!(fail(model), expected);
    }
}
