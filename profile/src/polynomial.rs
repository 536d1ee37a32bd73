//! The rational profile that Liang et al. call polynomial.
//!
//! Source: Liang, Gao, Cong and Hao 2023, \[L23\].

use std::f64::consts::PI;
use std::slice::from_mut;

use crate::description::{
    Argument, Coefficient, Description, Function, Notation, ProfileModel, Published, Variable,
};
use crate::inverse::increasing_root;
use crate::radial_profile::{legal_radius, legal_u};
use crate::single_scattering_albedo::{Entry, from_surface_albedo};
use crate::{Channel, Length, Medium, ModelError, RadialProfile, Requirement};

/// Coefficient a(α) of \[L23\] eq. (7) at ℓ = 1, by eq. (11): linear·α + amplitude·10^(decades·(α - 1)).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolynomialA {
    /// Factor of α.
    pub linear: f64,
    /// Value of the second term at α = 1.
    pub amplitude: f64,
    /// Decades that the second term falls from α = 1 to α = 0.
    pub decades: f64,
}

impl PolynomialA {
    /// \[L23\] eq. (11). Printed as 0.1^(-30(α - 1)), which is 10^(30(α - 1)).
    pub const LIANG_2023: PolynomialA = PolynomialA { linear: -0.0064, amplitude: 0.00316, decades: 30.0 };

    /// a at ℓ = 1; divide by the mean free path.
    pub fn at(&self, single_scattering_albedo: f64) -> f64 {
        let alpha = single_scattering_albedo;
        self.linear * alpha + self.amplitude * 10f64.powf(self.decades * (alpha - 1.0))
    }
}

/// Coefficient b(α) of \[L23\] eq. (7), by eq. (12), (13): scale·α^((curvature·(α - pivot)² + offset)·α + exponent).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolynomialB {
    /// b at α = 1. The paper's k₁.
    pub scale: f64,
    /// Factor of the square in the exponent.
    pub curvature: f64,
    /// The α about which the square is symmetric.
    pub pivot: f64,
    /// Added to the square.
    pub offset: f64,
    /// The exponent at α = 0.
    pub exponent: f64,
}

impl PolynomialB {
    /// \[L23\] eq. (13) with k₁ = 0.0635 in place of the printed 0.461.
    ///
    /// Refitting with the paper's own procedure reproduces its a and c, and gives this k₁. With it the fit
    /// integrates to 0.95–1.06 of A before it is normalised (α from 0.1 to 0.999); with the printed one to 13–15
    /// times A.
    pub const LIANG_2023: PolynomialB =
        PolynomialB { scale: 0.0635, curvature: 6.7, pivot: 0.45, offset: 2.6, exponent: 1.3 };

    /// \[L23\] eq. (12), (13) as printed.
    pub const LIANG_2023_PRINTED: PolynomialB = PolynomialB { scale: 0.461, ..Self::LIANG_2023 };

    /// b; it does not depend on the mean free path.
    pub fn at(&self, single_scattering_albedo: f64) -> f64 {
        let alpha = single_scattering_albedo;
        let square = self.curvature * (alpha - self.pivot) * (alpha - self.pivot);
        self.scale * alpha.powf((square + self.offset) * alpha + self.exponent)
    }
}

/// Coefficient c(α) of \[L23\] eq. (7) at ℓ = 1, by eq. (14), (15): amplitude·e^(rate·α) + offset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolynomialC {
    /// Factor of the exponential.
    pub amplitude: f64,
    /// Growth of the exponential with α.
    pub rate: f64,
    /// The part that does not depend on α.
    pub offset: f64,
}

impl PolynomialC {
    /// \[L23\] eq. (14), (15).
    pub const LIANG_2023: PolynomialC = PolynomialC { amplitude: 0.0097, rate: 4.2, offset: 0.166 };

    /// c at ℓ = 1; multiply by the mean free path.
    pub fn at(&self, single_scattering_albedo: f64) -> f64 {
        self.amplitude * (self.rate * single_scattering_albedo).exp() + self.offset
    }
}

