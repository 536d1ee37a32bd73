//! An exponential near the point of entry and a dipole's far field.

use std::f64::consts::PI;

use crate::dipole_source::DipoleSource;
use crate::inverse::increasing_root;
use crate::model_error::{require_exponential, require_finite};
use crate::radial_profile::{legal_radius, legal_u};
use crate::{Length, Medium, ModelError, RadialProfile};

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
        let quadratic = |[c0, c1, c2]: [f64; 3]| c0 + (c1 + c2 * surface_albedo) * surface_albedo;
        let weight = quadratic(self.exponential_weight);
        let length = quadratic(self.exponential_length);
        let depth = quadratic(self.dipole_depth);
        // The sum turns a -0.0 from A = 1 into 0.0.
        let attenuation = (1.0 - surface_albedo) * quadratic(self.dipole_attenuation) + 0.0;
        require_exponential(surface_albedo, weight, length)?;
        let dipole = DipoleSource::new(surface_albedo, depth, attenuation)?;
        Ok(ExponentialDipoleProfile {
            surface_albedo,
            mean_free_path_mm: medium.length_mm(),
            weight,
            length,
            dipole,
        })
    }

    pub(crate) fn collect_errors(&self, errors: &mut Vec<ModelError>) {
        for (field, coefficients) in [
            ("exponential_weight", self.exponential_weight),
            ("exponential_length", self.exponential_length),
            ("dipole_depth", self.dipole_depth),
            ("dipole_attenuation", self.dipole_attenuation),
        ] {
            for (power, value) in coefficients.into_iter().enumerate() {
                require_finite([(format!("{field}[{power}]").as_str(), value)], errors);
            }
        }
    }
}

/// The member of [`ExponentialDipoleModel`] that belongs to one medium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExponentialDipoleProfile {
    surface_albedo: f64,
    mean_free_path_mm: f64,
    /// w in [0, 1].
    weight: f64,
    /// d > 0 at mean free path 1.
    length: f64,
    dipole: DipoleSource,
}

impl ExponentialDipoleProfile {
    /// w, the exponential's share of the energy.
    pub fn exponential_weight(&self) -> f64 {
        self.weight
    }

    /// d, the exponential's decay length, mm.
    pub fn exponential_length_mm(&self) -> f64 {
        self.length * self.mean_free_path_mm
    }

    /// z, the depth of the dipole's source, mm.
    pub fn dipole_depth_mm(&self) -> f64 {
        self.dipole.depth * self.mean_free_path_mm
    }

    /// s, the dipole's decay, mm⁻¹. 0 at A = 1.
    pub fn dipole_attenuation_per_mm(&self) -> f64 {
        self.dipole.attenuation / self.mean_free_path_mm
    }

    fn unit_radius(&self, radius_mm: f64) -> f64 {
        legal_radius(legal_radius(radius_mm) / self.mean_free_path_mm)
    }

    fn unit_cdf(&self, r: f64) -> f64 {
        let exponential = -(-r / self.length).exp_m1();
        let dipole = self.dipole.cdf(r);
        (self.weight * exponential + (1.0 - self.weight) * dipole).clamp(0.0, 1.0)
    }

    fn unit_tail(&self, r: f64) -> f64 {
        let exponential = (-r / self.length).exp();
        let dipole = self.dipole.tail(r);
        (self.weight * exponential + (1.0 - self.weight) * dipole).clamp(0.0, 1.0)
    }

    fn unit_radial_pdf(&self, r: f64) -> f64 {
        self.weight * ((-r / self.length).exp() / self.length)
            + (1.0 - self.weight) * self.dipole.radial_pdf(r)
    }
}

impl RadialProfile for ExponentialDipoleProfile {
    fn surface_albedo(&self) -> f64 {
        self.surface_albedo
    }

    /// Infinite at r = 0, as 1/r, unless the exponential has no share.
    fn area_pdf(&self, radius_mm: f64) -> f64 {
        let r = self.unit_radius(radius_mm);
        let exponential = if self.weight > 0.0 {
            self.weight * ((-r / self.length).exp() / self.length) / (2.0 * PI * r)
        } else {
            0.0
        };
        let dipole = (1.0 - self.weight) * self.dipole.area_pdf(r);
        (exponential + dipole) / self.mean_free_path_mm / self.mean_free_path_mm
    }

    /// (w/d) e^(-r/d) + (1 - w) z r (1 + sρ) e^(-s(ρ - z))/ρ³, at mean free path 1.
    fn radial_pdf(&self, radius_mm: f64) -> f64 {
        self.unit_radial_pdf(self.unit_radius(radius_mm)) / self.mean_free_path_mm
    }

    fn radial_cdf(&self, radius_mm: f64) -> f64 {
        self.unit_cdf(self.unit_radius(radius_mm))
    }

    fn radial_tail(&self, radius_mm: f64) -> f64 {
        self.unit_tail(self.unit_radius(radius_mm))
    }

    /// Newton's method between the quantiles of the two parts, in the logarithms of r and of the cdf or tail,
    /// where both parts are nearly straight lines.
    fn sample_radius(&self, u: f64) -> f64 {
        if u.is_nan() {
            return u;
        }
        let u = legal_u(u);
        // Below the smallest normal number logarithms lose their meaning; 0 is off by less than 1e-153 mfp.
        if u < f64::MIN_POSITIVE {
            return 0.0;
        }
        let log_q = (-u).ln_1p();
        let of_exponential = -self.length * log_q;
        let of_dipole = self.dipole.radius_beyond(log_q);
        let bracket = [of_exponential.min(of_dipole).ln(), of_exponential.max(of_dipole).ln()];
        let start = self.weight * of_exponential.ln() + (1.0 - self.weight) * of_dipole.ln();
        let log_r = if u < 0.5 {
            let log_u = u.ln();
            let value_and_slope = |log_r: f64| {
                let r = log_r.exp();
                let cdf = self.unit_cdf(r);
                (cdf.ln() - log_u, r * self.unit_radial_pdf(r) / cdf)
            };
            increasing_root(value_and_slope, bracket, start, 1.0)
        } else {
            let value_and_slope = |log_r: f64| {
                let r = log_r.exp();
                let tail = self.unit_tail(r);
                (log_q - tail.ln(), r * self.unit_radial_pdf(r) / tail)
            };
            increasing_root(value_and_slope, bracket, start, 1.0)
        };
        log_r.exp() * self.mean_free_path_mm
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
                let (w, d, z, s) = (p.weight, p.length, p.dipole.depth, p.dipole.attenuation);
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
        let fail = |model: ExponentialDipoleModel| model.profile(Medium::new(0.5, 1.0).unwrap()).unwrap_err();
        let at = |value: f64| [value, 0.0, 0.0];
        let surface_albedo = 0.5;
        assert_eq!(
            fail(ExponentialDipoleModel { exponential_weight: at(1.25), ..good }),
            ModelError::ExponentialWeightOutOfRange { surface_albedo, weight: 1.25 }
        );
        assert_eq!(
            fail(ExponentialDipoleModel { exponential_length: at(0.0), ..good }),
            ModelError::ExponentialLengthNotPositive { surface_albedo, length: 0.0 }
        );
        assert_eq!(
            fail(ExponentialDipoleModel { dipole_depth: at(-2.0), ..good }),
            ModelError::DipoleDepthNotPositive { surface_albedo, depth: -2.0 }
        );
        assert_eq!(
            fail(ExponentialDipoleModel { dipole_attenuation: at(-1.0), ..good }),
            ModelError::NegativeDipoleAttenuation { surface_albedo, attenuation: -0.5 }
        );
    }
}
