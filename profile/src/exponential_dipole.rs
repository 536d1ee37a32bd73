//! An exponential near the point of entry and a dipole's far field.

use crate::description::{
    Coefficient, Description, Function, Notation, ProfileModel, Published, Values, Variable,
};
use crate::dipole_source::DipoleSource;
use crate::exponential_source_sum::{Exponential, ExponentialSourceSum};
use crate::single_scattering_albedo::Entry;
use crate::{Channel, Length, Medium, ModelError, RadialProfile};

/// An exponential plus a dipole. At mean free path 1, with ρ = √(r² + z²),
///
/// radial_cdf(r) = 1 - w e^(-r/d) - (1 - w)(z/ρ) e^(-s(ρ - z)).
///
/// The exponential carries the few-scattering light, the second term is the flux of a point source at depth z
/// that decays with s. w, d, z and s/(1 - A) are quadratics in the surface albedo A, given by their
/// coefficients of 1, A, A². At A = 1 nothing is absorbed: s = 0, and the profile falls only as r⁻³.
///
/// The form and its coefficients were fitted to Monte Carlo random walks for this project; no paper has them.
/// The L1 distance of 2πrR/A from the walks is 1.25 % (searchlight) and 1.03 % (diffuse) in the mean over A.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExponentialDipoleModel {
    /// w, the exponential's share of the energy, must come out in [0, 1].
    pub exponential_weight: [f64; 3],
    /// d, the exponential's decay length in mean free paths, must come out > 0.
    pub exponential_length: [f64; 3],
    /// z, the depth of the dipole's source in mean free paths, must come out > 0.
    pub dipole_depth: [f64; 3],
    /// s/(1 - A), s being the decay of the dipole per mean free path, must come out ≥ 0.
    pub dipole_attenuation: [f64; 3],
}

impl ExponentialDipoleModel {
    /// Fitted to Monte Carlo with perpendicular entry.
    pub const SEARCHLIGHT: ExponentialDipoleModel = ExponentialDipoleModel {
        exponential_weight: [0.6129, -0.2621, 0.0217],
        exponential_length: [0.2029, 0.7695, -0.1427],
        dipole_depth: [0.6277, 3.1588, -1.1344],
        dipole_attenuation: [1.0011, -0.577, 0.1821],
    };

    /// Fitted to Monte Carlo with diffuse entry.
    pub const DIFFUSE: ExponentialDipoleModel = ExponentialDipoleModel {
        exponential_weight: [0.684, -0.2506, 0.0013],
        exponential_length: [0.3031, 0.6816, -0.0711],
        dipole_depth: [1.0094, 2.311, -0.8554],
        dipole_attenuation: [1.0162, -0.1398, -0.0837],
    };

    /// The length this model is parametrized by.
    pub const LENGTH: Length = Length::MeanFreePath;

    /// The profile of a medium whose length is the mean free path.
    pub fn profile(&self, medium: Medium) -> Result<ExponentialDipoleProfile, ModelError> {
        let surface_albedo = medium.surface_albedo();
        let weight = quadratic(self.exponential_weight, surface_albedo);
        let length = quadratic(self.exponential_length, surface_albedo);
        let depth = quadratic(self.dipole_depth, surface_albedo);
        // The sum turns a -0.0 from A = 1 into 0.0.
        let attenuation = (1.0 - surface_albedo) * quadratic(self.dipole_attenuation, surface_albedo) + 0.0;
        let exponential = Exponential::new(surface_albedo, weight, length)?;
        let dipole = DipoleSource::new(surface_albedo, depth, attenuation)?;
        Ok(ExponentialSourceSum::new(
            surface_albedo,
            medium.mean_free_path_mm(),
            [exponential],
            [(1.0 - weight, dipole)],
        ))
    }
}

fn quadratic([c0, c1, c2]: [f64; 3], surface_albedo: f64) -> f64 {
    c0 + (c1 + c2 * surface_albedo) * surface_albedo
}

/// What tables say of both settings.
const FITTED: [&str; 2] =
    ["fitted for this project to random walks, perpendicular entry", "the same, diffuse entry"];

impl ProfileModel for ExponentialDipoleModel {
    const DESCRIPTION: Description = Description {
        name: "ExponentialDipole",
        stem: "exponential_dipole",
        caption: "exponential + dipole",
        equation: "cdf(r) = 1 − w e^(−r/d) − (1 − w)(z/ρ) e^(−s(ρ − z)), ρ = √(r² + z²), lengths in mean free paths",
        notes: "w is a share from 0 to 1; d and z are above 0; s/(1 − A) is 0 or more.",
        source: "fitted for this project",
        notation: Notation::Fields { key: "entry", own: "" },
        example: "ExponentialDipole(entry: Searchlight)",
        lengths: &[Self::LENGTH],
        variable: Variable::SURFACE_ALBEDO,
    };