/// Liang et al. 2023, \[L23\] eq. (7): r·R(r) = (a r + b)/(r + c) for r < r_max = -b/a, and 0 beyond.
///
/// The paper prints r_max = -a/b, which is neither a zero of eq. (7) nor a length. The profile is divided by
/// its integral up to r_max (eq. (18)). α comes from the surface albedo by
/// [`from_surface_albedo`] for searchlight entry, the paper's setting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolynomialModel {
    /// a(α).
    pub a: PolynomialA,
    /// b(α).
    pub b: PolynomialB,
    /// c(α).
    pub c: PolynomialC,
}

impl PolynomialModel {
    /// The paper's coefficients with the corrected k₁, see [`PolynomialB::LIANG_2023`].
    pub const LIANG_2023: PolynomialModel = PolynomialModel {
        a: PolynomialA::LIANG_2023,
        b: PolynomialB::LIANG_2023,
        c: PolynomialC::LIANG_2023,
    };

    /// The paper's coefficients as printed: r_max comes out 7 times too long. For comparison only.
    pub const LIANG_2023_PRINTED: PolynomialModel =
        PolynomialModel { b: PolynomialB::LIANG_2023_PRINTED, ..Self::LIANG_2023 };

    /// Below this surface albedo the profile of this one is used.
    ///
    /// The shape is singular at A = 0: a and b vanish there with different powers of α, r_max = -b/a ∝ α^0.3
    /// with them, and at α = 0 itself the second term of a even turns its sign. Nothing is reflected there
    /// (A scales the result), so any finite shape serves.
    pub const MINIMUM_SURFACE_ALBEDO: f64 = 1e-6;

    /// The length this model is parametrized by.
    pub const LENGTH: Length = Length::MeanFreePath;

    /// The profile of a medium whose length is the mean free path.
    pub fn profile(&self, medium: Medium) -> Result<PolynomialProfile, ModelError> {
        let Coefficients { a, b, c } = self.coefficients(medium.surface_albedo())?;
        let surface_albedo = medium.surface_albedo();
        let unit_max_radius = -b / a;
        let x = unit_max_radius / c;
        // eq. (17) at r_max, over -a c: what unit_cdf divides by.
        let unnormalized = x * x.ln_1p() - x_minus_ln_1p(x);
        let density = 1.0 / (c * unnormalized);
        let max_radius_mm = unit_max_radius * medium.mean_free_path_mm();
        if !(density.is_finite() && density > 0.0 && max_radius_mm.is_finite() && max_radius_mm > 0.0) {
            return Err(ModelError::OutOfNumericRange { quantity: "cdf(r_max)", surface_albedo });
        }
        Ok(PolynomialProfile {
            surface_albedo,
            mean_free_path_mm: medium.mean_free_path_mm(),
            max_radius_mm,
            unit_max_radius,
            unit_c: c,
            unit_density: density,
        })
    }

    /// The paper's cdf(r_max) before it is normalised, \[L23\] eq. (17): how far the fit misses energy
    /// conservation. 1 would be a perfect fit.
    ///
    /// It does not depend on the mean free path. `surface_albedo` in (0, 1].
    pub fn energy_before_normalization(&self, surface_albedo: f64) -> Result<f64, ModelError> {
        let Coefficients { a, b, c } = self.coefficients(surface_albedo)?;
        let max_radius = -b / a;
        let integral = a * max_radius + (b - a * c) * (max_radius / c).ln_1p();
        Ok(2.0 * PI * integral / surface_albedo.max(Self::MINIMUM_SURFACE_ALBEDO))
    }

