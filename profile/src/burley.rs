//! Burley's normalised diffusion.
//!
//! Source: Christensen and Burley 2015, \[CB15\].

use crate::description::{Coefficient, Description, Function, Notation, ProfileModel, Published, Variable};
use crate::radial_profile::{legal_radius, legal_u};
use crate::single_scattering_albedo::Entry;
use crate::{Channel, Length, Medium, ModelError, RadialProfile, Requirement};
use std::f64::consts::PI;
use std::slice::from_mut;

/// How the shape s of Burley's profile depends on the surface albedo A:
/// s(A) = constant + slope·A + amplitude·|A - pivot|^exponent.
///
/// All coefficients are dimensionless. The larger s, the narrower the profile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BurleyShape {
    /// The term that does not depend on A.
    pub constant: f64,
    /// Factor of A.
    pub slope: f64,
    /// Factor of the power.
    pub amplitude: f64,
    /// The surface albedo about which the power is symmetric.
    pub pivot: f64,
    /// The exponent of the power.
    pub exponent: f64,
}

impl BurleyShape {
    /// \[CB15\] eq. (5): perpendicular entry, per mean free path. s = 1.85 - A + 7|A - 0.8|³.
    pub const SEARCHLIGHT: BurleyShape =
        BurleyShape { constant: 1.85, slope: -1.0, amplitude: 7.0, pivot: 0.8, exponent: 3.0 };

    /// \[CB15\] eq. (6): diffuse entry, per mean free path. s = 1.9 - A + 3.5(A - 0.8)².
    pub const DIFFUSE: BurleyShape =
        BurleyShape { constant: 1.9, slope: -1.0, amplitude: 3.5, pivot: 0.8, exponent: 2.0 };

    /// \[CB15\] eq. (8): perpendicular entry, per diffuse mean free path. s = 3.5 + 100(A - 0.33)⁴.
    pub const DIFFUSE_MEAN_FREE_PATH: BurleyShape =
        BurleyShape { constant: 3.5, slope: 0.0, amplitude: 100.0, pivot: 0.33, exponent: 4.0 };

    /// s(A), dimensionless.
    pub fn at(&self, surface_albedo: f64) -> f64 {
        let power = (surface_albedo - self.pivot).abs().powf(self.exponent);
        self.constant + self.slope * surface_albedo + self.amplitude * power
    }
}

/// Burley's normalised diffusion, \[CB15\] eq. (3): R(r) = A·(e^(-r/d) + e^(-r/3d))/(8πdr), d = length/s(A).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BurleyModel {
    /// The length that d is a fraction of.
    pub length: Length,
    /// s(A), fitted for that length.
    pub shape: BurleyShape,
}

impl BurleyModel {
    /// Perpendicular entry, parametrized by the mean free path: \[CB15\] eq. (5).
    pub const SEARCHLIGHT: BurleyModel =
        BurleyModel { length: Length::MeanFreePath, shape: BurleyShape::SEARCHLIGHT };

    /// Diffuse entry, parametrized by the mean free path: \[CB15\] eq. (6).
    pub const DIFFUSE: BurleyModel =
        BurleyModel { length: Length::MeanFreePath, shape: BurleyShape::DIFFUSE };

    /// Perpendicular entry, parametrized by the diffuse mean free path: \[CB15\] eq. (8).
    pub const DIFFUSE_MEAN_FREE_PATH: BurleyModel =
        BurleyModel { length: Length::DiffuseMeanFreePath, shape: BurleyShape::DIFFUSE_MEAN_FREE_PATH };

    /// The profile of a medium whose length is [`self.length`](Self::length).
    pub fn profile(&self, medium: Medium) -> Result<BurleyProfile, ModelError> {
        let surface_albedo = medium.surface_albedo();
        let s = self.shape.at(surface_albedo);
        if !(s > 0.0 && s.is_finite()) {
            return Err(SHAPE_POSITIVE.broken_at(surface_albedo, s));
        }
        let scattering_distance_mm = medium.mean_free_path_mm() / s;
        if !(scattering_distance_mm > 0.0 && scattering_distance_mm.is_finite()) {
            return Err(ModelError::OutOfNumericRange { quantity: "d", surface_albedo });
        }
        Ok(BurleyProfile { surface_albedo, scattering_distance_mm })
    }
}

/// s(A) divides the length.
static SHAPE_POSITIVE: Requirement = Requirement {
    coefficient: "shape",
    wrong: "Burley's s is {}",
    expected: "s(A) must be above 0",
    remedy: "s(A) = constant + slope A + amplitude |A - pivot|^exponent: make `constant` larger",
};

