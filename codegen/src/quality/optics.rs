//! The profiles of one material, with tables of what is asked for often.

use subsurface_kernel::constants::FILTER_QUANTILE;
use subsurface_profile::description::Dependence;
use subsurface_profile::{Channel, Medium, Model, RadialProfile};

use crate::curves::{Knots, NoProfile, NodesOf, quantiles};
use crate::material::Material;

use super::density_table::DensityTable;
use super::edge_curve::EdgeCurve;
use super::gathered::Rgb;
use super::line_spread::{beyond_line, line_spread};
use super::log_table::LogTable;

/// What a material looks like, but for its size: equal ones are tried once.
#[derive(Clone, Debug, PartialEq)]
struct Appearance {
    model: Model,
    /// Lengths of the channels: the longest 1, or in mm where the model has absolute ones too.
    lengths: Rgb,
    surface_albedo: Rgb,
}

impl Appearance {
    fn of(material: &Material) -> Self {
        let model = material.profile.model.clone();
        let longest = material.length_mm.into_iter().fold(0.0, f64::max);
        let (lengths, surface_albedo) = match model.dependence() {
            // Neither plays a part.
            Dependence::Channel => ([1.0; 3], [0.5; 3]),
            Dependence::Medium => {
                (material.length_mm.map(|length| length / longest), material.surface_albedo)
            }
            // Some lengths are in mm, and so all must be.
            Dependence::MediumAndChannel => (material.length_mm, material.surface_albedo),
        };
        Self { model, lengths, surface_albedo }
    }
}

/// Largest surface albedo that has a curve of its own, see `curves.rs`.
const LARGEST_SURFACE_ALBEDO: f64 = 0.999;

/// Share of the light that ends the edge curves.
const LAST_SHARE: f64 = 0.9999;

/// The profiles of one material. Its unit of length is arbitrary.
#[derive(Debug)]
pub(super) struct Optics {
    pub(super) channels: [ChannelOptics; 3],
    /// The channel whose light goes farthest: radii are drawn from it.
    pub(super) widest: usize,
    /// Mean radius of the widest channel.
    pub(super) mean_radius: f64,
    /// Densities per area by radius.
    pub(super) densities: DensityTable,
}

/// The profile of one channel.
#[derive(Debug)]
pub(super) struct ChannelOptics {
    pub(super) profile: Box<dyn RadialProfile>,
    /// Quantile radii as the kernels read them.
    pub(super) curve: Knots,
    /// Share of the light beyond a line as the kernels read it.
    pub(super) edge_curve: EdgeCurve,
    /// Light per length beside a line, by distance.
    pub(super) line_spread: LogTable,
}

impl Optics {
    /// The optics of a list of materials, those that look alike once.
    pub(super) fn of_all(materials: &[Material]) -> Result<Vec<Self>, NoProfile> {
        let mut known: Vec<Appearance> = Vec::new();
        let mut optics = Vec::new();
        for material in materials {
            let appearance = Appearance::of(material);
            if known.contains(&appearance) {
                continue;
            }
            optics.push(Self::of(&appearance, material)?);
            known.push(appearance);
        }
        Ok(optics)
    }

    fn of(appearance: &Appearance, material: &Material) -> Result<Self, NoProfile> {
        let profile = |channel: Channel, surface_albedo: f64| {
            Medium::new(surface_albedo, appearance.lengths[channel.index()])
                .map_err(|error| error.to_string())
                .and_then(|medium| appearance.model.profile(medium, channel).map_err(|e| e.to_string()))
                .map_err(|reason| NoProfile { span: material.profile.span.clone(), surface_albedo, reason })
        };
        let channel = |channel: Channel| -> Result<ChannelOptics, NoProfile> {
            let surface_albedo = appearance.surface_albedo[channel.index()];
            let exact = profile(channel, surface_albedo)?;
            let curve = quantiles(&*profile(channel, surface_albedo.min(LARGEST_SURFACE_ALBEDO))?);
            // Edge curves of all surface albedos, or of all channels, end where the widest does.
            let mut edge_reach = profile(channel, LARGEST_SURFACE_ALBEDO)?.sample_radius(LAST_SHARE);
            if NodesOf::model(&appearance.model) != NodesOf::SurfaceAlbedo {
                for other in Channel::ALL {
                    edge_reach =
                        edge_reach.max(profile(other, LARGEST_SURFACE_ALBEDO)?.sample_radius(LAST_SHARE));
                }
            }
            let edge_curve = EdgeCurve::new(|distance| beyond_line(&*exact, distance), edge_reach);
            let mean = mean_radius(&curve);
            // From a twentieth of the smallest pixel to the last column of the largest; power laws go on beyond.
            let (first, last) = (0.03 * mean, 600.0 * mean);
            Ok(ChannelOptics {
                line_spread: LogTable::new(first, last, |distance| line_spread(&*exact, distance)),
                profile: exact,
                curve,
                edge_curve,
            })
        };
        let [red, green, blue] = Channel::ALL.map(channel);
        let channels = [red?, green?, blue?];
        // As `surface_point` of the shaders: the first of equals.
        let reach = [0, 1, 2].map(|channel: usize| quantile(&channels[channel].curve, FILTER_QUANTILE).0);
        let red_or_green = if reach[0] >= reach[1] { 0 } else { 1 };
        let widest = if reach[0].max(reach[1]) >= reach[2] { red_or_green } else { 2 };
        let mean_radius = mean_radius(&channels[widest].curve);
        // From less than a tenth of the smallest pixel to more than any filter's radius.
        let densities = DensityTable::new(5e-3 * mean_radius, 600.0 * mean_radius, |radius| {
            [0, 1, 2].map(|channel: usize| channels[channel].profile.area_pdf(radius))
        });
        Ok(Self { channels, widest, mean_radius, densities })
    }
}

/// (radius, its derivative by u) at the quantile `u` of a curve: twin of `curve_quantile`.
pub(super) fn quantile(curve: &Knots, u: f64) -> (f64, f64) {
    let steps = (curve.len() - 1) as f64;
    let root = (1.0 - u).max(0.0).sqrt();
    let place = (1.0 - root) * steps;
    let step = place.floor().min(steps - 1.0);
    let start = curve[step as usize];
    let rise = curve[step as usize + 1] - start;
    // √(1 - u) is kept above that of u = 1 - 2^-24, the f32 before 1.
    (start + rise * (place - step), rise * steps * 0.5 / root.max(2.441_406_25e-4))
}

/// Mean radius of a curve: between two of its knots the radius grows evenly with t, u = 1 - (1 - t)².
fn mean_radius(curve: &Knots) -> f64 {
    let steps = (curve.len() - 1) as f64;
    let share = |index: usize| 1.0 - (1.0 - index as f64 / steps).powi(2);
    curve
        .windows(2)
        .enumerate()
        .map(|(index, ends)| 0.5 * (ends[0] + ends[1]) * (share(index + 1) - share(index)))
        .sum()
}
