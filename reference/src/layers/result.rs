//! What a layered run has measured.

use std::f64::consts::PI;

use crate::Estimate;

use super::run::LayerRun;
use super::tally::{Exits, Moments, Tally};

/// Totals and distributions of a run. Fractions refer to the beam before it meets the surface. The standard errors of a
/// single packet are infinite.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct LayerResult {
    /// What was simulated.
    pub run: LayerRun,
    /// The seed of its random numbers.
    pub seed: u64,
    /// Packets traced: fewer than asked for when the run was interrupted.
    pub photons: u64,
    /// Fraction reflected where the beam meets the surface, clear layers on top included. Exact.
    pub specular_reflectance: f64,
    /// Fraction that leaves through the top, specular reflection excluded (MCML's `Rd`).
    pub diffuse_reflectance: Estimate,
    /// Fraction that leaves through the bottom, unscattered light included (MCML's `Tt`).
    pub transmittance: Estimate,
    /// Fraction that is absorbed (MCML's `A`).
    pub absorbed: Estimate,
    /// Fraction absorbed in each layer, from the top (MCML's `A_l`).
    pub absorbed_by_layer: Vec<Estimate>,
    /// Absorbed energy per depth, cm⁻¹ (MCML's `A_z`).
    pub absorbed_by_depth: Vec<f64>,
    /// Reflected energy per area at each radius, cm⁻² (MCML's `Rd_r`); the last cell holds all beyond it too.
    pub reflectance_by_radius: Vec<Estimate>,
    /// Reflected energy per solid angle at each exit angle, sr⁻¹ (MCML's `Rd_a`).
    pub reflectance_by_angle: Vec<Estimate>,
    /// Transmitted energy per area at each radius, cm⁻² (MCML's `Tt_r`); the last cell holds all beyond it too.
    pub transmittance_by_radius: Vec<Estimate>,
    /// Transmitted energy per solid angle at each exit angle, sr⁻¹ (MCML's `Tt_a`).
    pub transmittance_by_angle: Vec<Estimate>,
    /// Energy that the roulette took, or gave where negative: 0 on average, and what specular reflectance, diffuse
    /// reflectance, transmittance and absorbed fraction lack to a sum of exactly 1.
    pub roulette: f64,
}

impl LayerResult {
    pub(super) fn new(run: &LayerRun, seed: u64, specular_reflectance: f64, tally: &Tally) -> Self {
        let photons = tally.photons;
        let whole = |moments: &Moments| moments.estimate(photons, 1.0);
        Self {
            run: run.clone(),
            seed,
            photons,
            specular_reflectance,
            diffuse_reflectance: whole(&tally.reflected.total),
            transmittance: whole(&tally.transmitted.total),
            absorbed: whole(&tally.absorbed),
            absorbed_by_layer: tally.absorbed_by_layer.iter().map(whole).collect(),
            absorbed_by_depth: tally.absorbed_by_depth(run.grid()),
            reflectance_by_radius: per_area(&tally.reflected, photons, run.grid().radius_step()),
            reflectance_by_angle: per_solid_angle(&tally.reflected, photons, run.grid().angle_step()),
            transmittance_by_radius: per_area(&tally.transmitted, photons, run.grid().radius_step()),
            transmittance_by_angle: per_solid_angle(&tally.transmitted, photons, run.grid().angle_step()),
            roulette: tally.roulette(),
        }
    }

    /// Specular and diffuse reflectance together.
    pub fn total_reflectance(&self) -> Estimate {
        Estimate {
            mean: self.specular_reflectance + self.diffuse_reflectance.mean,
            standard_error: self.diffuse_reflectance.standard_error,
        }
    }
}

/// Divides by the area of each ring, 2π (i + ½) dr².
fn per_area(exits: &Exits, photons: u64, step: f64) -> Vec<Estimate> {
    let rings = exits.by_radius.iter().enumerate();
    rings
        .map(|(index, moments)| {
            moments.estimate(photons, 1.0 / (2.0 * PI * (index as f64 + 0.5) * step * step))
        })
        .collect()
}

/// Divides by MCML's solid angle of each cell, 2π sin((i + ½) dα) dα, an approximation that is good for many cells.
fn per_solid_angle(exits: &Exits, photons: u64, step: f64) -> Vec<Estimate> {
    let cells = exits.by_angle.iter().enumerate();
    cells
        .map(|(index, moments)| {
            moments.estimate(photons, 1.0 / (2.0 * PI * libm::sin((index as f64 + 0.5) * step) * step))
        })
        .collect()
}
