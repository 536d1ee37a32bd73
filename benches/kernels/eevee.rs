//! The gather of Blender's EEVEE: see `eevee.wgsl`.

use crate::burley::scattering_distance_mm;
use crate::pass::{Pass, Settings};
use std::f64::consts::PI;
use std::fmt::Display;
use subsurface_cli::failure::Failure;
use subsurface_cli::kernel_bench::{Contender, Entry, Stage};
use subsurface_profile::{BurleyModel, BurleyShape, Length, Medium, RadialProfile as _};

/// 16 taps on a golden-angle spiral.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Eevee;

const TAPS: u32 = 16;

/// Nothing is read beyond so many d.
const REACH: f64 = 16.0;

impl Contender for Eevee {
    fn family(&self) -> String {
        "EEVEE gather".to_owned()
    }

    fn taps(&self) -> u32 {
        TAPS
    }

    fn enter(&self, stage: &Stage<'_>) -> Result<Entry, Failure> {
        let d = match scattering_distance_mm(stage) {
            Ok(d) => d,
            Err(reason) => return Ok(Entry::Declines(reason)),
        };
        // Taps are placed as if the surface were white, [CB15] eq. (6): d = ℓ / s(A).
        let albedo = stage.subject.material().surface_albedo;
        let white_d = |channel: usize| {
            d[channel] * BurleyShape::DIFFUSE.at(albedo[channel]) / BurleyShape::DIFFUSE.at(1.0)
        };
        let placed = (0..3).map(white_d).fold(0.0, f64::max);
        let settings = Settings { scattering_distance_mm: d, reach_mm: REACH * placed, taps: TAPS, axis: 0 };
        let pass = Pass::new(stage, include_str!("eevee.wgsl"), &spiral(placed)?, &[settings])?;
        Ok(Entry::Runs(Box::new(pass)))
    }
}

/// Offsets over the `d` that they are placed for, and 8π times their density per area, mm⁻².
fn spiral(d: f64) -> Result<Vec<[f32; 4]>, Failure> {
    let defect = |error: &dyn Display| Failure::new(error.to_string(), "please report this as a defect");
    // s = 1 whatever the albedo: a profile whose d is its length.
    let shape = BurleyShape { constant: 1.0, slope: 0.0, amplitude: 0.0, pivot: 0.0, exponent: 1.0 };
    let medium = Medium::new(1.0, d).map_err(|error| defect(&error))?;
    let model = BurleyModel { length: Length::MeanFreePath, shape };
    let profile = model.profile(medium).map_err(|error| defect(&error))?;
    let within = profile.radial_cdf(REACH * d);
    let tap = |index: u32| {
        let radius_mm = profile.sample_radius((f64::from(index) + 0.5) / f64::from(TAPS) * within);
        let angle = f64::from(index) * PI * (3.0 - 5f64.sqrt());
        let density = 8.0 * PI * profile.area_pdf(radius_mm) / within;
        [radius_mm / d * angle.cos(), radius_mm / d * angle.sin(), density, 0.0].map(|value| value as f32)
    };
    Ok((0..TAPS).map(tap).collect())
}
