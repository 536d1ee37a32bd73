//! What becomes of the edge of a shadow.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::RadialProfile;
use crate::quadrature::Quadrature;

/// Radii are told apart at these tails of the profile, so that the integrand is smooth and of one scale between
/// them even where the profile spans many decades.
const BREAKPOINT_TAILS: [f64; 10] = [1e-15, 1e-12, 1e-9, 1e-7, 1e-5, 1e-3, 0.03, 0.2, 0.5, 0.9];

/// The edge-spread function of a profile: how bright a half-lit plane is at a distance from the edge.
///
/// A half plane is lit uniformly, the other is dark. Of the energy that leaves at a signed distance x from the
/// edge (positive on the lit side), the fraction that entered through the lit half is, with X = |x|,
///
/// ESF(x) = 1/2 + sign(x)·(1/2 - (1/π) ∫ radial_pdf(r) acos(X/r) dr), r from X to ∞:
///
/// the circle of radius r about the point has 2 acos(X/r) of its 2π beyond the edge. Integrated by parts and
/// with r = X/sin φ, the integral becomes ∫ radial_tail(X/sin φ) dφ from 0 to π/2, which has no singularity.
#[derive(Clone, Debug)]
pub struct EdgeSpread<'a> {
    profile: &'a dyn RadialProfile,
    truncation_radius_mm: f64,
    /// Tail of the profile at the truncation radius.
    truncated_tail: f64,
    /// Radii in mm at which the integration is split, decreasing.
    breakpoints_mm: Vec<f64>,
}

impl<'a> EdgeSpread<'a> {
    /// The edge-spread function of the whole profile.
    pub fn new(profile: &'a dyn RadialProfile) -> Self {
        Self::truncated(profile, f64::INFINITY)
    }

    /// The edge-spread function of the profile cut off at `radius_mm` and normalised again, which is what a
    /// filter of that radius converges to.
    ///
    /// A radius of 0 or less leaves the edge as sharp as it was.
    pub fn truncated(profile: &'a dyn RadialProfile, radius_mm: f64) -> Self {
        let truncated_tail = if radius_mm == f64::INFINITY { 0.0 } else { profile.radial_tail(radius_mm) };
        let quantiles = BREAKPOINT_TAILS.map(|tail| profile.sample_radius(1.0 - tail));
        let mut breakpoints_mm: Vec<f64> = [radius_mm]
            .into_iter()
            .chain(profile.max_radius())
            .chain(quantiles)
            .filter(|r| r.is_finite())
            .collect();
        breakpoints_mm.sort_by(|a, b| b.total_cmp(a));
        EdgeSpread { profile, truncation_radius_mm: radius_mm, truncated_tail, breakpoints_mm }
    }

    /// Fraction in [0, 1] of the energy at the signed distance that came from the lit half plane.
    ///
    /// `signed_distance_mm` is positive on the lit side; ESF(0) = 1/2 and ESF(-x) = 1 - ESF(x). The integral is
    /// good to 1e-10.
    pub fn at(&self, signed_distance_mm: f64) -> f64 {
        let distance = signed_distance_mm.abs();
        if distance == 0.0 {
            return 0.5;
        }
        let mut angles = vec![0.0];
        angles.extend(self.breakpoints_mm.iter().filter(|r| **r > distance).map(|r| (distance / r).asin()));
        angles.push(FRAC_PI_2);
        let beyond =
            Quadrature::default().integrate_between(|phi| self.tail(distance / phi.sin()), &angles) / PI;
        0.5 + signed_distance_mm.signum() * (0.5 - beyond)
    }

