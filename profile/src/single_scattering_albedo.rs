//! Conversion between the surface albedo A and the single-scattering albedo α.
//!
//! In a flat, semi-infinite, index-matched, isotropic medium A depends on α = σs/σt alone, but not in closed
//! form: Chandrasekhar's H functions give it. The rational function used here is exact at both ends, increases
//! strictly and inverts in closed form:
//!
//! α = 1 - q², q = (1 - A)(1 + c₁A)/(1 + c₂A + c₃A²).
//!
//! It was fitted to the H-function values; the greatest error of α is 2.9e-4 for searchlight and 7.3e-5 for
//! diffuse entry. Below a boundary, where light is reflected back into the medium, the same form was fitted to random
//! walks at eight refractive indices. (\[L23\] eq. (8), α = 5.67A/(A² + 3.84A + 0.84), is off by 0.0052, decreases above A = 0.9165
//! and never reaches 1.)

/// How the light enters the medium.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Entry {
    /// A pencil of light, perpendicular to the surface.
    Searchlight,
    /// From all directions with the same radiance, outside: distributed by the cosine, and refracted where there is a
    /// boundary.
    Diffuse,
}

/// c₁, c₂ and c₃ of q(A) for perpendicular entry; its twin in WGSL takes them from here.
pub(crate) const SEARCHLIGHT: [f64; 3] = [1.02129, 3.27177, 1.60715];

/// The same for diffuse entry.
pub(crate) const DIFFUSE: [f64; 3] = [0.72146, 2.16390, 0.81192];

/// Refractive indices of a medium below a boundary, and c₁, c₂ and c₃ for perpendicular and for diffuse entry: fitted to
/// A of 2·10⁷ walks at 23 albedos each. A is per energy that entered, and within 7e-4.
const BELOW: [(f64, [[f64; 3]; 2]); 9] = [
    (1.0, [SEARCHLIGHT, DIFFUSE]),
    (1.1, [[1.84945, 5.14808, 3.23131], [1.48667, 4.13228, 2.01060]]),
    (1.2, [[2.17141, 6.53563, 4.56246], [1.90843, 5.67158, 3.48237]]),
    (1.3, [[2.63144, 8.15160, 6.97496], [2.37943, 7.31454, 5.78796]]),
    (1.4, [[3.13691, 9.91976, 10.38302], [2.91139, 9.12460, 9.14745]]),
    (1.5, [[3.72285, 11.88779, 15.17765], [3.55946, 11.17214, 14.05858]]),
    (1.6, [[4.32796, 13.98971, 21.31214], [4.19203, 13.30353, 20.19095]]),
    (1.8, [[5.75502, 18.81164, 39.74977], [5.66236, 18.16898, 38.71577]]),
    (2.0, [[7.46840, 24.48808, 69.08491], [7.37734, 23.84595, 67.83640]]),
];

/// Largest refractive index, over that of the outside, of a medium whose albedo is known; the smallest is 1.
pub const LARGEST_REFRACTIVE_INDEX: f64 = BELOW[BELOW.len() - 1].0;

impl Entry {
    /// c₁, c₂ and c₃ of q(A), fitted to exact values of H functions, see the module.
    const fn rational(self) -> [f64; 3] {
        match self {
            Entry::Searchlight => SEARCHLIGHT,
            Entry::Diffuse => DIFFUSE,
        }
    }
}

/// α of the medium whose surface albedo is `surface_albedo`.
///
/// The argument is clamped to [0, 1]; 0 gives exactly 0 and 1 exactly 1. NaN gives NaN.
pub fn from_surface_albedo(entry: Entry, surface_albedo: f64) -> f64 {
    from_albedo(entry.rational(), surface_albedo)
}

fn from_albedo([c1, c2, c3]: [f64; 3], surface_albedo: f64) -> f64 {
    let a = surface_albedo.clamp(0.0, 1.0);
    let denominator = 1.0 + (c2 + c3 * a) * a;
    let q = (1.0 - a) * (1.0 + c1 * a) / denominator;
    if a < 0.5 {
        // α = (1 - q)(1 + q), and 1 - q without the cancellation: numerator and denominator both begin with 1.
        a * ((1.0 - c1 + c2) + (c1 + c3) * a) / denominator * (1.0 + q)
    } else {
        1.0 - q * q
    }
}

/// q = √(1 - α) of the medium whose surface albedo is `surface_albedo`, clamped to [0, 1], below a boundary.
pub(crate) fn root_below(entry: Entry, refractive_index: f64, surface_albedo: f64) -> f64 {
    let a = surface_albedo.clamp(0.0, 1.0);
    let [c1, c2, c3] = coefficients_below(entry, refractive_index);
    (1.0 - a) * (1.0 + c1 * a) / (1.0 + (c2 + c3 * a) * a)
}

/// A of the medium whose single-scattering albedo is `single_scattering_albedo`: the inverse of
/// [`from_surface_albedo`].
///
/// The argument is clamped to [0, 1]; 0 gives exactly 0 and 1 exactly 1. NaN gives NaN.
///
/// Near 1 the surface albedo is steep in α, 1 - A ∝ √(1 - α), so one unit in the last place of α is up to
/// 1e-8 of A.
pub fn to_surface_albedo(entry: Entry, single_scattering_albedo: f64) -> f64 {
    to_albedo(entry.rational(), single_scattering_albedo)
}