    /// a, b, c at ℓ = 1, such that r_max > 0 and the profile is positive on [0, r_max).
    fn coefficients(&self, surface_albedo: f64) -> Result<Coefficients, ModelError> {
        let alpha = from_surface_albedo(Entry::Searchlight, surface_albedo.max(Self::MINIMUM_SURFACE_ALBEDO));
        let coefficients = Coefficients { a: self.a.at(alpha), b: self.b.at(alpha), c: self.c.at(alpha) };
        let Coefficients { a, b, c } = coefficients;
        for (quantity, value) in [("a", a), ("b", b), ("c", c)] {
            if !value.is_finite() {
                return Err(ModelError::OutOfNumericRange { quantity, surface_albedo });
            }
        }
        if c <= 0.0 {
            return Err(C_POSITIVE.broken_at(surface_albedo, c));
        }
        if a == 0.0 {
            return Err(AN_END.broken_at(surface_albedo, a));
        }
        let max_radius = -b / a;
        if max_radius <= 0.0 {
            return Err(MAXIMUM_RADIUS_POSITIVE.broken_at(surface_albedo, max_radius));
        }
        if a > 0.0 {
            // Then b < 0: the profile climbs from b/c to 0 at r_max.
            return Err(B_POSITIVE.broken_at(surface_albedo, b));
        }
        Ok(coefficients)
    }
}

/// The profile is positive from its origin on.
static B_POSITIVE: Requirement = Requirement {
    coefficient: "b",
    wrong: "the profile is negative",
    expected: "b/c is the profile's value at the origin, so b must be above 0",
    remedy: "b = scale α^(…): give `scale` a value above 0; Liang et al., corrected, have 0.0635",
};

/// No pole within the profile's range, which would make its energy infinite.
static C_POSITIVE: Requirement = Requirement {
    coefficient: "c",
    wrong: "c is {} mean free paths",
    expected: "c must be above 0: the profile has a pole at r = -c",
    remedy: "c = (amplitude e^(rate α) + offset) ℓ: make `offset` larger; Liang et al. have 0.166",
};

/// What makes a negative.
const NEGATIVE_A: &str =
    "a = (linear α + amplitude 10^(decades (α - 1)))/ℓ must be negative: Liang et al. have `linear: -0.0064`";

/// The profile reaches 0 somewhere.
static AN_END: Requirement = Requirement {
    coefficient: "a",
    wrong: "the profile has no maximum radius",
    expected: "a = 0 here, so the profile never falls to 0",
    remedy: NEGATIVE_A,
};

/// It reaches 0 at a radius.
static MAXIMUM_RADIUS_POSITIVE: Requirement = Requirement {
    coefficient: "a",
    wrong: "the maximum radius is {} mean free paths",
    expected: "r_max = -b/a must be above 0",
    remedy: NEGATIVE_A,
};

impl ProfileModel for PolynomialModel {
    const DESCRIPTION: Description = Description {
        name: "Polynomial",
        stem: "polynomial",
        caption: "polynomial",
        equation: "r R(r) = (a r + b)/(r + c) up to r_max = −b/a, which must be above 0; divided by its own integral. \
                   a = (linear α + amplitude 10^(decades (α − 1)))/ℓ, \
                   b = scale α^((curvature (α − pivot)² + offset) α + exponent), c = (amplitude e^(rate α) + offset) ℓ",
        notes: "α is the single-scattering albedo that belongs to A.",
        source: "Liang et al. 2023, eq. (7)",
        notation: Notation::Fields { key: "coefficients", own: "" },
        example: "Polynomial(coefficients: Liang2023)",
        lengths: &[Self::LENGTH],
        variable: Variable::SURFACE_ALBEDO,
    };