    /// Tail of the truncated profile.
    fn tail(&self, radius_mm: f64) -> f64 {
        if radius_mm >= self.truncation_radius_mm {
            return 0.0;
        }
        let within = 1.0 - self.truncated_tail;
        ((self.profile.radial_tail(radius_mm) - self.truncated_tail) / within).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may panic")]

    use super::*;
    use crate::{Channel, GaussianSumModel, GaussianTerm, Medium, Model};

    fn all() -> impl Iterator<Item = (&'static str, Box<dyn RadialProfile>)> {
        Model::PUBLISHED.into_iter().flat_map(|stem| {
            [0.0, 0.5, 0.95, 1.0].map(|surface_albedo| {
                let medium = Medium::new(surface_albedo, 1.3).unwrap();
                (stem, Model::published(stem).unwrap().profile(medium, Channel::Red).unwrap())
            })
        })
    }

    #[test]
    fn a_gaussian_spreads_an_edge_into_the_normal_distribution() {
        let term = GaussianTerm { variance_mm2: 4.0, weight: [1.0; 3] };
        let model = GaussianSumModel { terms: vec![term] };
        let profile = model.profile(Medium::new(0.5, 1.0).unwrap(), Channel::Red).unwrap();
        // Φ(x), Abramowitz and Stegun, table 26.1.
        for (deviations, phi) in [
            (0.1, 0.539_827_837_277_029),
            (1.0, 0.841_344_746_068_542_9),
            (2.0, 0.977_249_868_051_820_8),
            (4.0, 0.999_968_328_758_166_9),
        ] {
            let esf = EdgeSpread::new(&profile).at(2.0 * deviations);
            assert!((esf - phi).abs() < 1e-10, "{deviations} standard deviations: {esf}");
        }
    }

    #[test]
    fn it_is_the_integral_it_was_derived_from() {
        for (stem, profile) in all() {
            for distance in [1e-3, 0.1, 1.0, 5.0] {
                // (1/π) ∫ radial_pdf(r) acos(X/r) dr, with r = X + t² against the root at r = X.
                let end = profile.sample_radius(1.0 - 1e-8);
                let ends: Vec<f64> = [0.0, 1e-2, 0.1, 0.3, 1.0, 3.0, 10.0, 1e2, 1e3, 1e4]
                    .into_iter()
                    .chain(profile.max_radius().map(|r| (r - distance).max(0.0).sqrt()))
                    .filter(|t| *t * *t < end - distance)
                    .chain([(end - distance).max(0.0).sqrt()])
                    .collect();
                let mut ends = ends;
                ends.sort_by(f64::total_cmp);
                let beyond = Quadrature::default().integrate_between(
                    |t| {
                        let r = distance + t * t;
                        profile.radial_pdf(r) * (distance / r).acos() * 2.0 * t
                    },
                    &ends,
                ) / PI;
                // The part left out holds 1e-8 of the energy, half of it beyond the edge.
                let esf = EdgeSpread::new(&*profile).at(distance);
                assert!(
                    (esf - (1.0 - beyond)).abs() < 1e-8,
                    "{stem} at {distance}: {esf} and {}",
                    1.0 - beyond
                );
            }
        }
    }

    #[test]
    fn it_rises_from_dark_to_lit_and_is_odd_about_one_half() {
        for (stem, profile) in all() {
            for truncation in [0.3, 10.0, f64::INFINITY] {
                let edge = EdgeSpread::truncated(&*profile, truncation);
                assert_eq!(edge.at(0.0), 0.5);
                let mut last = 0.5;
                for exponent in -8..=8 {
                    let x = 10f64.powi(exponent);
                    let here = edge.at(x);
                    // Two integrals of error 1e-10 each.
                    assert!(here >= last - 2e-10 && here <= 1.0, "{stem} at {x}: {here} after {last}");
                    assert!((here + edge.at(-x) - 1.0).abs() < 1e-15, "{stem} at {x}");
                    last = here;
                }
                // Near the edge it joins 1/2 with a finite slope (times a logarithm, as R has a pole at 0).
                assert!(edge.at(1e-9) - 0.5 < 1e-6, "{stem}");
                if truncation.is_finite() {
                    assert_eq!(edge.at(truncation), 1.0, "{stem}: nothing comes from beyond the truncation");
                }
            }
        }
    }

    #[test]
    fn truncation_at_nothing_and_at_everything() {
        for (_, profile) in all() {
            let sharp = EdgeSpread::truncated(&*profile, 0.0);
            assert_eq!([sharp.at(-0.1), sharp.at(0.0), sharp.at(0.1)], [0.0, 0.5, 1.0]);
            let whole = EdgeSpread::new(&*profile);
            let far = EdgeSpread::truncated(&*profile, 1e15);
            // At A = 1 the dipole leaves 1e-15 of its energy out there; the integrals are good to 1e-10.
            assert!((whole.at(0.7) - far.at(0.7)).abs() < 1e-9);
        }
    }
}