fn to_albedo([c1, c2, c3]: [f64; 3], single_scattering_albedo: f64) -> f64 {
    let alpha = single_scattering_albedo.clamp(0.0, 1.0);
    let q = (1.0 - alpha).sqrt();
    // (1 - A)(1 + c₁A) = q(1 + c₂A + c₃A²) is quadratic A² + linear A - (1 - q) = 0 with one positive root.
    let quadratic = c1 + c3 * q;
    let linear = 1.0 - c1 + c2 * q;
    let one_minus_q = alpha / (1.0 + q);
    let root = (linear * linear + 4.0 * quadratic * one_minus_q).sqrt();
    let surface_albedo =
        if linear >= 0.0 { 2.0 * one_minus_q / (linear + root) } else { (root - linear) / (2.0 * quadratic) };
    // At α = 1 the root is 1 up to rounding; the end is exact by definition.
    if alpha == 1.0 { 1.0 } else { surface_albedo.clamp(0.0, 1.0) }
}

/// c₁, c₂ and c₃ of q(A) below a boundary to a medium of `refractive_index` times less, clamped to
/// [1, [`LARGEST_REFRACTIVE_INDEX`]]: straight between those that were fitted.
pub fn coefficients_below(entry: Entry, refractive_index: f64) -> [f64; 3] {
    let index = refractive_index.clamp(1.0, LARGEST_REFRACTIVE_INDEX);
    let upper = BELOW.iter().position(|(node, _)| *node >= index).unwrap_or(BELOW.len() - 1).max(1);
    let [(low, below), (high, above)] = [BELOW[upper - 1], BELOW[upper]];
    let of_entry = match entry {
        Entry::Searchlight => 0,
        Entry::Diffuse => 1,
    };
    let part = (index - low) / (high - low);
    [0, 1, 2].map(|k: usize| below[of_entry][k] * (1.0 - part) + above[of_entry][k] * part)
}

/// α of the medium whose surface albedo is `surface_albedo`, below a boundary to a medium of `refractive_index` times
/// less: A is per energy that entered.
///
/// Arguments are clamped: the albedo to [0, 1], the index to [1, [`LARGEST_REFRACTIVE_INDEX`]]. NaN gives NaN. Without a
/// boundary this is [`from_surface_albedo`].
pub fn from_surface_albedo_below(entry: Entry, refractive_index: f64, surface_albedo: f64) -> f64 {
    from_albedo(coefficients_below(entry, refractive_index), surface_albedo)
}

/// A of the medium whose single-scattering albedo is `single_scattering_albedo` below such a boundary: the inverse of
/// [`from_surface_albedo_below`].
pub fn to_surface_albedo_below(entry: Entry, refractive_index: f64, single_scattering_albedo: f64) -> f64 {
    to_albedo(coefficients_below(entry, refractive_index), single_scattering_albedo)
}

