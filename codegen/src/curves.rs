//! Profiles as the kernels read them: rows of a texture, baked from the models in f64.
//!
//! A kernel needs radii at given shares of the energy, and the inverse of a CDF costs more than a texel. So each model is
//! tabulated here, per unit of its length, over the surface albedo and the share.

use subsurface_kernel::constants::{CURVE_ROWS, EDGE_POWER};
use subsurface_profile::{Channel, EdgeSpread, Medium, Model, RadialProfile};

use subsurface_quality::NoProfile;
use subsurface_quality::gather::curve::{
    Knots, NODES, NodesOf, STEPS as TEXELS, fraction, line_quantiles, node_albedo, quantiles,
};

use crate::material::{Material, MaterialSet};
use crate::value::single;

/// Rows below each other: every device of WebGPU has textures of this height. Further rows stand beside them.
const LARGEST_HEIGHT: usize = CURVE_ROWS as usize;

/// Where the rows of one material are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CurvePlace {
    /// Row of node 0, or of the red channel.
    pub(crate) first_curve: u32,
    /// Rows: one per node of the surface albedo, one per channel, or the former for each channel.
    pub(crate) curve_count: u32,
    /// Row of the edge-spread function of node 0; 0 where the kernel reads none. Behind those of all nodes are as many of
    /// the distances within which a line keeps a share of its light.
    pub(crate) first_edge: u32,
    /// Distance from the edge at which the rows of the edge-spread function end, per unit of the model's length.
    pub(crate) edge_reach: f64,
}

/// The curves of a set: an rgba32float texture.
#[derive(Debug)]
pub(crate) struct Curves {
    /// By material number.
    pub(crate) places: Vec<CurvePlace>,
    rows: Vec<Row>,
}

/// (value at the start of the interval, its growth over the interval) of this node, then of the next.
type Row = [[f32; 4]; TEXELS];

impl Curves {
    /// Bakes the models of `set`, each once; with edge-spread functions if `with_edges`.
    pub(crate) fn bake(set: &MaterialSet, with_edges: bool) -> Result<Self, NoProfile> {
        let mut models: Vec<(&Model, Option<[f64; 3]>)> = Vec::new();
        let mut model_of = Vec::with_capacity(set.materials.len());
        let mut curves: Vec<Row> = Vec::new();
        let mut edges: Vec<Row> = Vec::new();
        let mut places: Vec<CurvePlace> = Vec::new();
        for (number, material) in set.materials.iter().enumerate() {
            let model = &material.profile.model;
            // Where curves are in mm, the lengths make another one of each.
            let lengths = (NodesOf::model(model) == NodesOf::Both).then_some(material.mean_free_path_mm);
            if let Some(known) = models.iter().position(|known| *known == (model, lengths)) {
                model_of.push(known);
                continue;
            }
            model_of.push(models.len());
            models.push((model, lengths));
            let profiles = Nodes::of(material, number)?;
            let quantiles: Vec<Knots> = profiles.nodes.iter().map(|profile| quantiles(&**profile)).collect();
            let mut place = CurvePlace {
                first_curve: row_number(curves.len()),
                curve_count: row_number(quantiles.len()),
                first_edge: row_number(edges.len()),
                edge_reach: 0.0,
            };
            curves.extend(profiles.rows(&quantiles));
            if with_edges {
                place.edge_reach = quantiles.iter().map(|radii| radii[TEXELS]).fold(0.0, f64::max);
                let knots: Vec<Knots> =
                    profiles.nodes.iter().map(|profile| edge(&**profile, place.edge_reach)).collect();
                edges.extend(profiles.rows(&knots));
                let lines: Vec<Knots> = knots
                    .iter()
                    .map(|spread| line_quantiles(&spread.map(|inside| 1.0 - inside), place.edge_reach))
                    .collect();
                edges.extend(profiles.rows(&lines));
            }
            places.push(place);
        }
        // Edges follow all radii.
        let shift = if with_edges { row_number(curves.len()) } else { 0 };
        let places = model_of.into_iter().map(|model: usize| {
            let place = places[model];
            CurvePlace { first_edge: place.first_edge + shift, ..place }
        });
        let places = places.collect();
        curves.append(&mut edges);
        Ok(Self { places, rows: curves })
    }

    /// Texels so far: those of whole rows.
    pub(crate) fn texels(&self) -> u32 {
        row_number(TEXELS * self.rows.len())
    }

    /// Adds the rows of a function of two numbers, one for each knot of the first; returns the number of the first row.
    pub(crate) fn append_rows(&mut self, knots: &[Knots]) -> u32 {
        let first = row_number(self.rows.len());
        let next = |node: usize| &knots[(node + 1).min(knots.len() - 1)];
        self.rows.extend(knots.iter().enumerate().map(|(node, own)| row(own, next(node))));
        first
    }

