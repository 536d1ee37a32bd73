//! What a half-space reflects, by the angle at which light enters or leaves.

use crate::single_scattering_albedo::{DIFFUSE, Entry, root_below};

/// Coefficients of 1, γ and γ² of p₀, p₁ − 1 and p₂ over 1 − γ; their twins in WGSL take them from here.
pub(crate) const ANGLES: [[f64; 3]; 3] =
    [[0.96856, -0.47994, -0.97081], [-0.25613, 0.15839, 0.24091], [0.05629, -0.04615, -0.04508]];

/// Coefficients of 1, γ and γ² of 1/⟨H⟩ − γ over 1 − γ, ⟨H⟩ = 2 ∫ H(μ) μ dμ: within 4e-4 of exact values, in relation to
/// them. Its twin in WGSL takes them from here.
pub(crate) const MEAN: [f64; 3] = [0.43282, -0.03171, 0.00815];

/// A flat, semi-infinite, index-matched medium that scatters isotropically, as Chandrasekhar 1960, "Radiative Transfer",
/// solves it.
///
/// Light that enters at the cosine μ returns with the share A(μ) = 1 − γ H(μ), γ = √(1 − α): more at a grazing angle than
/// at a steep one. H has no closed form; 1/H is taken as
///
/// 1/H(μ) = γ + (1 − γ) u, u = 1 − μ (p₀ + (p₁ + p₂ μ) ln(1 + 1/μ)),
///
/// with p₀ and p₂ and p₁ − 1 cubic in γ and 0 at γ = 1: the form of Hapke 2002, "Bidirectional Reflectance
/// Spectroscopy 5", with coefficients fitted to exact values. Then A(μ) = (1 − γ) u H(μ), which is within 3.1e-4 of the
/// exact one, in relation to it, for every μ and every α, and u within 6e-4.
///
/// ```
/// use subsurface_profile::HalfSpace;
/// use subsurface_profile::single_scattering_albedo::Entry;
///
/// let skin = HalfSpace::of(Entry::Searchlight, 0.64);
/// assert!(skin.entry(0.2) > 1.2 && (skin.entry(1.0) - 1.0).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace {
    entry: Entry,
    /// γ.
    root: f64,
}

impl HalfSpace {
    /// The medium whose surface albedo is A, clamped to [0, 1], where light enters as `entry` says.
    pub fn of(entry: Entry, surface_albedo: f64) -> Self {
        Self::below(entry, 1.0, surface_albedo)
    }

    /// The medium whose surface albedo below a boundary to a medium of `refractive_index` times less is A. What this type
    /// says of it is as if there were none: cosines are those inside.
    pub fn below(entry: Entry, refractive_index: f64, surface_albedo: f64) -> Self {
        Self { entry, root: root_below(entry, refractive_index, surface_albedo) }
    }

    /// A(μ): share of the light that enters at the cosine μ > 0 and returns, in all directions together.
    pub fn albedo(&self, cosine: f64) -> f64 {
        (1.0 - self.root) * self.relative_albedo(cosine)
    }

    /// Ā = 2 ∫ A(μ) μ dμ: the same of light that enters from everywhere alike.
    pub fn diffuse_albedo(&self) -> f64 {
        (1.0 - self.root) * self.relative_diffuse_albedo()
    }

    /// Light that returns where it enters at the cosine μ, over what a profile of this medium is normalized by: A(μ)/A(1)
    /// where that is for perpendicular entry, A(μ)/Ā where it is for diffuse. At A = 0 the limit.
    pub fn entry(&self, cosine: f64) -> f64 {
        self.relative_albedo(cosine) / self.relative_albedo_of_profile()
    }

    /// The same of light that enters from everywhere alike.
    pub fn diffuse_entry(&self) -> f64 {
        self.relative_diffuse_albedo() / self.relative_albedo_of_profile()
    }

    /// Radiance that leaves at the cosine μ over Lambert's: A(μ)/Ā, as reciprocity demands. 2 ∫ exit(μ) μ dμ is 1.
    pub fn exit(&self, cosine: f64) -> f64 {
        self.relative_albedo(cosine) / self.relative_diffuse_albedo()
    }