    const COEFFICIENTS: &'static [Coefficient<Self>] = &[
        Coefficient::<Self>::new("a.linear", "a", "factor of α", |m| from_mut(&mut m.a.linear))
            .member("a_linear"),
        Coefficient::<Self>::new("a.amplitude", "a", "the second term at α = 1", |m| {
            from_mut(&mut m.a.amplitude)
        })
        .member("a_amplitude")
        .order(1),
        Coefficient::<Self>::new("a.decades", "a", "decades that it falls to α = 0", |m| {
            from_mut(&mut m.a.decades)
        })
        .member("a_decades")
        .order(2),
        Coefficient::<Self>::new("b.scale", "b", "b at α = 1, the paper's k₁", |m| {
            from_mut(&mut m.b.scale)
        })
        .member("b_scale"),
        Coefficient::<Self>::new("b.curvature", "b", "factor of the square in the exponent", |m| {
            from_mut(&mut m.b.curvature)
        })
        .member("b_curvature")
        .order(3),
        Coefficient::<Self>::new("b.pivot", "b", "the α about which the square is symmetric", |m| {
            from_mut(&mut m.b.pivot)
        })
        .member("b_pivot")
        .order(4),
        Coefficient::<Self>::new("b.offset", "b", "added to the square", |m| from_mut(&mut m.b.offset))
            .member("b_offset")
            .order(2),
        Coefficient::<Self>::new("b.exponent", "b", "the exponent at α = 0", |m| {
            from_mut(&mut m.b.exponent)
        })
        .member("b_exponent")
        .order(1),
        Coefficient::<Self>::new("c.amplitude", "c", "factor of the exponential", |m| {
            from_mut(&mut m.c.amplitude)
        })
        .member("c_amplitude")
        .order(1),
        Coefficient::<Self>::new("c.rate", "c", "its growth with α", |m| from_mut(&mut m.c.rate))
            .member("c_rate")
            .order(2),
        Coefficient::<Self>::new("c.offset", "c", "the part that does not depend on α", |m| {
            from_mut(&mut m.c.offset)
        })
        .member("c_offset"),
    ];

    const PUBLISHED: &'static [Published<Self>] = &[
        Published::new(
            "liang_2023",
            "Liang2023",
            "Liang et al. 2023, eq. (7), (11)–(15), k₁ corrected to 0.0635",
            || Self::LIANG_2023,
        )
        .entering(Entry::Searchlight),
        Published::new(
            "liang_2023_printed",
            "Liang2023Printed",
            "the same as printed, k₁ = 0.461; for comparison only",
            || Self::LIANG_2023_PRINTED,
        )
        .entering(Entry::Searchlight),
    ];

    const FUNCTIONS: &'static [Function<Self>] = &[
        Function::<Self>::new("a", "a (1/mean free path)", |m, surface_albedo| m.a.at(alpha(surface_albedo)))
            .length_power(1)
            .scaled_by_energy(),
        Function::<Self>::new("b", "b", |m, surface_albedo| m.b.at(alpha(surface_albedo))).scaled_by_energy(),
        Function::<Self>::new("c", "c (mean free paths)", |m, surface_albedo| m.c.at(alpha(surface_albedo)))
            .length_power(-1),
    ];

    const ARGUMENT: Argument = Argument { label: "single-scattering albedo α", at: alpha };

    fn boxed_profile(&self, medium: Medium, _channel: Channel) -> Result<Box<dyn RadialProfile>, ModelError> {
        Ok(Box::new(self.profile(medium)?))
    }

    fn energy(&self, surface_albedo: f64) -> Option<Result<f64, ModelError>> {
        Some(self.energy_before_normalization(surface_albedo))
    }

    fn make_constant(&mut self, surface_albedo: f64) {
        let alpha = alpha(surface_albedo);
        let (a, b, c) = (self.a.at(alpha), self.b.at(alpha), self.c.at(alpha));
        // a must stay proportional to α: without a term of another sign there is no other constant.
        self.a = PolynomialA { linear: a / alpha, amplitude: 0.0, ..self.a };
        self.b = PolynomialB { scale: b, curvature: 0.0, offset: 0.0, exponent: 0.0, ..self.b };
        self.c = PolynomialC { amplitude: 0.0, offset: c, ..self.c };
    }
}

/// α of the paper's setting.
fn alpha(surface_albedo: f64) -> f64 {
    from_surface_albedo(Entry::Searchlight, surface_albedo)
}

/// a, b, c of \[L23\] eq. (7) at ℓ = 1.
struct Coefficients {
    a: f64,
    b: f64,
    c: f64,
}