    /// Adds texels behind all rows; the last row is filled up with zeros.
    pub(crate) fn append(&mut self, texels: &[[f32; 4]]) {
        self.rows.extend(texels.chunks(TEXELS).map(|texels| {
            let mut row = [[0.0; 4]; TEXELS];
            row[..texels.len()].copy_from_slice(texels);
            row
        }));
    }

    /// Width and height of the texture, texels.
    pub(crate) fn size(&self) -> [u32; 2] {
        let columns = self.rows.len().div_ceil(LARGEST_HEIGHT);
        [row_number(TEXELS * columns), row_number(self.rows.len().min(LARGEST_HEIGHT))]
    }

    /// The texture's bytes, row by row: f32, little-endian.
    ///
    /// Row r of the curves begins at x = 64·(r / 8192), y = r % 8192.
    pub(crate) fn bytes(&self) -> Vec<u8> {
        let [width, height] = self.size().map(|extent| extent as usize);
        let mut bytes = vec![0; 16 * width * height];
        for (number, row) in self.rows.iter().enumerate() {
            let (column, y) = (number / LARGEST_HEIGHT, number % LARGEST_HEIGHT);
            let start = 16 * (y * width + TEXELS * column);
            let target = bytes[start..start + 16 * TEXELS].chunks_exact_mut(4);
            for (target, value) in target.zip(row.iter().flatten()) {
                target.copy_from_slice(&value.to_le_bytes());
            }
        }
        bytes
    }
}

/// A number of rows, or of their texels: at most 3 × 48 rows for each of 2048 models.
fn row_number(rows: usize) -> u32 {
    u32::try_from(rows).expect("2048 models have fewer than 2^32 texels")
}

/// The profiles of one model that get a row each.
struct Nodes {
    nodes: Vec<Box<dyn RadialProfile>>,
    /// Rows with something between one and the next: surface albedos, not channels.
    run: usize,
}

impl Nodes {
    fn of(material: &Material, number: usize) -> Result<Self, NoProfile> {
        let model = &material.profile.model;
        let profile = |surface_albedo: f64, channel: Channel, length: f64| {
            Medium::new(surface_albedo, length)
                .map_err(|error| error.to_string())
                .and_then(|medium| model.profile(medium, channel).map_err(|error| error.to_string()))
                .map_err(|reason| NoProfile::new(number, surface_albedo, reason))
        };
        let albedos = || (0..NODES).map(node_albedo);
        // Radii are per unit of the model's length, or in mm.
        let (nodes, run): (Result<Vec<_>, NoProfile>, u32) = match NodesOf::model(model) {
            NodesOf::SurfaceAlbedo => (albedos().map(|a| profile(a, Channel::Red, 1.0)).collect(), NODES),
            NodesOf::Channel => (Channel::ALL.into_iter().map(|c| profile(0.5, c, 1.0)).collect(), 1),
            NodesOf::Both => {
                let of = |c: Channel| albedos().map(move |a| (a, c, material.mean_free_path_mm[c.index()]));
                (Channel::ALL.into_iter().flat_map(of).map(|(a, c, l)| profile(a, c, l)).collect(), NODES)
            }
        };
        Ok(Self { nodes: nodes?, run: run as usize })
    }

    /// The rows of `knots`, one per node.
    fn rows<'k>(&self, knots: &'k [Knots]) -> impl Iterator<Item = Row> + use<'k> {
        let run = self.run;
        let next = move |node: usize| if (node + 1).is_multiple_of(run) { node } else { node + 1 };
        (0..knots.len()).map(move |node| row(&knots[node], &knots[next(node)]))
    }
}

/// The edge-spread function F(x): the share of the light of a line source at 0 that leaves before x; 1/2 at x = 0.
fn edge(profile: &dyn RadialProfile, reach: f64) -> Knots {
    let spread = EdgeSpread::new(profile);
    let mut last = 0.5;
    std::array::from_fn(|index| {
        let t = fraction(index);
        // The integral is good to 1e-10, which may turn a plateau into a step down.
        last = spread.at(reach * t.powi(EDGE_POWER)).clamp(last, 1.0);
        last
    })
}

fn row(own: &Knots, next: &Knots) -> Row {
    std::array::from_fn(|index| {
        let [own, next] =
            [own, next].map(|knots| [knots[index], knots[index + 1] - knots[index]].map(single));
        [own[0], own[1], next[0], next[1]]
    })
}

#[cfg(test)]
mod tests;
