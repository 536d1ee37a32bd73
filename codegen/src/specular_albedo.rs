//! How much of the light the specular lobe sends back, by angle and roughness: baked, as its integral has no closed form.
//!
//! With Schlick's Fresnel term the share is E(μ) = F₀ a + F₉₀ b, so two functions of cosine and roughness serve every
//! reflectance at normal incidence.

use std::f64::consts::PI;
use std::sync::LazyLock;

use subsurface_kernel::constants::{LEAST_ROUGHNESS, LEAST_VIEW_COSINE};
use subsurface_quality::gather::curve::{Knots, STEPS, fraction};

/// Roughnesses that have a row of their own, from 0 to 1.
pub(crate) const ROUGHNESSES: usize = 32;

/// Points per axis of the integral. Its integrand is smooth but for a bend at the horizon: sums are within 3e-4.
const POINTS: usize = 32;

/// a and b.
type Shares = [f64; 2];

/// The functions at 64 steps of the cosine's root, for each roughness: they are steepest where light grazes.
static SHARES: LazyLock<Vec<[Knots; 2]>> = LazyLock::new(|| {
    let of_roughness = |number: usize| {
        let roughness = number as f64 / (ROUGHNESSES - 1) as f64;
        let shares: [Shares; STEPS + 1] =
            std::array::from_fn(|step| shares(fraction(step).powi(2), roughness));
        [0, 1].map(|part: usize| shares.map(|shares| shares[part]))
    };
    (0..ROUGHNESSES).map(of_roughness).collect()
});

/// a, then b, for each roughness.
pub(crate) fn by_cosine() -> [Vec<Knots>; 2] {
    [0, 1].map(|part: usize| SHARES.iter().map(|shares| shares[part]).collect())
}

/// 2 ∫ a μ dμ, then 2 ∫ b μ dμ, at 64 steps of the roughness: what is straight between two rows is so in the mean.
pub(crate) fn means() -> [Knots; 2] {
    [0, 1].map(|part: usize| {
        std::array::from_fn(|step| {
            let place = fraction(step) * (ROUGHNESSES - 1) as f64;
            let row = (place as usize).min(ROUGHNESSES - 2);
            let [own, next] = [row, row + 1].map(|row| mean(&SHARES[row][part]));
            own + (place - row as f64) * (next - own)
        })
    })
}

/// 2 ∫ f μ dμ = 4 ∫ f t³ dt of a function that is straight between its knots in t = √μ.
fn mean(knots: &Knots) -> f64 {
    let step = 1.0 / STEPS as f64;
    let of_step = |index: usize| {
        // Simpson's rule is exact for cubes; the straight line times one has a term more, of 1e-7.
        let [start, end] = [index, index + 1].map(|index| 4.0 * fraction(index).powi(3) * knots[index]);
        let middle = 4.0 * (fraction(index) + 0.5 * step).powi(3) * 0.5 * (knots[index] + knots[index + 1]);
        step / 6.0 * (start + 4.0 * middle + end)
    };
    (0..STEPS).map(of_step).sum()
}

/// a and b of the lobe of `shaders/light/specular.wgsl`, seen at a cosine.
///
/// ∫ D V F μ_l dω_l over half vectors, dω_l = 4 (v·h) dω_h, which are drawn as D (n·h) has them:
/// tan²θ = α² u/(1 − u), with more points where u nears 1, the tail of D: 1 − u = (1 − s)². What is left is
/// 4 V F μ_l (v·h)/(n·h) · du/ds.
fn shares(cosine: f64, roughness: f64) -> Shares {
    let alpha = roughness.max(LEAST_ROUGHNESS).powi(2);
    let view = cosine.max(LEAST_VIEW_COSINE);
    let sine = (1.0 - view * view).max(0.0).sqrt();
    let k = (roughness + 1.0).powi(2) / 8.0;
    let masked = |cosine: f64| cosine * (1.0 - k) + k;
    let mut sums = [0.0; 2];
    for place in 0..POINTS * POINTS {
        let [s, turn] = [place / POINTS, place % POINTS].map(|at| (at as f64 + 0.5) / POINTS as f64);
        let beyond = (1.0 - s).powi(2);
        let half = (beyond / (beyond + alpha * alpha * (1.0 - beyond))).sqrt();
        let across = (1.0 - half * half).max(0.0).sqrt();
        // Both halves of the turn are alike.
        let view_half = view * half + sine * across * (PI * turn).cos();
        let light = 2.0 * view_half * half - view;
        if light <= 0.0 || view_half <= 0.0 {
            continue;
        }
        let weight = 2.0 * (1.0 - s) * light * view_half / (half * masked(light) * masked(view));
        let grazing = (1.0 - view_half).powi(5);
        sums[0] += weight * (1.0 - grazing);
        sums[1] += weight * grazing;
    }
    sums.map(|sum| sum / (POINTS * POINTS) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_those_of_a_finer_integral() {
        // F₀ = 0.028: E at five cosines and its mean, by another program.
        const F0: f64 = 0.028;
        for (roughness, exact, mean_exact) in [
            (0.2, [0.0279, 0.0263, 0.0418, 0.0893, 0.0851], 0.0396),
            (0.4, [0.0261, 0.0245, 0.0338, 0.0546, 0.0627], 0.0316),
            (0.8, [0.0145, 0.0154, 0.0184, 0.0249, 0.0362], 0.0175),
        ] {
            let share = |cosine: f64| {
                let [a, b] = shares(cosine, roughness);
                F0 * a + b
            };
            for (cosine, exact) in [1.0, 0.7, 0.5, 0.3, 0.1].into_iter().zip(exact) {
                assert!((share(cosine) - exact).abs() < 2e-4, "{} at {cosine}, {roughness}", share(cosine));
            }
            let knots: Knots = std::array::from_fn(|step| share(fraction(step).powi(2)));
            assert!((mean(&knots) - mean_exact).abs() < 2e-4, "{} of {roughness}", mean(&knots));
        }
    }

    #[test]
    fn no_lobe_sends_back_more_than_arrives() {
        for [a, b] in &*SHARES {
            assert!(a.iter().zip(b).all(|(a, b)| *a >= 0.0 && *b >= 0.0 && a + b <= 1.0), "{a:?}");
        }
    }
}
