//! The dipole of diffusion theory.
//!
//! Source: Jensen, Marschner, Levoy and Hanrahan 2001, \[J01\].

use std::ops::RangeInclusive;
use std::slice::from_mut;

use crate::description::{Coefficient, Description, Notation, ProfileModel, Published, Values, Variable};
use crate::dipole_source::DipoleSource;
use crate::exponential_source_sum::ExponentialSourceSum;
use crate::quantity::Bounds;
use crate::{Channel, Medium, ModelError, Quantity, RadialProfile, Requirement};

/// F_dr from η = 1 on: coefficients of η⁻², η⁻¹, 1 and η. \[J01\], after Groenhuis et al. 1983. The twin in WGSL takes
/// them from here.
pub(crate) const INTERNAL_REFLECTANCE: [f64; 4] = [-1.440, 0.710, 0.668, 0.0636];

/// F_dr below η = 1: coefficients of 1, η⁻¹, η⁻² and η⁻³. Egan and Hilgeman 1979.
pub(crate) const INTERNAL_REFLECTANCE_BELOW_1: [f64; 4] = [-0.4399, 0.7099, -0.3319, 0.0636];

/// The classical dipole, \[J01\] eq. (4), from what was measured of a medium. With σt′ = σs′ + σa, α′ = σs′/σt′,
/// s = √(3 σa σt′), z_r = 1/σt′, z_v = z_r (1 + 4A/3), A = (1 + F)/(1 - F) and d = √(r² + z²) of each source,
///
/// R(r) = α′/4π (z_r (1 + s d_r) e^(-s d_r)/d_r³ + z_v (1 + s d_v) e^(-s d_v)/d_v³).
///
/// A source at depth z sends e^(-sz) α′/2 through the surface in all, so that the sources' shares of the energy are as
/// e^(-s z_r) to e^(-s z_v), and the profile is the sum of two [sources](ExponentialSourceSum).
///
/// The coefficients belong to one medium: its lengths are absolute, in mm, and each channel has its own. A material's
/// mean free path does not scale them, and its surface albedo does not change the shape: it says how much is reflected
/// in all. Theory says [`diffuse_reflectance`](Self::diffuse_reflectance).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DipoleModel {
    /// σs′ = (1 - g) σs per channel, mm⁻¹, > 0.
    pub reduced_scattering_per_mm: [f64; 3],
    /// σa per channel, mm⁻¹, ≥ 0.
    pub absorption_per_mm: [f64; 3],
    /// η, of the medium against what is outside.
    pub refractive_index: f64,
}

impl DipoleModel {
    /// Skin, the first sample of \[J01\] figure 5.
    pub const SKIN1: DipoleModel = DipoleModel {
        reduced_scattering_per_mm: [0.74, 0.88, 1.01],
        absorption_per_mm: [0.032, 0.17, 0.48],
        refractive_index: 1.3,
    };

    /// Marble, \[J01\] figure 5.
    pub const MARBLE: DipoleModel = DipoleModel {
        reduced_scattering_per_mm: [2.19, 2.62, 3.00],
        absorption_per_mm: [0.0021, 0.0041, 0.0071],
        refractive_index: 1.5,
    };

    /// F_dr: the share of diffuse light that the surface reflects back inside.
    fn internal_reflectance(&self) -> f64 {
        let n = self.refractive_index;
        if n >= 1.0 {
            let [square, first, whole, rising] = INTERNAL_REFLECTANCE;
            square / (n * n) + first / n + whole + rising * n
        } else {
            let [whole, first, square, cube] = INTERNAL_REFLECTANCE_BELOW_1;
            whole + first / n + square / (n * n) + cube / (n * n * n)
        }
    }

    /// A of \[J01\]: how much farther out the boundary is, where the fluence vanishes.
    fn boundary(&self) -> f64 {
        let reflectance = self.internal_reflectance();
        (1.0 + reflectance) / (1.0 - reflectance)
    }

    /// What theory says the medium reflects of the light that enters: α′/2 (1 + e^(-4/3 A q)) e^(-q), q = √(3(1 - α′)).
    pub fn diffuse_reflectance(&self, channel: Channel) -> f64 {
        let index = channel.index();
        let (scattering, absorption) = (self.reduced_scattering_per_mm[index], self.absorption_per_mm[index]);
        let extinction = scattering + absorption;
        let q = (3.0 * absorption / extinction).sqrt();
        let image = (-4.0 / 3.0 * self.boundary() * q).exp();
        0.5 * scattering / extinction * (1.0 + image) * (-q).exp()
    }