/// The member of [`PolynomialModel`] that belongs to one medium.
///
/// Written about its end: with k = -2πa/(A·cdf(r_max)), eq. (7) is 2πr·R/A = k (r_max - r)/(r + c).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolynomialProfile {
    surface_albedo: f64,
    mean_free_path_mm: f64,
    max_radius_mm: f64,
    /// r_max at ℓ = 1.
    unit_max_radius: f64,
    /// c at ℓ = 1.
    unit_c: f64,
    /// k at ℓ = 1.
    unit_density: f64,
}

impl PolynomialProfile {
    /// c of \[L23\] eq. (7), mm.
    pub fn c_mm(&self) -> f64 {
        self.unit_c * self.mean_free_path_mm
    }

    /// cdf at ℓ = 1 for 0 ≤ r ≤ r_max: \[L23\] eq. (17), (18) as k·c·(X ln(1 + x) - (x - ln(1 + x))), with x = r/c
    /// and X = r_max/c. The second term is at most half the first, so nothing cancels.
    fn unit_cdf(&self, r: f64) -> f64 {
        let x = r / self.unit_c;
        let x_max = self.unit_max_radius / self.unit_c;
        self.unit_density * self.unit_c * (x_max * x.ln_1p() - x_minus_ln_1p(x))
    }

    /// 1 - cdf at ℓ = 1, as a function of the distance y = r_max - r from the end:
    /// ∫₀^y k t/(r_max + c - t) dt = k·(r_max + c)·(-w - ln(1 - w)), w = y/(r_max + c).
    fn unit_tail(&self, y: f64) -> f64 {
        let span = self.unit_max_radius + self.unit_c;
        self.unit_density * span * x_minus_ln_1p(-y / span)
    }

    /// Density of the exit radius at ℓ = 1, for 0 ≤ r ≤ r_max.
    fn unit_pdf(&self, r: f64) -> f64 {
        self.unit_density * (self.unit_max_radius - r) / (r + self.unit_c)
    }

    /// The argument in mean free paths, or the end of the profile.
    fn unit_radius(&self, radius_mm: f64) -> f64 {
        let radius_mm = legal_radius(radius_mm);
        // Compared in mm first, so that the profile ends exactly at `max_radius` however the quotient rounds.
        if radius_mm >= self.max_radius_mm {
            self.unit_max_radius
        } else {
            (radius_mm / self.mean_free_path_mm).clamp(0.0, self.unit_max_radius)
        }
    }
}

impl RadialProfile for PolynomialProfile {
    fn surface_albedo(&self) -> f64 {
        self.surface_albedo
    }

    /// \[L23\] eq. (7) over r. Infinite at r = 0, as 1/r.
    fn area_pdf(&self, radius_mm: f64) -> f64 {
        self.radial_pdf(radius_mm) / (2.0 * PI * legal_radius(radius_mm))
    }

    /// 2π times \[L23\] eq. (7), normalised by eq. (18).
    fn radial_pdf(&self, radius_mm: f64) -> f64 {
        self.unit_pdf(self.unit_radius(radius_mm)) / self.mean_free_path_mm
    }

    /// \[L23\] eq. (17), normalised by eq. (18).
    fn radial_cdf(&self, radius_mm: f64) -> f64 {
        let r = self.unit_radius(radius_mm);
        // Near the end 1 - tail rounds better than a sum of logarithms, and hits 1 exactly.
        if r < 0.5 * self.unit_max_radius {
            self.unit_cdf(r)
        } else {
            1.0 - self.unit_tail(self.unit_max_radius - r)
        }
    }

    fn radial_tail(&self, radius_mm: f64) -> f64 {
        let r = self.unit_radius(radius_mm);
        if r < 0.5 * self.unit_max_radius {
            1.0 - self.unit_cdf(r)
        } else {
            self.unit_tail(self.unit_max_radius - r)
        }
    }

