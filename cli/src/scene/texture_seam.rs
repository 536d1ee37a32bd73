//! Seams: where the unwrapped surface was cut, so that one edge lies at two places of the image.

use super::{Image, Mesh};
use glam::{Vec2, Vec3};
use std::collections::{BTreeMap, HashMap, HashSet};

/// One side of a seam edge: texture coordinates of its two ends, and of the triangle's third corner.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Side {
    ends: [Vec2; 2],
    third: Vec2,
}

/// An edge that two triangles share in space but not in the image, both sides with their ends in the same order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Seam {
    sides: [Side; 2],
    /// Length in space (m).
    pub(super) length: f64,
}

/// All seams of a mesh, in the order of its places.
pub(super) fn seams(mesh: &Mesh) -> Vec<Seam> {
    // Vertices that lie at one place count as one; adding zero makes -0 and 0 the same.
    let mut place_of_position = HashMap::new();
    let place_of_vertex: Vec<u32> = mesh
        .positions
        .iter()
        .map(|position| {
            let next = place_of_position.len() as u32;
            *place_of_position.entry(position.map(|x| (x + 0.0).to_bits())).or_insert(next)
        })
        .collect();
    let coordinate = |vertex: u32| Vec2::from(mesh.texture_coordinates[vertex as usize]);
    let mut first_of_place = vec![None; place_of_position.len()];
    let mut places_on_seams = HashSet::new();
    for (vertex, place) in (0..).zip(&place_of_vertex) {
        if *first_of_place[*place as usize].get_or_insert(coordinate(vertex)) != coordinate(vertex) {
            places_on_seams.insert(*place);
        }
    }
    // Sorted, so that sums come out the same every time.
    let mut edges: BTreeMap<[u32; 2], (f64, Vec<Side>)> = BTreeMap::new();
    for triangle in mesh.indices.chunks_exact(3) {
        for k in 0..3 {
            let [mut a, mut b, third] = [0, 1, 2].map(|n| triangle[(k + n) % 3]);
            if place_of_vertex[a as usize] > place_of_vertex[b as usize] {
                std::mem::swap(&mut a, &mut b);
            }
            let places = [a, b].map(|vertex| place_of_vertex[vertex as usize]);
            // The end of a cut has one texture coordinate, so one of the two is enough.
            if places.iter().any(|place| places_on_seams.contains(place)) {
                let side = Side { ends: [a, b].map(coordinate), third: coordinate(third) };
                let [start, end] =
                    [a, b].map(|vertex| Vec3::from(mesh.positions[vertex as usize]).as_dvec3());
                edges.entry(places).or_insert((start.distance(end), Vec::new())).1.push(side);
            }
        }
    }
    let seams = edges
        .into_values()
        .filter_map(|(length, sides)| Some(Seam { sides: sides.try_into().ok()?, length }));
    seams.filter(|Seam { sides: [side, other], .. }| side.ends != other.ends).collect()
}

impl Seam {
    /// Root mean square difference of the sRGB code values along both sides, in [0, 255]; `turned`: with v turned over.
    ///
    /// Code values, not linear light: they are about as far apart as colours look.
    pub(super) fn difference(&self, image: &Image, turned: bool) -> f64 {
        /// Points along an edge: together they average the image's noise, and edges are rarely longer in texels.
        const POINTS: usize = 8;
        let mut sum = 0.0;
        for point in 0..POINTS {
            let along = (point as f32 + 0.5) / POINTS as f32;
            let [a, b] = self.sides.map(|side| colour(image, side.point(image, along), turned));
            sum += (0..3).map(|channel| f64::from(a[channel] - b[channel]).powi(2)).sum::<f64>() / 3.0;
        }
        (sum / POINTS as f64).sqrt()
    }
}

impl Side {
    /// A point on the edge, moved into the triangle by a texel: outside of it, the image may be empty.
    fn point(&self, image: &Image, along: f32) -> Vec2 {
        let texels = Vec2::new(image.width as f32, image.height as f32);
        let on_edge = self.ends[0].lerp(self.ends[1], along);
        on_edge + ((self.third - on_edge) * texels).clamp_length_max(1.0) / texels
    }
}

/// Bilinear sRGB code values, in [0, 255]; the image repeats.
fn colour(image: &Image, coordinate: Vec2, turned: bool) -> [f32; 3] {
    let v = if turned { 1.0 - coordinate.y } else { coordinate.y };
    let (width, height) = (image.width as usize, image.height as usize);
    let x = coordinate.x.rem_euclid(1.0) * width as f32 - 0.5;
    let y = v.rem_euclid(1.0) * height as f32 - 0.5;
    let texel = |column: f32, row: f32| {
        let (column, row) =
            (column.rem_euclid(width as f32) as usize, row.rem_euclid(height as f32) as usize);
        // `rem_euclid` of a tiny negative number rounds up to the divisor itself.
        let at = 4 * (row.min(height - 1) * width + column.min(width - 1));
        [0, 1, 2].map(|channel| f32::from(image.rgba[at + channel]))
    };
    let (left, top) = (x.floor(), y.floor());
    let corners = [(left, top), (left + 1.0, top), (left, top + 1.0), (left + 1.0, top + 1.0)];
    let [a, b, c, d] = corners.map(|(column, row)| texel(column, row));
    let mix = |a: f32, b: f32, t: f32| a + (b - a) * t;
    [0, 1, 2].map(|k| mix(mix(a[k], b[k], x - left), mix(c[k], d[k], x - left), y - top))
}