    /// The profile of one channel. Of the medium only the surface albedo is used.
    pub fn profile(&self, medium: Medium, channel: Channel) -> Result<DipoleProfile, ModelError> {
        self.validate()?;
        let surface_albedo = medium.surface_albedo();
        let absorption = self.absorption_per_mm[channel.index()];
        let extinction = self.reduced_scattering_per_mm[channel.index()] + absorption;
        let attenuation = (3.0 * absorption * extinction).sqrt();
        let real = 1.0 / extinction;
        let image = real * (1.0 + 4.0 / 3.0 * self.boundary());
        for (quantity, value) in [("z_r", real), ("z_v", image), ("s", attenuation)] {
            let is_legal = value.is_finite() && (value > 0.0 || quantity == "s");
            if !is_legal {
                return Err(ModelError::OutOfNumericRange { quantity, surface_albedo });
            }
        }
        let of_image = (-attenuation * (image - real)).exp();
        let share = 1.0 / (1.0 + of_image);
        Ok(ExponentialSourceSum::new(
            surface_albedo,
            1.0,
            [],
            [
                (share, DipoleSource { depth: real, attenuation }),
                (share * of_image, DipoleSource { depth: image, attenuation }),
            ],
        ))
    }
}

/// Indices for which the fits of F_dr hold: A = (1 + F)/(1 - F) is within 0.4 % up to 2, and within 5 % up to the end.
const REFRACTIVE_INDICES: RangeInclusive<f64> = 0.5..=2.5;

static REFLECTANCE_IS_KNOWN: Requirement = Requirement {
    coefficient: "refractive_index",
    wrong: "a refractive index of {} is beyond what the formula of the internal reflectance holds for",
    expected: "expected an index from 0.5 to 2.5",
    remedy: "skin has 1.3 to 1.4, stone 1.5",
};

/// A coefficient of a medium, per length.
const fn per_mm(noun: &'static str, bounds: Bounds, meaning: &'static str) -> Quantity {
    Quantity { noun, unit: "mm⁻¹", bounds, kind: "number", meaning }
}

impl ProfileModel for DipoleModel {
    const DESCRIPTION: Description = Description {
        name: "Dipole",
        stem: "dipole",
        caption: "dipole",
        equation: "R(r) = α′/4π (z_r (1 + s d_r) e^(−s d_r)/d_r³ + z_v (1 + s d_v) e^(−s d_v)/d_v³), d² = r² + z², \
                   z_r = 1/σt′, z_v = z_r (1 + 4/3 (1 + F)/(1 − F)), s = √(3 σa σt′), σt′ = σs′ + σa, α′ = σs′/σt′",
        notes: "Lengths are absolute: the mean free path does not scale them, and the surface albedo does not change \
                the shape. F, the diffuse Fresnel reflectance inside, follows from the refractive index. The surface \
                albedo that theory has for the coefficients is α′/2 (1 + e^(−4/3 (1 + F)/(1 − F) q)) e^(−q), \
                q = √(3(1 − α′)). A fit leaves the refractive index as it is.",
        source: "Jensen et al. 2001, eq. (4)",
        notation: Notation::Fields { key: "medium", own: "" },
        example: "Dipole(medium: Skin1)",
        lengths: &[],
        variable: Variable::SURFACE_ALBEDO,
    };