/// ℓ_d/ℓ of a medium whose single-scattering albedo is α: the diffuse mean free path 1/σtr over the mean free path 1/σt.
///
/// σtr = √(σa/D) with D = (σt + σa)/(3σt²) (\[CB15\] eq. 7, after Grosjean), so ℓ_d/ℓ = √((2 - α)/(3(1 - α))): infinite
/// at α = 1.
pub fn diffuse_per_mean_free_path(single_scattering_albedo: f64) -> f64 {
    let absorption = 1.0 - single_scattering_albedo;
    ((1.0 + absorption) / (3.0 * absorption)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    const ENTRIES: [Entry; 2] = [Entry::Searchlight, Entry::Diffuse];

    /// A, α for searchlight entry, α for diffuse entry: exact, from Chandrasekhar's H functions.
    const EXACT: [(f64, f64, f64); 13] = [
        (0.005, 0.0319275722, 0.0241073508),
        (0.045, 0.2464555288, 0.1951617682),
        (0.050, 0.2689552547, 0.2141022169),
        (0.055, 0.2906440085, 0.2325565545),
        (0.200, 0.6857461748, 0.6096750763),
        (0.350, 0.8580285956, 0.8077458584),
        (0.500, 0.9381719387, 0.9113361304),
        (0.650, 0.9765894326, 0.9650376395),
        (0.800, 0.9938825994, 0.9905847792),
        (0.900, 0.9986617439, 0.9979070223),
        (0.950, 0.9996858422, 0.9995051832),
        (0.990, 0.9999880309, 0.9999810485),
        (0.995, 0.9999970256, 0.9999952874),
    ];

    #[test]
    fn agrees_with_the_h_functions() {
        for (surface_albedo, searchlight, diffuse) in EXACT {
            // The fit's own greatest errors over 200 albedos: 2.87e-4 at A = 0.045 and 7.27e-5 at A = 0.055.
            for (entry, exact, bound) in
                [(Entry::Searchlight, searchlight, 2.9e-4), (Entry::Diffuse, diffuse, 7.3e-5)]
            {
                let alpha = from_surface_albedo(entry, surface_albedo);
                assert!(
                    (alpha - exact).abs() < bound,
                    "{entry:?} at A = {surface_albedo}: {alpha}, not {exact}"
                );
            }
        }
    }

    #[test]
    fn both_ends_are_exact_both_ways() {
        for entry in ENTRIES {
            for end in [0.0, 1.0] {
                assert_eq!(from_surface_albedo(entry, end), end);
                assert_eq!(to_surface_albedo(entry, end), end);
            }
            assert_eq!(from_surface_albedo(entry, -1.0), 0.0);
            assert_eq!(from_surface_albedo(entry, 2.0), 1.0);
            assert_eq!(to_surface_albedo(entry, -1.0), 0.0);
            assert_eq!(to_surface_albedo(entry, 2.0), 1.0);
            assert!(from_surface_albedo(entry, f64::NAN).is_nan());
            assert!(to_surface_albedo(entry, f64::NAN).is_nan());
        }
    }

    #[test]
    fn below_a_boundary_less_returns() {
        // Jensen et al. 2001, figure 5, at η = 1.3 and 1.5: albedos of 262 144 walks each, ± 0.003.
        let cases: [(f64, [[f64; 3]; 3]); 5] = [
            (1.3, [[1.09, 1.59, 1.79], [0.013, 0.07, 0.145], [0.635, 0.437, 0.340]]),
            (1.3, [[2.29, 2.39, 1.97], [0.003, 0.0034, 0.046], [0.856, 0.850, 0.538]]),
            (1.3, [[0.68, 0.70, 0.55], [0.0024, 0.009, 0.12], [0.776, 0.625, 0.198]]),
            (1.3, [[2.55, 3.21, 3.77], [0.0011, 0.0024, 0.014], [0.914, 0.889, 0.771]]),
            (1.5, [[2.19, 2.62, 3.00], [0.0021, 0.0041, 0.0071], [0.838, 0.799, 0.761]]),
        ];
        for (index, [scattering, absorption, expected]) in cases {
            for channel in 0..3 {
                let alpha = scattering[channel] / (scattering[channel] + absorption[channel]);
                let found = to_surface_albedo_below(Entry::Searchlight, index, alpha);
                assert!((found - expected[channel]).abs() < 0.004, "{found}, not {}", expected[channel]);
            }
        }
    }

    #[test]
    fn below_a_boundary_the_laws_hold_too() {
        for entry in ENTRIES {
            for index in [1.0, 1.05, 1.1, 1.33, 1.4, 1.55, 1.7, 2.0, 3.0] {
                let from = |a| from_surface_albedo_below(entry, index, a);
                let to = |alpha| to_surface_albedo_below(entry, index, alpha);
                assert_eq!([from(0.0), from(1.0), to(0.0), to(1.0)], [0.0, 1.0, 0.0, 1.0]);
                let mut last = 0.0;
                for step in 1..1000 {
                    let a = f64::from(step) / 1000.0;
                    let alpha = from(a);
                    assert!(alpha > last && alpha < 1.0, "{entry:?} {index} {a}: {alpha} after {last}");
                    // What is left of A where α nears 1: ε/2q.
                    assert!((to(alpha) - a).abs() < 1e-11, "{entry:?} {index} {a}: {}", to(alpha));
                    last = alpha;
                }
                // Where more is reflected back into the medium, less leaves it.
                assert!(index == 1.0 || to(0.9) < to_surface_albedo(entry, 0.9));
            }
        }
    }

    #[test]
    fn both_ways_increase_and_stay_in_the_unit_interval() {
        for entry in ENTRIES {
            for convert in [from_surface_albedo, to_surface_albedo] {
                let mut last = 0.0;
                for step in 1..=10_000 {
                    let next = convert(entry, f64::from(step) / 10_000.0);
                    assert!(next > last && next <= 1.0, "{entry:?} step {step}: {next} after {last}");
                    last = next;
                }
            }
        }
    }

    #[test]
    fn the_way_back_returns() {
        for entry in ENTRIES {
            for exponent in [1e-300, 1e-100, 1e-12, 1e-6] {
                let back = to_surface_albedo(entry, from_surface_albedo(entry, exponent));
                // Some ten roundings, none of them amplified near 0.
                assert!((back / exponent - 1.0).abs() < 1e-14, "{entry:?} {exponent}: {back}");
            }
            for step in 0..=1000 {
                let surface_albedo = f64::from(step) / 1000.0;
                let alpha = from_surface_albedo(entry, surface_albedo);
                let back = to_surface_albedo(entry, alpha);
                // One rounding of α near 1 moves q = √(1 - α) by ε/2q, and A by less than twice that; where q
                // itself is below √ε, no more than √ε is left. 8 for the other roundings.
                let q = (1.0 - alpha).sqrt();
                let bound = 8.0 * f64::EPSILON / q.max(f64::EPSILON.sqrt());
                assert!((back - surface_albedo).abs() < bound, "{entry:?} {surface_albedo}: {back}");
            }
        }
    }
}