    /// Newton's method on \[L23\] eq. (17). (The paper's own sampler, eq. (19), only approximates the inverse.)
    ///
    /// The cdf is concave, so that Newton's method converges monotonically from below; near u = 1 its root is
    /// double, so that the distance from r_max is solved for instead.
    fn sample_radius(&self, u: f64) -> f64 {
        if u.is_nan() {
            return u;
        }
        let u = legal_u(u);
        let (r_max, c, k) = (self.unit_max_radius, self.unit_c, self.unit_density);
        let median_is_below = self.unit_cdf(0.5 * r_max) > u;
        let r = if median_is_below {
            // Lower bounds: the cdf lies below its tangent k r_max r/c at 0, and below k(r_max + c) ln(1 + r/c),
            // which is eq. (17) without its negative term -k r.
            let start = (u * c / (k * r_max)).max(c * (u / (k * (r_max + c))).exp_m1());
            increasing_root(|r| (self.unit_cdf(r) - u, self.unit_pdf(r)), [0.0, 0.5 * r_max], start, 0.0)
        } else {
            let q = 1.0 - u;
            // Upper bound: the denominator of k t/(r_max + c - t) replaced by its value at t = 0.
            let start = (2.0 * (r_max + c) * q / k).sqrt();
            let value_and_slope = |y: f64| (self.unit_tail(y) - q, self.unit_pdf(r_max - y));
            r_max - increasing_root(value_and_slope, [0.0, 0.5 * r_max], start, 0.0)
        };
        r * self.mean_free_path_mm
    }

    fn max_radius(&self) -> Option<f64> {
        Some(self.max_radius_mm)
    }
}