    const COEFFICIENTS: &'static [Coefficient<Self>] = &[
        Coefficient::<Self>::new(
            "reduced_scattering_per_mm",
            "σs′",
            "reduced scattering coefficient",
            |m| &mut m.reduced_scattering_per_mm,
        )
        .values(Values::Channels)
        .quantity(per_mm(
            "reduced scattering",
            Bounds::Positive,
            "give the reduced scattering coefficient σs′ = (1 - g) σs, in mm⁻¹",
        )),
        Coefficient::<Self>::new("absorption_per_mm", "σa", "absorption coefficient", |m| {
            &mut m.absorption_per_mm
        })
        .values(Values::Channels)
        .quantity(per_mm(
            "absorption",
            Bounds::NonNegative,
            "give the absorption coefficient σa, in mm⁻¹",
        )),
        Coefficient::<Self>::new("refractive_index", "η", "of the medium against what is outside", |m| {
            from_mut(&mut m.refractive_index)
        })
        .quantity(Quantity {
            noun: "refractive index",
            unit: "",
            bounds: Bounds::Positive,
            kind: "number",
            meaning: "give the medium's refractive index: 1.3 for milk, 1.4 for skin, 1.5 for stone",
        })
        .never_fitted(),
    ];

    const PUBLISHED: &'static [Published<Self>] = &[
        Published::new("dipole_skin1", "Skin1", "Jensen et al. 2001, figure 5: skin1, η = 1.3", || {
            Self::SKIN1
        }),
        Published::new("dipole_marble", "Marble", "Jensen et al. 2001, figure 5: marble, η = 1.5", || {
            Self::MARBLE
        }),
    ];

    fn boxed_profile(&self, medium: Medium, channel: Channel) -> Result<Box<dyn RadialProfile>, ModelError> {
        Ok(Box::new(self.profile(medium, channel)?))
    }

    fn collect_errors(&self, errors: &mut Vec<ModelError>) {
        if self.refractive_index > 0.0 && !REFRACTIVE_INDICES.contains(&self.refractive_index) {
            errors.push(REFLECTANCE_IS_KNOWN.broken_by(self.refractive_index));
        }
    }
}

