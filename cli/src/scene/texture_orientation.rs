//! Which way up texture coordinates are: glTF puts (0, 0) at the upper left, some converters leave it at the lower left.
//!
//! An object is judged by two cues, and turned over only if both speak for it:
//!
//! - *Height.* Images are painted upright, so v falls with height. A lower left origin makes it rise.
//! - *Seams.* Where the unwrapped surface was cut, one edge lies at two places of the image, and a painter gives both
//!   the same colours. Read upside down, they are colours of unrelated places.
//!
//! Neither suffices alone: an atlas may hold a legal part upside down, and an image of one colour has seams that match
//! either way. An object without an image or without seams is therefore never turned over.

use super::{Image, Mesh, Object, Scene};
use glam::{Vec2, Vec3};
use std::collections::{HashMap, HashSet};

/// Least part of the area over which v must rise with height.
///
/// Ears, nostrils and the like are unwrapped any way round, so not all of it; a layout without a preferred direction
/// has half.
const RISING_AREA: f64 = 0.8;

/// Least number of seam edges. A handful may match by chance; a seam down the back of a head has about a hundred.
const SEAM_EDGES: usize = 50;

/// How much smaller the colour difference across the seams must be with v turned over.
///
/// Without a right way up (noise, one colour) the ratio is 1, and its scatter over 50 edges is about a tenth. The right
/// way up brings it below 0.7 even in a photographed texture, where a half of the difference is noise.
const DIFFERENCE_RATIO: f64 = 0.8;

/// Part of the seam edges that must match better turned over: the median alone may hang on a few of them.
const AGREEING_EDGES: f64 = 0.6;

/// What speaks for texture coordinates that are upside down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evidence {
    /// Part of the area over which v rises with height, in [0, 1].
    pub rising_area: f64,
    /// Number of seam edges that were compared.
    pub seam_edges: usize,
    /// Median over the seam edges of the colour difference between their two sides, as the file has it: root mean square
    /// of the sRGB code values, in [0, 255].
    pub difference: f64,
    /// The same with v turned over.
    pub difference_turned: f64,
    /// Part of the seam edges that match better turned over, in [0, 1].
    pub agreeing_edges: f64,
}

impl Evidence {
    /// Compares the two ways; `None` for an object without a base colour image or without texture coordinates.
    pub fn of(object: &Object) -> Option<Self> {
        let image = object.surface.base_colour.as_ref()?;
        let mesh = &object.mesh;
        let rising_area = rising_area(mesh)?;
        let mut evidence = Self {
            rising_area,
            seam_edges: 0,
            difference: 0.0,
            difference_turned: 0.0,
            agreeing_edges: 0.0,
        };
        // Most files end here, without a search for seams.
        if rising_area < RISING_AREA {
            return Some(evidence);
        }
        let seams = seams(mesh);
        let differences = |turned| -> Vec<f64> {
            seams.iter().map(|[side, other]| difference(image, side, other, turned)).collect()
        };
        let (kept, turned) = (differences(false), differences(true));
        let agreeing = kept.iter().zip(&turned).filter(|(kept, turned)| turned < kept).count();
        evidence.seam_edges = seams.len();
        evidence.agreeing_edges = agreeing as f64 / seams.len().max(1) as f64;
        evidence.difference = median(kept);
        evidence.difference_turned = median(turned);
        Some(evidence)
    }

    /// Whether both cues say so.
    pub fn is_upside_down(&self) -> bool {
        self.rising_area >= RISING_AREA
            && self.seam_edges >= SEAM_EDGES
            && self.agreeing_edges >= AGREEING_EDGES
            && self.difference_turned < DIFFERENCE_RATIO * self.difference
    }
}

