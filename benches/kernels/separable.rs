//! The separable kernel as published: see `separable.wgsl`.

use crate::pass::{Pass, Settings};
use crate::uniform_subject::{profiles, widest_radius_mm};
use subsurface_cli::failure::Failure;
use subsurface_cli::kernel_bench::{Contender, Entry, Goal, Stage};
use subsurface_profile::fit::{Family, Options, fit};
use subsurface_profile::{Model, ModelKind, RadialData, RadialProfile, RadialRow};

/// Jimenez et al. 2015 with a sum of Gaussians, fitted to the subject's profile.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Separable {
    /// Taps per pass, odd.
    pub(crate) taps: u32,
}

/// Gaussians of the sum: as many as d'Eon and Luebke 2007 (GPU Gems 3, ch. 14) take for skin.
const GAUSSIANS: usize = 6;

/// Bins of the profile that the sum is fitted to.
const BINS: u32 = 200;

/// Share of the widest channel's energy that the fit sees.
const FITTED: f64 = 0.9999;

/// Share of the widest channel's energy within the row's half width. With 17 taps, 0.95 to 0.995 give the same error to
/// 0.5 dB; farther in the tail is lost, farther out too few taps are left for the middle.
const REACH_QUANTILE: f64 = 0.97;

impl Contender for Separable {
    fn family(&self) -> String {
        "separable, published".to_owned()
    }

    fn taps(&self) -> u32 {
        self.taps
    }

    fn goal(&self) -> Option<Goal> {
        (self.taps == 17).then_some(Goal::FasterAndCloser)
    }

    fn enter(&self, stage: &Stage<'_>) -> Result<Entry, Failure> {
        let prepared = profiles(stage).and_then(|profiles| {
            let gaussians: Vec<Sum> =
                profiles.iter().map(|profile| sum_of_gaussians(&**profile)).collect::<Result<_, _>>()?;
            let reach_mm = widest_radius_mm(&profiles, REACH_QUANTILE);
            Ok((row(&gaussians, reach_mm, self.taps), reach_mm))
        });
        let (row, reach_mm) = match prepared {
            Ok(prepared) => prepared,
            Err(reason) => return Ok(Entry::Declines(reason)),
        };
        let along = |axis| Settings { reach_mm, taps: self.taps, axis, ..Settings::default() };
        let pass = Pass::new(stage, include_str!("separable.wgsl"), &row, &[along(0), along(1)])?;
        Ok(Entry::Runs(Box::new(pass)))
    }
}

/// Weights and variances (mm²) of a sum of Gaussians.
type Sum = Vec<(f64, f64)>;

/// Fits a sum of Gaussians to a profile, as the profiles of [J15] are sums of Gaussians.
fn sum_of_gaussians(profile: &dyn RadialProfile) -> Result<Sum, String> {
    let albedo = profile.surface_albedo();
    let end_mm = profile.sample_radius(FITTED);
    // Narrow bins near the source, where the profile is steep.
    let edge = |index: u32| end_mm * (f64::from(index) / f64::from(BINS)).powi(2);
    let bin = |index: u32| {
        let (low, high) = (edge(index), edge(index + 1));
        let energy = profile.radial_cdf(high) - profile.radial_cdf(low);
        // 2π times the mean of r·R is the energy per width.
        RadialRow::bin(low, high, albedo * energy / (2.0 * std::f64::consts::PI * (high - low)))
    };
    let data = RadialData::new(albedo, (0..BINS).map(bin).collect()).map_err(|error| error.to_string())?;
    let data = [data];
    let family = Family::of(ModelKind::GaussianSum).and_then(|family| family.with_terms(GAUSSIANS));
    let start = family.ok_or("sums of Gaussians cannot be fitted")?.start(&data);
    let fitted = fit(&start, &data, &Options::default()).map_err(|error| error.to_string())?;
    let Model::GaussianSum(sum) = fitted.model else { return Err("the fit is no sum of Gaussians".into()) };
    let weight: f64 = sum.terms.iter().map(|term| term.weight[0]).sum();
    Ok(sum.terms.iter().map(|term| (term.weight[0] / weight, term.variance_mm2)).collect())
}

/// The row of taps of [J15], section 5: offsets grow with the square of their index, each weighs what its neighbours
/// leave it of the line times the line's value at the point, and the sum is 1. Centre first.
fn row(gaussians: &[Sum], reach_mm: f64, taps: u32) -> Vec<[f32; 4]> {
    let half = f64::from(taps / 2);
    let offset = |index: u32| {
        let x = f64::from(index) / half - 1.0;
        reach_mm * x.abs() * x
    };
    let line = |sum: &Sum, x: f64| -> f64 {
        sum.iter().map(|(weight, variance)| weight / variance.sqrt() * (-0.5 * x * x / variance).exp()).sum()
    };
    let width = |index: u32| {
        let to = |neighbour: Option<u32>| {
            let inside = neighbour.filter(|neighbour| *neighbour < taps);
            inside.map_or(0.0, |neighbour| (offset(index) - offset(neighbour)).abs())
        };
        0.5 * (to(index.checked_sub(1)) + to(Some(index + 1)))
    };
    let weight = |index: u32, sum: &Sum| width(index) * line(sum, offset(index));
    let totals: Vec<f64> =
        gaussians.iter().map(|sum| (0..taps).map(|index| weight(index, sum)).sum()).collect();
    let entry = |index: u32| {
        let [r, g, b] = [0, 1, 2].map(|channel| weight(index, &gaussians[channel]) / totals[channel]);
        [offset(index), r, g, b].map(|value| value as f32)
    };
    let centre = taps / 2;
    std::iter::once(centre).chain((0..taps).filter(|index| *index != centre)).map(entry).collect()
}