impl ProfileModel for BurleyModel {
    const DESCRIPTION: Description = Description {
        name: "Burley",
        stem: "burley",
        caption: "Burley",
        equation: "R(r) = A (e^(−r/d) + e^(−r/3d))/(8π d r), d = length/s(A), \
                   s(A) = constant + slope A + amplitude |A − pivot|^exponent, above 0",
        notes: "",
        source: "Christensen and Burley 2015, eq. (3)",
        notation: Notation::Fields { key: "parametrization", own: "Fit" },
        example: "Burley(parametrization: Searchlight)",
        lengths: &[Length::MeanFreePath, Length::DiffuseMeanFreePath],
        variable: Variable::SURFACE_ALBEDO,
    };

    const COEFFICIENTS: &'static [Coefficient<Self>] = &[
        Coefficient::<Self>::new("shape.constant", "", "the term that does not depend on A", |m| {
            from_mut(&mut m.shape.constant)
        })
        .member("constant"),
        Coefficient::<Self>::new("shape.slope", "", "factor of A", |m| from_mut(&mut m.shape.slope))
            .member("slope")
            .order(1),
        Coefficient::<Self>::new("shape.amplitude", "", "factor of the power", |m| {
            from_mut(&mut m.shape.amplitude)
        })
        .member("amplitude")
        .order(2),
        Coefficient::<Self>::new("shape.pivot", "", "the A about which the power is symmetric", |m| {
            from_mut(&mut m.shape.pivot)
        })
        .member("pivot")
        .order(3),
        Coefficient::<Self>::new("shape.exponent", "", "exponent of the power", |m| {
            from_mut(&mut m.shape.exponent)
        })
        .member("exponent")
        .order(4),
    ];

    const PUBLISHED: &'static [Published<Self>] = &[
        Published::new(
            "burley_searchlight",
            "Searchlight",
            "Christensen and Burley 2015, eq. (5), perpendicular entry",
            || Self::SEARCHLIGHT,
        )
        .entering(Entry::Searchlight),
        Published::new(
            "burley_diffuse",
            "Diffuse",
            "Christensen and Burley 2015, eq. (6), diffuse entry",
            || Self::DIFFUSE,
        )
        .entering(Entry::Diffuse),
        Published::new(
            "burley_dmfp",
            "DiffuseMeanFreePath",
            "Christensen and Burley 2015, eq. (8), perpendicular entry",
            || Self::DIFFUSE_MEAN_FREE_PATH,
        )
        .entering(Entry::Searchlight),
    ];

    const FUNCTIONS: &'static [Function<Self>] =
        &[Function::<Self>::new("s", "s", |m, surface_albedo| m.shape.at(surface_albedo)).length_power(1)];

    fn boxed_profile(&self, medium: Medium, _channel: Channel) -> Result<Box<dyn RadialProfile>, ModelError> {
        Ok(Box::new(self.profile(medium)?))
    }

    fn length(&self) -> Length {
        self.length
    }

    fn set_length(&mut self, length: Length) {
        self.length = length;
    }

    fn make_constant(&mut self, surface_albedo: f64) {
        let constant = self.shape.at(surface_albedo);
        self.shape = BurleyShape { constant, slope: 0.0, amplitude: 0.0, ..self.shape };
    }
}

/// The member of [`BurleyModel`] that belongs to one medium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BurleyProfile {
    surface_albedo: f64,
    scattering_distance_mm: f64,
}

impl BurleyProfile {
    /// The d of \[CB15\], mm: length/s(A).
    pub fn scattering_distance_mm(&self) -> f64 {
        self.scattering_distance_mm
    }
}

impl RadialProfile for BurleyProfile {
    fn surface_albedo(&self) -> f64 {
        self.surface_albedo
    }

    /// \[CB15\] eq. (3). Infinite at r = 0, as 1/r.
    fn area_pdf(&self, radius_mm: f64) -> f64 {
        self.radial_pdf(radius_mm) / (2.0 * PI * legal_radius(radius_mm))
    }

    /// 2πr times \[CB15\] eq. (3): (e^(-r/d) + e^(-r/3d))/4d.
    fn radial_pdf(&self, radius_mm: f64) -> f64 {
        let x = legal_radius(radius_mm) / self.scattering_distance_mm;
        ((-x).exp() + (-x / 3.0).exp()) / 4.0 / self.scattering_distance_mm
    }

    /// \[CB15\] eq. (11): 1 - ¼e^(-r/d) - ¾e^(-r/3d), summed without the cancellation.
    fn radial_cdf(&self, radius_mm: f64) -> f64 {
        let x = legal_radius(radius_mm) / self.scattering_distance_mm;
        -(0.25 * (-x).exp_m1() + 0.75 * (-x / 3.0).exp_m1())
    }

    fn radial_tail(&self, radius_mm: f64) -> f64 {
        let x = legal_radius(radius_mm) / self.scattering_distance_mm;
        0.25 * (-x).exp() + 0.75 * (-x / 3.0).exp()
    }