/// x - ln(1 + x) for x > -1, to full relative accuracy.
fn x_minus_ln_1p(x: f64) -> f64 {
    if !(-0.5..=1.0).contains(&x) {
        return x - x.ln_1p();
    }
    // With t = x/(2 + x), |t| ≤ 1/3: ln(1 + x) = 2 atanh t and x = 2t/(1 - t), so the difference is
    // x t - 2t³(1/3 + t²/5 + t⁴/7 + …), where the bracket is small against x t.
    let t = x / (2.0 + x);
    let t2 = t * t;
    // 9⁻¹⁷ < 2⁻⁵³: the first term left out is below the last place.
    let series = (0..17).rev().fold(0.0, |sum, n| sum * t2 + 1.0 / f64::from(2 * n + 3));
    x * t - 2.0 * t * t2 * series
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may panic")]

    use super::*;

    #[test]
    fn x_minus_ln_1p_keeps_its_relative_accuracy() {
        // Its Taylor series x²/2 - x³/3 + x⁴/4 - …, to 40 terms, is exact to rounding for |x| ≤ 0.25.
        for x in [-0.25, -0.1, -1e-2, -1e-5, -1e-9, 1e-12, 1e-7, 1e-3, 0.05, 0.25] {
            let exact: f64 = (2..40).rev().map(|n| f64::powi(-x, n) / f64::from(n)).sum();
            let relative = x_minus_ln_1p(x) / exact - 1.0;
            // Some ten roundings.
            assert!(relative.abs() < 1e-14, "{x}: {relative}");
        }
        // The branches meet: on either side of a border the two forms differ only by rounding.
        for border in [-0.5, 1.0] {
            let direct = border - f64::ln_1p(border);
            assert!((x_minus_ln_1p(border) / direct - 1.0).abs() < 1e-14);
        }
        assert_eq!(x_minus_ln_1p(0.0), 0.0);
    }

    #[test]
    fn the_corrected_constant_conserves_energy_and_the_printed_one_does_not() {
        // L23 fits single-scattering albedos up to almost 1; below 0.1 almost nothing is reflected.
        for alpha in [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.98, 0.99, 0.995, 0.999] {
            let surface_albedo =
                crate::single_scattering_albedo::to_surface_albedo(Entry::Searchlight, alpha);
            let corrected = PolynomialModel::LIANG_2023.energy_before_normalization(surface_albedo).unwrap();
            // Measured 0.949 (α = 0.2) to 1.055 (α = 0.5).
            assert!((0.945..1.06).contains(&corrected), "{alpha}: {corrected}");
            let printed =
                PolynomialModel::LIANG_2023_PRINTED.energy_before_normalization(surface_albedo).unwrap();
            // Measured 13.05 (α = 0.999) to 14.94 (α = 0.5).
            assert!((13.0..15.0).contains(&printed), "{alpha}: {printed}");
            // r_max = -b/a is proportional to k₁.
            let medium = Medium::new(surface_albedo, 1.0).unwrap();
            let r_max = |model: PolynomialModel| model.profile(medium).unwrap().max_radius().unwrap();
            let ratio = r_max(PolynomialModel::LIANG_2023_PRINTED) / r_max(PolynomialModel::LIANG_2023);
            assert!((ratio - 0.461 / 0.0635).abs() < 1e-12);
        }
    }

    #[test]
    fn the_normalised_profile_is_the_equation_of_the_paper() {
        // eq. (7) and (18) as printed, against the form about r_max that the profile uses.
        let model = PolynomialModel::LIANG_2023;
        for surface_albedo in [0.05, 0.3, 0.8, 0.99] {
            for mean_free_path_mm in [0.01, 1.0, 40.0] {
                let profile = model.profile(Medium::new(surface_albedo, mean_free_path_mm).unwrap()).unwrap();
                let alpha = from_surface_albedo(Entry::Searchlight, surface_albedo);
                let (a, b) = (model.a.at(alpha) / mean_free_path_mm, model.b.at(alpha));
                let c = model.c.at(alpha) * mean_free_path_mm;
                let normalization = model.energy_before_normalization(surface_albedo).unwrap();
                for fraction in [0.0, 0.01, 0.2, 0.7, 0.99] {
                    let r = fraction * profile.max_radius().unwrap();
                    let pdf = 2.0 * PI * (a * r + b) / (r + c) / surface_albedo / normalization;
                    // Near r_max a r + b cancels two digits.
                    assert!((profile.radial_pdf(r) / pdf - 1.0).abs() < 1e-12);
                    let cdf = 2.0 * PI * (a * r + (b - a * c) * (r / c + 1.0).ln())
                        / surface_albedo
                        / normalization;
                    assert!((profile.radial_cdf(r) - cdf).abs() < 1e-13);
                }
            }
        }
    }

    #[test]
    fn what_is_no_profile_says_why() {
        let with = |a: f64, b: f64, c: f64| {
            let model = PolynomialModel {
                a: PolynomialA { linear: 0.0, amplitude: a, decades: 0.0 },
                b: PolynomialB { scale: b, curvature: 0.0, pivot: 0.0, offset: 0.0, exponent: 0.0 },
                c: PolynomialC { amplitude: 0.0, rate: 0.0, offset: c },
            };
            model.profile(Medium::new(0.5, 10.0).unwrap())
        };
        let surface_albedo = 0.5;
        assert!(with(-1.0, 1.0, 1.0).is_ok());
        for (a, b, c, expected) in [
            (-1.0, -2.0, 1.0, MAXIMUM_RADIUS_POSITIVE.broken_at(surface_albedo, -2.0)),
            (1.0, 2.0, 1.0, MAXIMUM_RADIUS_POSITIVE.broken_at(surface_albedo, -2.0)),
            (1.0, -2.0, 1.0, B_POSITIVE.broken_at(surface_albedo, -2.0)),
            (0.0, 1.0, 1.0, AN_END.broken_at(surface_albedo, 0.0)),
            (-1.0, 1.0, -0.5, C_POSITIVE.broken_at(surface_albedo, -0.5)),
            (-1.0, 1.0, 0.0, C_POSITIVE.broken_at(surface_albedo, 0.0)),
        ] {
            assert_eq!(with(a, b, c), Err(expected), "{a} {b} {c}");
        }
    }
}
