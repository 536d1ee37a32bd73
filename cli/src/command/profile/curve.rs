//! What is drawn: a model, a theory or the truth at one surface albedo, in mean free paths.

use super::truth::Truth;
use crate::failure::Failure;
use std::f64::consts::TAU;
use subsurface_profile::single_scattering_albedo::diffuse_per_mean_free_path;
use subsurface_profile::{Channel, Length, Medium, Model, RadialData, RadialProfile};
use subsurface_reference::diffusion::Reflectance;

/// A profile whose radii are mean free paths.
#[derive(Debug)]
pub(super) enum Curve {
    /// A profile model; it conserves the energy.
    Model(Box<dyn RadialProfile>),
    /// A theory; its total may differ from the surface albedo.
    Theory(Integrated),
}

/// The profile of `model` at `surface_albedo`, with radii in mean free paths.
pub(super) fn profile(
    name: &str,
    model: &Model,
    surface_albedo: f64,
    truth: &Truth,
) -> Result<Box<dyn RadialProfile>, Failure> {
    let length = match model.length() {
        Length::MeanFreePath => 1.0,
        Length::DiffuseMeanFreePath => diffuse_per_mean_free_path(truth.medium_at(surface_albedo)),
    };
    let refused = |reason: String| {
        Failure::new(
            format!("the profile `{name}` does not exist at surface albedo {surface_albedo}: {reason}"),
            "choose another surface albedo, or correct the model's coefficients",
        )
    };
    let medium = Medium::new(surface_albedo, length).map_err(|reason| refused(reason.to_string()))?;
    model.profile(medium, Channel::Red).map_err(|reason| refused(reason.to_string()))
}

impl Curve {
    /// r·R(r), per mean free path.
    pub(super) fn r_reflectance(&self, radius: f64) -> f64 {
        match self {
            Self::Model(profile) => profile.surface_albedo() * profile.radial_pdf(radius) / TAU,
            Self::Theory(theory) => theory.reflectance.r_reflectance(radius),
        }
    }

    /// R(r), per mean free path squared.
    pub(super) fn reflectance(&self, radius: f64) -> f64 {
        match self {
            Self::Model(profile) => profile.surface_albedo() * profile.area_pdf(radius),
            Self::Theory(theory) => theory.reflectance.reflectance(radius),
        }
    }

    /// The energy that leaves within `radius`, over the surface albedo.
    pub(super) fn cdf(&self, radius: f64) -> f64 {
        match self {
            Self::Model(profile) => profile.radial_cdf(radius),
            Self::Theory(theory) => theory.cdf(radius),
        }
    }

    /// The radius within which the share `u` of the energy leaves.
    pub(super) fn inverse_cdf(&self, u: f64) -> f64 {
        match self {
            Self::Model(profile) => profile.sample_radius(u),
            Self::Theory(theory) => theory.inverse_cdf(u),
        }
    }

    /// The mean of 2πr·R/A between two radii, per mean free path.
    pub(super) fn mean_density(&self, r_lo: f64, r_hi: f64) -> f64 {
        let energy = match self {
            Self::Model(profile) if profile.radial_cdf(r_lo) > 0.5 => {
                profile.radial_tail(r_lo) - profile.radial_tail(r_hi)
            }
            _ => self.cdf(r_hi) - self.cdf(r_lo),
        };
        energy / (r_hi - r_lo)
    }
}

/// A theory with the integral of its profile, which no theory offers in closed form.
#[derive(Debug)]
pub(super) struct Integrated {
    reflectance: Box<dyn Reflectance>,
    /// Radii and the energy within them over the surface albedo, both rising.
    cdf: Vec<(f64, f64)>,
}

impl Integrated {
    /// Integrates up to `end`, mean free paths.
    pub(super) fn new(reflectance: Box<dyn Reflectance>, surface_albedo: f64, end: f64) -> Self {
        /// Simpson's rule on this many intervals is below a pixel by far.
        const INTERVALS: u32 = 1000;
        // Squares crowd the radii near 0, where profiles are steep.
        let radius = |step: f64| end * (step / f64::from(INTERVALS)).powi(2);
        let density = |r: f64| TAU * reflectance.r_reflectance(r) / surface_albedo;
        let mut cdf = vec![(0.0, 0.0)];
        let mut energy = 0.0;
        for step in 0..INTERVALS {
            let (low, high) = (radius(f64::from(step)), radius(f64::from(step) + 1.0));
            let middle = density(0.5 * (low + high));
            energy += (high - low) / 6.0 * (density(low) + 4.0 * middle + density(high));
            cdf.push((high, energy));
        }
        Self { reflectance, cdf }
    }

    fn cdf(&self, radius: f64) -> f64 {
        interpolated(&self.cdf, radius, |(r, energy)| (*r, *energy))
    }

    fn inverse_cdf(&self, u: f64) -> f64 {
        interpolated(&self.cdf, u, |(r, energy)| (*energy, *r))
    }
}

/// The value at `x` between the points that `get` reads as (x, y), x rising; NaN beyond the last.
fn interpolated<T>(points: &[T], x: f64, get: impl Fn(&T) -> (f64, f64)) -> f64 {
    let above = points.partition_point(|point| get(point).0 < x).max(1);
    let Some(point) = points.get(above) else { return f64::NAN };
    let ((x0, y0), (x1, y1)) = (get(&points[above - 1]), get(point));
    if x1 > x0 { y0 + (y1 - y0) * (x - x0) / (x1 - x0) } else { y0 }
}

/// The rings of the truth, with the share of A that leaves within each ring's outer radius.
pub(super) fn rings(table: &RadialData) -> impl Iterator<Item = (subsurface_profile::RadialRow, f64)> {
    let surface_albedo = table.surface_albedo();
    table.bins().into_iter().scan(0.0, move |cdf, bin| {
        *cdf += bin.energy() / surface_albedo;
        Some((bin, *cdf))
    })
}