    /// Exact, after Golubev 2018, "Efficient Screen-Space Subsurface Scattering Using Burley's Normalized
    /// Diffusion in Real-Time" (\[CB15\] and \[L23\] say that there is no closed form).
    ///
    /// With y = e^(-r/3d), eq. (11) is the cubic y³ + 3y = 4(1 - u), whose real root is
    /// y = 2 sinh(asinh(2(1 - u))/3) by the triple-angle formula 4 sinh³θ + 3 sinh θ = sinh 3θ. Golubev's
    /// G - 1/G is this 2 sinh θ with G = e^θ.
    fn sample_radius(&self, u: f64) -> f64 {
        let u = legal_u(u);
        let q = 1.0 - u;
        let log_y = if u <= 0.5 {
            // y tends to 1, so its logarithm needs 1 - y. θ₁ is the θ of y = 1: sinh 3θ₁ = 2.
            //   1 - y = 2 sinh θ₁ - 2 sinh θ = 4 cosh((θ₁ + θ)/2) sinh((θ₁ - θ)/2)
            //   3(θ₁ - θ) = asinh 2 - asinh 2q = asinh(2√(1 + 4q²) - 2q√5), rationalised with 1 - q² = u(2 - u)
            let theta_1 = 2f64.asinh() / 3.0;
            let difference =
                (4.0 * u * (2.0 - u) / (2.0 * (1.0 + 4.0 * q * q).sqrt() + 2.0 * q * 5f64.sqrt())).asinh()
                    / 3.0;
            let one_minus_y = 4.0 * (theta_1 - 0.5 * difference).cosh() * (0.5 * difference).sinh();
            (-one_minus_y).ln_1p()
        } else {
            (2.0 * ((2.0 * q).asinh() / 3.0).sinh()).ln()
        };
        -3.0 * self.scattering_distance_mm * log_y
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may panic")]

    use super::*;

    #[test]
    fn shapes_are_the_equations_of_the_paper() {
        for step in 0..=100 {
            let a = f64::from(step) / 100.0;
            // powf and the products may round differently, by a few units in the last place of s < 25.
            let close = |x: f64, y: f64| (x - y).abs() < 1e-14;
            assert!(close(BurleyShape::SEARCHLIGHT.at(a), 1.85 - a + 7.0 * (a - 0.8).abs().powi(3)));
            assert!(close(BurleyShape::DIFFUSE.at(a), 1.9 - a + 3.5 * (a - 0.8) * (a - 0.8)));
            assert!(close(BurleyShape::DIFFUSE_MEAN_FREE_PATH.at(a), 3.5 + 100.0 * (a - 0.33).powi(4)));
        }
    }

    #[test]
    fn inverse_agrees_with_golubev() {
        // r = -3d ln(G - 1/G) as published, where it does not cancel.
        let profile = BurleyModel::SEARCHLIGHT.profile(Medium::new(0.5, 2.0).unwrap()).unwrap();
        for step in 1..100 {
            let u = f64::from(step) / 100.0;
            let q = 1.0 - u;
            let g = (2.0 * q + (1.0 + 4.0 * q * q).sqrt()).cbrt();
            let r = -3.0 * profile.scattering_distance_mm() * (g - 1.0 / g).ln();
            // G - 1/G loses up to two digits for these u.
            assert!((profile.sample_radius(u) / r - 1.0).abs() < 1e-13, "{u}");
        }
    }

    #[test]
    fn inverse_is_exact_to_rounding() {
        let profile = BurleyModel::DIFFUSE.profile(Medium::new(0.7, 1.0).unwrap()).unwrap();
        for exponent in 1..300 {
            let small = 10f64.powi(-exponent);
            // Some ten roundings of relative error each.
            let there = profile.radial_cdf(profile.sample_radius(small));
            assert!((there / small - 1.0).abs() < 1e-14, "u = {small}: {there}");
        }
        for bits in 2..=53 {
            let q = 0.5f64.powi(bits);
            let there = profile.radial_tail(profile.sample_radius(1.0 - q));
            // One rounding of r = O(100 d) is multiplied by r/3d in the exponent.
            assert!((there / q - 1.0).abs() < 1e-13, "1 - u = {q}: {there}");
        }
    }

    #[test]
    fn a_shape_that_is_not_positive_is_refused() {
        // The last one is 1 - 0^(-1) = -∞ at the pivot.
        for (constant, amplitude, exponent) in [(0.0, 0.0, 1.0), (-1.0, 0.0, 1.0), (1.0, -1.0, -1.0)] {
            let shape = BurleyShape { constant, slope: 0.0, amplitude, pivot: 0.5, exponent };
            let model = BurleyModel { length: Length::MeanFreePath, shape };
            let error = model.profile(Medium::new(0.5, 1.0).unwrap());
            assert!(
                matches!(
                    error,
                    Err(ModelError::Broken { requirement, surface_albedo: Some(0.5), .. })
                        if *requirement == SHAPE_POSITIVE
                ),
                "{error:?}"
            );
        }
    }
}