    /// Light that enters at the cosine μ and travels far into the medium, over light that enters perpendicularly:
    /// H(μ)/H(1). So much is let through by what is some mean free paths thick.
    pub fn through_entry(&self, cosine: f64) -> f64 {
        self.h(cosine) / self.h(1.0)
    }

    /// Radiance at the cosine μ of light that comes from far within the medium, over Lambert's: H(μ)/⟨H⟩, more at a steep
    /// angle than at a grazing one. 2 ∫ `through_exit`(μ) μ dμ is 1.
    pub fn through_exit(&self, cosine: f64) -> f64 {
        let [c0, c1, c2] = MEAN;
        let lost = 1.0 - self.root;
        self.h(cosine) * (self.root + lost * (c0 + (c1 + c2 * self.root) * self.root))
    }

    /// Light from everywhere alike that a convex body returns, over what a flat one does: light that enters has less of the
    /// medium around it. `curvature` is the body's mean curvature in 1/mean free paths; 0 and less is flat.
    ///
    /// In a ball of radius 1/H diffusion has for the root γ what a half-space has for γ (coth x − 1/x), x = 1/(H ℓ_d). Below
    /// a boundary total reflection returns 1 − 1/η² of what would leave, so that A is (1 − r)Ā/(1 − rĀ). Light that was
    /// scattered once knows nothing of that: the gain counts by α. Without a boundary within 1 % of random walks in balls of
    /// ten mean free paths and more, below one of 1.4 within 0.4 % in balls of thirty to sixty. A = 1 stays 1.
    pub fn convex_gain(&self, refractive_index: f64, curvature: f64) -> f64 {
        if curvature.is_nan() || curvature <= 0.0 {
            return 1.0;
        }
        let root = self.root;
        let x = root * 3.0_f64.sqrt() / (curvature * (1.0 + root * root).sqrt());
        let curved = Self { root: root * langevin(x), ..*self };
        let kept = 1.0 - 1.0 / (refractive_index * refractive_index);
        let leaving = (1.0 - kept * self.diffuse_albedo()) / (1.0 - kept * curved.diffuse_albedo());
        let gain = (1.0 - curved.root) * curved.relative_diffuse_albedo() / self.relative_diffuse_albedo();
        root * root + (1.0 + root) * gain * leaving
    }

    /// H(μ).
    fn h(&self, cosine: f64) -> f64 {
        1.0 / (self.root + (1.0 - self.root) * self.u(cosine))
    }

    /// What light that enters at one cosine and leaves at another has beyond `entry` and `exit`: the reflection function
    /// α H(μ_l) H(μ_v)/(4π (μ_l + μ_v)) over A(μ_l) A(μ_v)/(π Ā). Its mean over either, weighted as the light is, is 1:
    /// light that is scattered once remembers where it came from.
    pub fn pairing(&self, entering: f64, leaving: f64) -> f64 {
        let spread = 4.0 * (entering + leaving) * self.u(entering) * self.u(leaving);
        (1.0 + self.root) * self.relative_diffuse_albedo() / spread
    }

    /// u(μ).
    fn u(&self, cosine: f64) -> f64 {
        let lost = 1.0 - self.root;
        let [p0, p1, p2] = [0, 1, 2]
            .map(|i: usize| lost * (ANGLES[0][i] + (ANGLES[1][i] + ANGLES[2][i] * self.root) * self.root));
        1.0 - cosine * (p0 + (1.0 + p1 + p2 * cosine) * (1.0 / cosine).ln_1p())
    }

    /// A(μ)/(1 − γ), which does not vanish with A.
    fn relative_albedo(&self, cosine: f64) -> f64 {
        let u = self.u(cosine);
        u / (self.root + (1.0 - self.root) * u)
    }

