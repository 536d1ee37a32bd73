//! The profiles of one material, with tables of what is asked for often.

mod density_table;
pub(crate) mod line_spread;
mod log_table;

use subsurface_kernel::constants::FILTER_QUANTILE;
use subsurface_profile::description::Dependence;
use subsurface_profile::{Channel, Medium, Model, RadialProfile};

use crate::gather::curve::{
    Knots, LARGEST_SURFACE_ALBEDO, LAST_SHARE, NODES, NodesOf, mean_radius, node_albedo, quantile, quantiles,
};
use crate::material::Material;
use crate::no_profile::NoProfile;

use crate::gather::gathered::Rgb;
use crate::kernels::separable::edge_spread::EdgeCurve;
use density_table::DensityTable;
use line_spread::{beyond_line, line_spread};
use log_table::LogTable;

/// Surface albedo of a material's other surface, as a part of its own: a mole on skin.
const OTHER_ALBEDO: f64 = 0.85;

/// What a material looks like, but for its size: equal ones are tried once.
#[derive(Clone, Debug, PartialEq)]
struct Appearance {
    model: Model,
    /// Lengths of the channels: the longest 1, or in mm where the model has absolute ones too.
    lengths: Rgb,
    surface_albedo: Rgb,
}

impl Appearance {
    fn of(material: &Material<'_>) -> Self {
        let model = material.model.clone();
        let longest = material.mean_free_path_mm.into_iter().fold(0.0, f64::max);
        let (lengths, surface_albedo) = match model.dependence() {
            // Neither plays a part.
            Dependence::Channel => ([1.0; 3], [0.5; 3]),
            Dependence::Medium => {
                (material.mean_free_path_mm.map(|length| length / longest), material.surface_albedo)
            }
            // Some lengths are in mm, and so all must be.
            Dependence::MediumAndChannel => (material.mean_free_path_mm, material.surface_albedo),
        };
        Self { model, lengths, surface_albedo }
    }

    /// The same where it is white, as in scenes without textures of the surface albedo; `None` for a model that does not
    /// depend on it.
    fn of_white(material: &Material<'_>) -> Option<Self> {
        let mut white = Self::of(&Material { surface_albedo: [1.0; 3], ..*material });
        match material.model.dependence() {
            Dependence::Channel => return None,
            // Channels of other lengths have the same shape: one stands for all.
            Dependence::Medium => white.lengths = [1.0; 3],
            Dependence::MediumAndChannel => {}
        }
        Some(white)
    }
}

/// The profiles of one material. Its unit of length is arbitrary.
#[derive(Debug)]
pub(crate) struct Optics {
    pub(crate) channels: [ChannelOptics; 3],
    /// The channel whose light goes farthest: radii are drawn from it.
    pub(crate) widest: usize,
    /// Mean radius of the widest channel.
    pub(crate) mean_radius: f64,
    /// Densities per area by radius.
    pub(crate) densities: DensityTable,
    /// The same material with its other surface albedo, and with the mean of both; `None` where that changes nothing.
    pub(crate) others: Option<Box<[Self; 2]>>,
}

/// The profile of one channel.
#[derive(Debug)]
pub(crate) struct ChannelOptics {
    pub(crate) profile: Box<dyn RadialProfile>,
    /// Quantile radii as the kernels read them.
    pub(crate) curve: Knots,
    /// Share of the light beyond a line as the kernels read it.
    pub(crate) edge_curve: EdgeCurve,
    /// Light per length beside a line, by distance.
    pub(crate) line_spread: LogTable,
}

impl Optics {
    /// The optics of a list of materials, then of their models where they are white; those that look alike once.
    pub(crate) fn of_all(materials: &[Material<'_>]) -> Result<Vec<Self>, NoProfile> {
        let mut known: Vec<Appearance> = Vec::new();
        let mut optics = Vec::new();
        let own_appearances: Vec<Appearance> = materials.iter().map(Appearance::of).collect();
        let own = own_appearances.iter().cloned().enumerate();
        let white = materials.iter().map(Appearance::of_white).enumerate();
        let white = white.filter_map(|(number, white)| Some((number, white?)));
        for (number, appearance) in own.chain(white) {
            if known.contains(&appearance) {
                continue;
            }
            let mut own = Self::of(&appearance, number)?;
            // What is white has no texture of the surface albedo.
            if own_appearances.contains(&appearance) && appearance.model.dependence() != Dependence::Channel {
                let darker = |factor: f64| {
                    let surface_albedo = appearance.surface_albedo.map(|albedo| factor * albedo);
                    Self::of(&Appearance { surface_albedo, ..appearance.clone() }, number)
                };
                own.others = Some(Box::new([darker(OTHER_ALBEDO)?, darker(0.5 * (1.0 + OTHER_ALBEDO))?]));
            }
            optics.push(own);
            known.push(appearance);
        }
        Ok(optics)
    }

    fn of(appearance: &Appearance, material: usize) -> Result<Self, NoProfile> {
        let profile = |channel: Channel, surface_albedo: f64| {
            Medium::new(surface_albedo, appearance.lengths[channel.index()])
                .map_err(|error| error.to_string())
                .and_then(|medium| appearance.model.profile(medium, channel).map_err(|e| e.to_string()))
                .map_err(|reason| NoProfile::new(material, surface_albedo, reason))
        };
        let channel = |channel: Channel| -> Result<ChannelOptics, NoProfile> {
            let surface_albedo = appearance.surface_albedo[channel.index()];
            let exact = profile(channel, surface_albedo)?;
            let baked = profile(channel, surface_albedo.min(LARGEST_SURFACE_ALBEDO))?;
            let curve = quantiles(&*baked);
            // Edge curves of all surface albedos, or of all channels, end where the widest does.
            let reach_of = |channel: Channel| {
                (0..NODES).map(node_albedo).try_fold(0.0_f64, |reach, surface_albedo| {
                    Ok(reach.max(profile(channel, surface_albedo)?.sample_radius(LAST_SHARE)))
                })
            };
            let mut edge_reach = reach_of(channel)?;
            if NodesOf::model(&appearance.model) != NodesOf::SurfaceAlbedo {
                for other in Channel::ALL {
                    edge_reach = edge_reach.max(reach_of(other)?);
                }
            }
            let edge_curve = EdgeCurve::new(|distance| beyond_line(&*baked, distance), edge_reach);
            let mean = mean_radius(&curve);
            // From below the smallest pixel of a picture with depth to the last column of the largest; power laws go on beyond.
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
        // From half of the smallest pixel to more than any filter's radius.
        let densities = DensityTable::new(5e-3 * mean_radius, 600.0 * mean_radius, |radius| {
            [0, 1, 2].map(|channel: usize| channels[channel].profile.area_pdf(radius))
        });
        Ok(Self { channels, widest, mean_radius, densities, others: None })
    }
}