/// The member of [`DipoleModel`] that belongs to one medium and channel.
pub type DipoleProfile = ExponentialSourceSum<0, 2>;

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may panic")]

    use std::f64::consts::PI;

    use super::*;
    use crate::quadrature::Quadrature;

    const BOTH: [DipoleModel; 2] = [DipoleModel::SKIN1, DipoleModel::MARBLE];

    fn profile(model: &DipoleModel, channel: Channel) -> DipoleProfile {
        model.profile(Medium::new(0.5, 1.0).unwrap(), channel).unwrap()
    }

    /// R(r) as the paper prints it.
    fn reflectance(model: &DipoleModel, channel: Channel, r: f64) -> f64 {
        let (scattering, absorption) =
            (model.reduced_scattering_per_mm[channel.index()], model.absorption_per_mm[channel.index()]);
        let extinction = scattering + absorption;
        let s = (3.0 * absorption * extinction).sqrt();
        let f = model.internal_reflectance();
        let real = 1.0 / extinction;
        let image = real * (1.0 + 4.0 / 3.0 * (1.0 + f) / (1.0 - f));
        let source = |z: f64| {
            let d = f64::hypot(r, z);
            z * (1.0 + s * d) * (-s * d).exp() / d.powi(3)
        };
        scattering / extinction / (4.0 * PI) * (source(real) + source(image))
    }

    /// 2 ∫ F(μ) μ dμ of Fresnel's reflectance F inside a medium.
    fn fresnel_inside(refractive_index: f64) -> f64 {
        const STEPS: u32 = 200_000;
        let reflectance = |mu: f64| {
            let sine = refractive_index * (1.0 - mu * mu).sqrt();
            if sine >= 1.0 {
                return 1.0;
            }
            let outside = (1.0 - sine * sine).sqrt();
            let across = (refractive_index * mu - outside) / (refractive_index * mu + outside);
            let along = (mu - refractive_index * outside) / (mu + refractive_index * outside);
            0.5 * (across * across + along * along)
        };
        let mu = |step: u32| (f64::from(step) + 0.5) / f64::from(STEPS);
        (0..STEPS).map(|step| 2.0 * mu(step) * reflectance(mu(step))).sum::<f64>() / f64::from(STEPS)
    }

    #[test]
    fn the_internal_reflectance_is_fresnels() {
        let boundary = |reflectance: f64| (1.0 + reflectance) / (1.0 - reflectance);
        for (refractive_index, tolerance) in
            [(0.5, 4e-3), (0.8, 4e-3), (1.0, 4e-3), (1.3, 4e-3), (1.5, 4e-3), (2.0, 4e-3), (2.5, 0.05)]
        {
            let found = DipoleModel { refractive_index, ..DipoleModel::SKIN1 }.internal_reflectance();
            let (found, exact) = (boundary(found), boundary(fresnel_inside(refractive_index)));
            assert!((found / exact - 1.0).abs() < tolerance, "{refractive_index}: {found}, {exact}");
        }
    }

    #[test]
    fn the_profile_is_the_papers_over_its_integral() {
        for model in BOTH {
            for channel in Channel::ALL {
                let p = profile(&model, channel);
                let total = model.diffuse_reflectance(channel);
                for r in [0.0, 1e-3, 0.1, 0.7, 3.0, 20.0] {
                    let expected = reflectance(&model, channel, r) / total;
                    // Some ten roundings, and one of s d < 20 in the exponent.
                    assert!((p.area_pdf(r) / expected - 1.0).abs() < 1e-13, "{channel} {r}");
                }
            }
        }
    }

    #[test]
    fn all_that_is_reflected_is_the_total_diffuse_reflectance() {
        for model in BOTH {
            for channel in Channel::ALL {
                let density = |r: f64| 2.0 * PI * r * reflectance(&model, channel, r);
                let ends = [0.0, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1e3];
                let integral = Quadrature::default().integrate_between(density, &ends);
                let total = model.diffuse_reflectance(channel);
                // Beyond 1000 mm marble's red, s = 0.12 mm⁻¹, holds e^(-120).
                assert!((integral / total - 1.0).abs() < 1e-10, "{channel}: {integral} and {total}");
            }
        }
    }

    #[test]
    fn the_totals_are_those_of_figure_5() {
        for (model, printed) in
            [(DipoleModel::SKIN1, [0.44, 0.22, 0.13]), (DipoleModel::MARBLE, [0.83, 0.79, 0.75])]
        {
            for channel in Channel::ALL {
                let total = model.diffuse_reflectance(channel);
                // Printed with two digits; skin's green comes out as 0.227.
                assert!((total - printed[channel.index()]).abs() < 0.008, "{channel}: {total}");
            }
        }
    }

    #[test]
    fn the_fits_of_the_internal_reflectance_meet_at_a_matched_boundary() {
        let at =
            |refractive_index| DipoleModel { refractive_index, ..DipoleModel::SKIN1 }.internal_reflectance();
        // Both are fits: what is 0 there comes out as 0.0016 and 0.0017.
        assert!(at(1.0).abs() < 0.002 && at(1.0 - f64::EPSILON).abs() < 0.002);
        assert!(at(1.3) > at(1.2) && at(0.8) > at(0.9));
    }

    #[test]
    fn nothing_absorbed_and_no_length_scales_it() {
        let model = DipoleModel { absorption_per_mm: [0.0; 3], ..DipoleModel::SKIN1 };
        let p = profile(&model, Channel::Red);
        assert_eq!(p.dipole_attenuation_per_mm().to_bits(), 0);
        // Both sources send out as much.
        assert_eq!(model.diffuse_reflectance(Channel::Red), 1.0);
        let [real, image] = p.dipole_depths_mm();
        assert!((p.radial_tail(1e9) / ((real + image) / 2e9) - 1.0).abs() < 1e-14);
        let other = model.profile(Medium::new(0.5, 7.0).unwrap(), Channel::Red).unwrap();
        assert_eq!(p, other);
    }

    #[test]
    fn what_is_no_medium_says_why() {
        let good = DipoleModel::SKIN1;
        for (model, expected) in [
            (
                DipoleModel { reduced_scattering_per_mm: [1.0, 0.0, 1.0], ..good },
                ["reduced_scattering_per_mm[1]", "`reduced_scattering_per_mm[1]` is 0 mm⁻¹"],
            ),
            (
                DipoleModel { absorption_per_mm: [1.0, 0.0, -1.0], ..good },
                ["absorption_per_mm[2]", "`absorption_per_mm[2]` is -1 mm⁻¹"],
            ),
            (
                DipoleModel { refractive_index: 4.0, ..good },
                [
                    "refractive_index",
                    "a refractive index of 4 is beyond what the formula of the internal reflectance holds for",
                ],
            ),
            (
                DipoleModel { refractive_index: f64::NAN, ..good },
                ["refractive_index", "coefficient `refractive_index` is not a finite number"],
            ),
        ] {
            let error = model.profile(Medium::new(0.5, 1.0).unwrap(), Channel::Red).unwrap_err();
            assert_eq!([error.coefficient(), error.to_string()], expected);
        }
    }
}