    const COEFFICIENTS: &'static [Coefficient<Self>] = &[
        Coefficient::<Self>::new("exponential_weight", "w", "share of the exponential", |m| {
            &mut m.exponential_weight
        })
        .values(Values::Powers(3)),
        Coefficient::<Self>::new("exponential_length", "d", "length of the exponential", |m| {
            &mut m.exponential_length
        })
        .values(Values::Powers(3)),
        Coefficient::<Self>::new("dipole_depth", "z", "depth of the source", |m| &mut m.dipole_depth)
            .values(Values::Powers(3)),
        Coefficient::<Self>::new("dipole_attenuation", "s/(1 − A)", "decay of the source's field", |m| {
            &mut m.dipole_attenuation
        })
        .values(Values::Powers(3)),
    ];

    const PUBLISHED: &'static [Published<Self>] = &[
        Published::new("exponential_dipole_searchlight", "Searchlight", FITTED[0], || Self::SEARCHLIGHT)
            .entering(Entry::Searchlight),
        Published::new("exponential_dipole_diffuse", "Diffuse", FITTED[1], || Self::DIFFUSE)
            .entering(Entry::Diffuse),
    ];

    const FUNCTIONS: &'static [Function<Self>] = &[
        Function::<Self>::new("w", "w", |m, a| quadratic(m.exponential_weight, a)),
        Function::<Self>::new("d", "d (mean free paths)", |m, a| quadratic(m.exponential_length, a))
            .length_power(-1),
        Function::<Self>::new("z", "z (mean free paths)", |m, a| quadratic(m.dipole_depth, a))
            .length_power(-1),
        Function::<Self>::new("s/(1 − A)", "s/(1 − A) (1/mean free path)", |m, a| {
            quadratic(m.dipole_attenuation, a)
        })
        .length_power(1),
    ];

    fn boxed_profile(&self, medium: Medium, _channel: Channel) -> Result<Box<dyn RadialProfile>, ModelError> {
        Ok(Box::new(self.profile(medium)?))
    }
}

/// The member of [`ExponentialDipoleModel`] that belongs to one medium.
pub type ExponentialDipoleProfile = ExponentialSourceSum<1, 1>;

impl ExponentialDipoleProfile {
    /// w, the exponential's share of the energy.
    pub fn exponential_weight(&self) -> f64 {
        self.exponentials[0].weight
    }

    /// d, the exponential's decay length, mm.
    pub fn exponential_length_mm(&self) -> f64 {
        self.exponential_lengths_mm()[0]
    }

    /// z, the depth of the dipole's source, mm.
    pub fn dipole_depth_mm(&self) -> f64 {
        self.dipole_depths_mm()[0]
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may panic")]

    use super::*;

    #[test]
    fn the_profile_is_its_equation() {
        for model in [ExponentialDipoleModel::SEARCHLIGHT, ExponentialDipoleModel::DIFFUSE] {
            for surface_albedo in [0.0, 0.3, 0.9, 1.0] {
                let p = model.profile(Medium::new(surface_albedo, 1.0).unwrap()).unwrap();
                let (w, d) = (p.exponential_weight(), p.exponential_length_mm());
                let (z, s) = (p.dipole_depth_mm(), p.dipole_attenuation_per_mm());
                for r in [0.01, 0.3, 1.0, 4.0, 20.0] {
                    let rho = f64::hypot(r, z);
                    let decay = (-s * (rho - z)).exp();
                    let cdf = 1.0 - w * (-r / d).exp() - (1.0 - w) * z / rho * decay;
                    let pdf =
                        w / d * (-r / d).exp() + (1.0 - w) * z * r * (1.0 + s * rho) * decay / rho.powi(3);
                    // As printed, the cdf cancels to an absolute rounding, and s(ρ - z) < 20 multiplies one.
                    assert!((p.radial_cdf(r) - cdf).abs() < 1e-15 * 4.0);
                    assert!((p.radial_pdf(r) / pdf - 1.0).abs() < 1e-14);
                }
            }
        }
    }

    #[test]
    fn nothing_is_absorbed_at_surface_albedo_one() {
        for model in [ExponentialDipoleModel::SEARCHLIGHT, ExponentialDipoleModel::DIFFUSE] {
            let p = model.profile(Medium::new(1.0, 1.0).unwrap()).unwrap();
            assert_eq!(p.dipole_attenuation_per_mm().to_bits(), 0);
            // The tail is then (1 - w) z/r.
            let expected = (1.0 - p.exponential_weight()) * p.dipole_depth_mm() / 1e12;
            assert!((p.radial_tail(1e12) / expected - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn each_part_alone_is_a_profile() {
        for weight in [0.0, 1.0] {
            let model = ExponentialDipoleModel {
                exponential_weight: [weight, 0.0, 0.0],
                ..ExponentialDipoleModel::SEARCHLIGHT
            };
            let p = model.profile(Medium::new(0.5, 1.0).unwrap()).unwrap();
            for u in [0.0, 1e-12, 0.3, 0.7, 1.0 - 1e-12] {
                assert!((p.radial_cdf(p.sample_radius(u)) - u).abs() < 1e-14);
            }
            assert_eq!(p.area_pdf(0.0).is_finite(), weight == 0.0);
        }
    }

    #[test]
    fn what_is_no_profile_says_why() {
        let good = ExponentialDipoleModel::SEARCHLIGHT;
        let fail = |model: ExponentialDipoleModel| {
            let error = model.profile(Medium::new(0.5, 1.0).unwrap()).unwrap_err();
            (error.coefficient(), error.to_string())
        };
        let at = |value: f64| [value, 0.0, 0.0];
        let error = |path: &str, message: &str| (path.to_owned(), format!("{message} at surface albedo 0.5"));
        assert_eq!(
            fail(ExponentialDipoleModel { exponential_weight: at(1.25), ..good }),
            error("exponential_weight", "the exponential's weight is 1.25")
        );
        assert_eq!(
            fail(ExponentialDipoleModel { exponential_length: at(0.0), ..good }),
            error("exponential_length", "the exponential's length is 0")
        );
        assert_eq!(
            fail(ExponentialDipoleModel { dipole_depth: at(-2.0), ..good }),
            error("dipole_depth", "the dipole's depth is -2")
        );
        assert_eq!(
            fail(ExponentialDipoleModel { dipole_attenuation: at(-1.0), ..good }),
            error("dipole_attenuation", "the dipole's attenuation is -0.5")
        );
    }
}