    /// Ā/(1 − γ): (1 − A)(1 + c₁A) = γ (1 + c₂A + c₃A²) solved for A.
    fn relative_diffuse_albedo(&self) -> f64 {
        let [c1, c2, c3] = DIFFUSE;
        let (linear, quadratic) = (1.0 - c1 + c2 * self.root, c1 + c3 * self.root);
        2.0 / (linear + (linear * linear + 4.0 * quadratic * (1.0 - self.root)).sqrt())
    }

    fn relative_albedo_of_profile(&self) -> f64 {
        match self.entry {
            Entry::Searchlight => self.relative_albedo(1.0),
            Entry::Diffuse => self.relative_diffuse_albedo(),
        }
    }
}

/// coth x − 1/x for x ≥ 0, of Langevin.
fn langevin(x: f64) -> f64 {
    if x < 1e-2 { x / 3.0 } else { 1.0 / x.tanh() - 1.0 / x }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn balls_return_what_walks_do() {
        // Random walks in balls of 10, 40 and 100 000 mean free paths under an even sky: α, their means, ± 3e-4 each.
        for (alpha, at_10, at_40, flat) in [
            (0.45, 0.14766, 0.13074, 0.12646),
            (0.85, 0.45905, 0.41426, 0.40110),
            (0.98, 0.82108, 0.74725, 0.72313_f64),
        ] {
            let medium = HalfSpace { entry: Entry::Diffuse, root: (1.0_f64 - alpha).sqrt() };
            for (radius, found) in [(10.0, at_10), (40.0, at_40)] {
                let gain = medium.convex_gain(1.0, 1.0 / radius);
                assert!(
                    (gain * flat / found - 1.0).abs() < 0.01,
                    "{alpha}, {radius}: {gain}, not {}",
                    found / flat
                );
            }
        }
        // Skin below a smooth boundary of 1.4, balls of 40 mm: mean free path, gains, ± 1.5e-3.
        for (albedo, length, gain) in [(0.83, 1.3, 1.077), (0.64, 0.95, 1.053), (0.55, 0.67, 1.034)] {
            let found = HalfSpace::below(Entry::Searchlight, 1.4, albedo).convex_gain(1.4, length / 40.0);
            assert!((found / gain - 1.0).abs() < 4e-3, "{albedo}: {found}, not {gain}");
        }
    }

    #[test]
    fn a_flat_body_and_a_white_one_gain_nothing() {
        for albedo in ALBEDOS {
            for index in [1.0, 1.4] {
                let medium = HalfSpace::below(Entry::Diffuse, index, albedo);
                for flat in [0.0, -1.0, f64::NAN] {
                    assert_eq!(medium.convex_gain(index, flat), 1.0);
                }
                let mut before = 1.0;
                for curvature in [1e-6, 1e-3, 0.1, 1.0, 1e3] {
                    let gain = medium.convex_gain(index, curvature);
                    assert!(gain >= before - 1e-12 && gain.is_finite(), "{albedo}: {gain} at {curvature}");
                    before = gain;
                }
                assert!(albedo * before <= 1.0 + 1e-9, "{albedo}: {before} times as much");
            }
        }
        assert!((HalfSpace::of(Entry::Diffuse, 1.0).convex_gain(1.0, 1.0) - 1.0).abs() < 1e-12);
    }

    const ALBEDOS: [f64; 8] = [0.0, 1e-6, 0.1, 0.3, 0.55, 0.83, 0.98, 1.0];
    const ENTRIES: [Entry; 2] = [Entry::Searchlight, Entry::Diffuse];

    /// 2 ∫ f(μ) μ dμ by the midpoint rule: functions bend as μ ln μ at 0, where the weight is small.
    fn mean(f: impl Fn(f64) -> f64) -> f64 {
        const STEPS: u32 = 2000;
        let cosine = |step: u32| (f64::from(step) + 0.5) / f64::from(STEPS);
        (0..STEPS).map(|step| 2.0 * cosine(step) * f(cosine(step))).sum::<f64>() / f64::from(STEPS)
    }

    #[test]
    fn light_from_far_within_leaves_as_one() {
        for entry in ENTRIES {
            for albedo in ALBEDOS {
                let medium = HalfSpace::of(entry, albedo);
                let exit = mean(|cosine| medium.through_exit(cosine));
                // The errors of H and of its mean together.
                assert!((exit - 1.0).abs() < 1e-3, "{entry:?} {albedo}: {exit}");
                assert_eq!(medium.through_entry(1.0), 1.0);
                // H grows with the cosine, and is 1 everywhere where nothing is scattered.
                let steeper = medium.through_entry(0.9) - medium.through_entry(0.3);
                assert!(if albedo == 0.0 { steeper.abs() < 1e-12 } else { steeper > 0.0 });
            }
        }
    }

    #[test]
    fn albedos_are_chandrasekhars() {
        // α = 0.9, by H functions. `tests/conformance` has all the others.
        let medium = HalfSpace { entry: Entry::Searchlight, root: 0.1_f64.sqrt() };
        for (cosine, exact) in [(1.0, 0.41495), (0.5, 0.50794), (0.2, 0.59161)] {
            assert!(
                (medium.albedo(cosine) / exact - 1.0).abs() < 5e-4,
                "{} at {cosine}",
                medium.albedo(cosine)
            );
        }
    }

    #[test]
    fn what_enters_from_everywhere_is_the_mean() {
        for (entry, albedo) in ENTRIES.iter().flat_map(|entry| ALBEDOS.map(|albedo| (*entry, albedo))) {
            let medium = HalfSpace::of(entry, albedo);
            // The fit of H, and that of the conversion.
            let exit = mean(|cosine| medium.exit(cosine));
            assert!((exit - 1.0).abs() < 2e-3, "{medium:?}: {exit}");
            let entered = mean(|cosine| medium.entry(cosine)) / medium.diffuse_entry();
            assert!((entered - 1.0).abs() < 2e-3, "{medium:?}: {entered}");
        }
    }

    #[test]
    fn pairs_share_what_enters_and_are_reciprocal() {
        for (entry, albedo) in ENTRIES.iter().flat_map(|entry| ALBEDOS.map(|albedo| (*entry, albedo))) {
            let medium = HalfSpace::of(entry, albedo);
            for entering in [0.05, 0.2, 0.5, 1.0] {
                let left = mean(|leaving| medium.exit(leaving) * medium.pairing(entering, leaving));
                // The fits of u at both angles, and of the conversion.
                assert!((left - 1.0).abs() < 2e-3, "{medium:?} at {entering}: {left}");
                let [there, back] = [medium.pairing(entering, 0.3), medium.pairing(0.3, entering)];
                assert!((there / back - 1.0).abs() < 1e-14, "{medium:?} at {entering}: {there}, {back}");
            }
        }
    }

    #[test]
    fn a_profile_is_for_its_own_entry() {
        for albedo in ALBEDOS {
            assert!((HalfSpace::of(Entry::Searchlight, albedo).entry(1.0) - 1.0).abs() < 1e-15);
            assert!((HalfSpace::of(Entry::Diffuse, albedo).diffuse_entry() - 1.0).abs() < 1e-15);
            // The fit of the conversion from A to α is within 2.9e-4 of α.
            let searchlight = HalfSpace::of(Entry::Searchlight, albedo);
            assert!((searchlight.albedo(1.0) - albedo).abs() < 1.5e-3, "{searchlight:?}");
        }
    }

    #[test]
    fn white_is_lamberts_and_grazing_light_returns_more() {
        for entry in ENTRIES {
            let white = HalfSpace::of(entry, 1.0);
            for cosine in [1e-3, 0.1, 0.5, 1.0] {
                assert!(
                    (white.entry(cosine) - 1.0).abs() < 1e-12 && (white.exit(cosine) - 1.0).abs() < 1e-12
                );
            }
            for albedo in &ALBEDOS[..7] {
                let medium = HalfSpace::of(entry, *albedo);
                let factors = [1e-4, 0.01, 0.1, 0.3, 0.6, 1.0].map(|cosine| medium.entry(cosine));
                assert!(factors.windows(2).all(|pair| pair[0] > pair[1]), "{medium:?}: {factors:?}");
            }
        }
    }
}