/// Turns over the texture coordinates of every object where both cues speak for it; returns which, and why.
pub fn turn_over(scene: &mut Scene) -> Vec<(usize, Evidence)> {
    let mut turned = Vec::new();
    for (index, object) in scene.objects.iter_mut().enumerate() {
        if let Some(evidence) = Evidence::of(object).filter(Evidence::is_upside_down) {
            object.mesh.flip_texture_v();
            turned.push((index, evidence));
        }
    }
    turned
}

/// Part of the area over which v rises with world height; `None` where v is the same everywhere.
fn rising_area(mesh: &Mesh) -> Option<f64> {
    let (mut rising, mut falling) = (0.0, 0.0);
    for triangle in mesh.indices.chunks_exact(3) {
        let [a, b, c] = [0, 1, 2].map(|k| Vec3::from(mesh.positions[triangle[k] as usize]).as_dvec3());
        let [v_a, v_b, v_c] =
            [0, 1, 2].map(|k| f64::from(mesh.texture_coordinates[triangle[k] as usize][1]));
        let doubled = (b - a).cross(c - a);
        // Gradient of v in the triangle's plane, times the doubled area squared; its y tells rising from falling.
        let slope = doubled.cross((c - b) * v_a + (a - c) * v_b + (b - a) * v_c).y;
        if slope > 0.0 {
            rising += doubled.length();
        } else if slope < 0.0 {
            falling += doubled.length();
        }
    }
    let all = rising + falling;
    (all > 0.0).then(|| rising / all)
}

/// One side of a seam edge: texture coordinates of its two ends, and of the triangle's third corner.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Side {
    ends: [Vec2; 2],
    third: Vec2,
}

/// Edges that two triangles share in space but not in the image, both sides with their ends in the same order.
fn seams(mesh: &Mesh) -> Vec<[Side; 2]> {
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
    let mut edges: HashMap<[u32; 2], Vec<Side>> = HashMap::new();
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
                edges.entry(places).or_default().push(side);
            }
        }
    }
    let pairs = edges.into_values().filter_map(|sides| <[Side; 2]>::try_from(sides).ok());
    pairs.filter(|[side, other]| side.ends != other.ends).collect()
}

/// Root mean square difference of the sRGB code values along both sides of a seam edge, in [0, 255].
///
/// Code values, not linear light: they are about as far apart as colours look.
fn difference(image: &Image, side: &Side, other: &Side, turned: bool) -> f64 {
    /// Points along an edge: more than one averages the image's noise, and edges are rarely longer than this in texels.
    const POINTS: usize = 8;
    let mut sum = 0.0;
    for point in 0..POINTS {
        let along = (point as f32 + 0.5) / POINTS as f32;
        let [a, b] = [side, other].map(|side| colour(image, inside(image, side, along), turned));
        sum += (0..3).map(|channel| f64::from(a[channel] - b[channel]).powi(2)).sum::<f64>() / 3.0;
    }
    (sum / POINTS as f64).sqrt()
}

/// A point on the edge, moved into the triangle by a texel: outside of it, the image may be empty.
fn inside(image: &Image, side: &Side, along: f32) -> Vec2 {
    let texels = Vec2::new(image.width as f32, image.height as f32);
    let on_edge = side.ends[0].lerp(side.ends[1], along);
    let inwards = (side.third - on_edge) * texels;
    on_edge + inwards.normalize_or_zero().min(inwards.abs()).max(-inwards.abs()) / texels
}

/// Bilinear sRGB code values, in [0, 255]; the image repeats.
fn colour(image: &Image, coordinate: Vec2, turned: bool) -> [f32; 3] {
    let v = if turned { 1.0 - coordinate.y } else { coordinate.y };
    let (width, height) = (image.width as usize, image.height as usize);
    let x = coordinate.x.rem_euclid(1.0) * width as f32 - 0.5;
    let y = v.rem_euclid(1.0) * height as f32 - 0.5;
    let texel = |column: f32, row: f32| {
        let (column, row) = (column.rem_euclid(width as f32) as usize, row.rem_euclid(height as f32) as usize);
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

/// The middle value, 0 of none.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}
