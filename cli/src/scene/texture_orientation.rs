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

use super::texture_seam::seams;
use super::{Mesh, Object, Scene};
use crate::failure::Explain;
use glam::Vec3;
use std::fmt;
use std::path::{Path, PathBuf};

/// Least part of the area over which v must rise with height.
///
/// Ears, nostrils and the like are unwrapped any way round, so not all of it (a photographed head: 0.87); a layout
/// without a preferred direction has half.
const RISING_AREA: f64 = 0.8;

/// Least number of seam edges: a handful may match by chance. A photographed head of 18,000 triangles has 385.
const SEAM_EDGES: usize = 50;

/// How much smaller the colour difference across the seams must be with v turned over.
///
/// Halfway between the two things that come: an image without a right way up (noise, one colour) has a ratio of 1, and a
/// photographed head, whose noise and make-up differ across seams even the right way up, one of 0.5.
const DIFFERENCE_RATIO: f64 = 0.75;

/// Part of the seams' length that must match better turned over.
///
/// The median alone may hang on a few places of the image. Chance gives a half, the photographed head 0.69: the rest of
/// its seams runs between skin and eyes or the inside of the mouth, which match no way.
const AGREEING_LENGTH: f64 = 0.6;

/// What speaks for texture coordinates that are upside down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evidence {
    /// Part of the area over which v rises with height, in [0, 1].
    pub rising_area: f64,
    /// Number of seam edges that were compared.
    pub seam_edges: usize,
    /// Colour difference between the two sides of a seam as the file has it: root mean square of the sRGB code values, in
    /// [0, 255]; the median over the seams, each by its length, since the short ones lie about eyes and in mouths.
    pub difference: f64,
    /// The same with v turned over.
    pub difference_turned: f64,
    /// Part of the seams' length that matches better turned over, in [0, 1].
    pub agreeing_length: f64,
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
            agreeing_length: 0.0,
        };
        // Most files end here, without a search for seams.
        if rising_area < RISING_AREA {
            return Some(evidence);
        }
        let seams = seams(mesh);
        let compared: Vec<[f64; 3]> = seams
            .iter()
            .map(|seam| [seam.length, seam.difference(image, false), seam.difference(image, true)])
            .collect();
        let length: f64 = compared.iter().map(|[length, ..]| length).sum();
        let agreeing: f64 =
            compared.iter().filter(|[_, kept, turned]| turned < kept).map(|[length, ..]| length).sum();
        evidence.seam_edges = seams.len();
        evidence.agreeing_length = if length > 0.0 { agreeing / length } else { 0.0 };
        evidence.difference = median(compared.iter().map(|[length, kept, _]| (*kept, *length)).collect());
        evidence.difference_turned =
            median(compared.iter().map(|[length, _, turned]| (*turned, *length)).collect());
        Some(evidence)
    }

    /// Whether both cues say so.
    pub fn is_upside_down(&self) -> bool {
        self.rising_area >= RISING_AREA
            && self.seam_edges >= SEAM_EDGES
            && self.agreeing_length >= AGREEING_LENGTH
            && self.difference_turned < DIFFERENCE_RATIO * self.difference
    }
}

/// A warning: an object's texture coordinates were turned over.
#[derive(Clone, Debug, PartialEq)]
pub struct TurnedOver {
    /// The file.
    pub file: PathBuf,
    /// Name of the object.
    pub object: String,
    /// Why.
    pub evidence: Evidence,
}

impl fmt::Display for TurnedOver {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Evidence { rising_area, seam_edges, difference, difference_turned, .. } = self.evidence;
        write!(
            f,
            "{}: mesh `{}`: the texture seems to be upside down, so v is turned over: v rises with height over {:.0} % of \
             the surface, and the colours on the two sides of {seam_edges} seam edges differ by {difference:.1} of 255 as \
             the file has them, by {difference_turned:.1} turned over",
            self.file.display(),
            self.object,
            100.0 * rising_area,
        )
    }
}

impl Explain for TurnedOver {
    fn help(&self) -> Option<String> {
        let help = "`--flip-v=never` draws it as the file has it, `--flip-v=always` without this warning; in glTF (0, 0) \
                    is the image's upper left, so correct the converter to be rid of it";
        Some(help.to_owned())
    }
}

/// Turns over the texture coordinates of every object where both cues speak for it; `file` is where they came from.
pub fn turn_over(scene: &mut Scene, file: &Path) -> Vec<TurnedOver> {
    let mut turned = Vec::new();
    for object in &mut scene.objects {
        if let Some(evidence) = Evidence::of(object).filter(Evidence::is_upside_down) {
            object.mesh.flip_texture_v();
            turned.push(TurnedOver { file: file.to_owned(), object: object.name.clone(), evidence });
        }
    }
    turned
}

/// Part of the area over which v rises with world height; `None` where v is the same everywhere.
fn rising_area(mesh: &Mesh) -> Option<f64> {
    let (mut rising, mut falling) = (0.0, 0.0);
    for triangle in mesh.indices.chunks_exact(3) {
        let [a, b, c] = [0, 1, 2].map(|k| Vec3::from(mesh.positions[triangle[k] as usize]).as_dvec3());
        let [v_a, v_b, v_c] = [0, 1, 2].map(|k| f64::from(mesh.texture_coordinates[triangle[k] as usize][1]));
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

/// The value that half of the weight lies below; 0 of none. Takes (value, weight).
fn median(mut values: Vec<(f64, f64)>) -> f64 {
    values.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    let half = 0.5 * values.iter().map(|(_, weight)| weight).sum::<f64>();
    let mut below = 0.0;
    let middle = values.iter().find(|(_, weight)| {
        below += weight;
        below >= half
    });
    middle.map_or(0.0, |(value, _)| *value)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::super::{Image, Surface};
    use super::*;

    const COLUMNS: usize = 64;
    const ROWS: usize = 40;

    /// Where the foot of each half of [`tube`] lies in the image: not beside each other, or the seams would match both ways.
    const FOOT_V: [f32; 2] = [0.95, 0.65];

    /// A tube about y, unwrapped as two halves: two seams of [`ROWS`] edges. The image is that of a solid texture
    /// without symmetry, so that it matches across the seams, and upright by the standard.
    fn tube() -> Object {
        let mut mesh = Mesh::default();
        for (half, foot_v) in FOOT_V.into_iter().enumerate() {
            let first = mesh.positions.len() as u32;
            for row in 0..=ROWS {
                for column in 0..=COLUMNS / 2 {
                    let (across, up) = (column as f32 / (COLUMNS / 2) as f32, row as f32 / ROWS as f32);
                    // Both halves reach the seams with the same bits.
                    let step = (column + half * COLUMNS / 2) % COLUMNS;
                    let (sine, cosine) = (step as f32 / COLUMNS as f32 * std::f32::consts::TAU).sin_cos();
                    mesh.positions.push([0.1 * sine, 0.6 * up, 0.1 * cosine]);
                    mesh.normals.push([sine, 0.0, cosine]);
                    mesh.texture_coordinates
                        .push([0.05 + 0.5 * half as f32 + 0.4 * across, foot_v - 0.6 * up]);
                }
            }
            let width = COLUMNS as u32 / 2 + 1;
            for (row, column) in
                (0..ROWS as u32).flat_map(|row| (0..width - 1).map(move |column| (row, column)))
            {
                let corner = first + row * width + column;
                mesh.indices.extend([corner, corner + 1, corner + width]);
                mesh.indices.extend([corner + 1, corner + width + 1, corner + width]);
            }
        }
        let surface = Surface { base_colour: Some(painted(256)), ..Surface::default() };
        Object { name: "tube".into(), mesh, surface }
    }

    /// The image of [`tube`].
    fn painted(edge: u32) -> Image {
        let mut rgba = Vec::new();
        for (y, x) in (0..edge).flat_map(|y| (0..edge).map(move |x| (y, x))) {
            let (u, v) = ((x as f32 + 0.5) / edge as f32, (y as f32 + 0.5) / edge as f32);
            let half = usize::from(u >= 0.5);
            let up = (FOOT_V[half] - v) / 0.6;
            let turn = (0.5 * half as f32 + (u - 0.05 - 0.5 * half as f32) / 0.8) * std::f32::consts::TAU;
            let wave =
                |phase: f32| 128.0 + 100.0 * (turn + phase + 7.0 * up).sin() * (5.0 * up + phase).cos();
            rgba.extend([wave(0.0) as u8, wave(1.0) as u8, wave(2.5) as u8, 255]);
        }
        Image { width: edge, height: edge, rgba }
    }

    fn turned_over(mut object: Object) -> Object {
        object.mesh.flip_texture_v();
        object
    }

    #[test]
    fn an_upright_tube_is_left_alone() {
        let evidence = Evidence::of(&tube()).unwrap();
        assert!(evidence.rising_area < 1e-6 && !evidence.is_upside_down(), "{evidence:?}");
    }

    #[test]
    fn a_turned_tube_is_turned_back() {
        let mut scene = Scene::new(vec![turned_over(tube())]);
        let [ref warning] = turn_over(&mut scene, Path::new("a.glb"))[..] else { panic!("not turned") };
        let evidence = warning.evidence;
        assert_eq!((evidence.seam_edges, warning.object.as_str()), (2 * ROWS, "tube"));
        // The right way up only the texel's step inwards and the 8-bit codes remain; upside down nothing matches.
        assert!(evidence.difference_turned < 6.0 && evidence.difference > 20.0, "{evidence:?}");
        for (found, expected) in
            scene.objects[0].mesh.texture_coordinates.iter().zip(tube().mesh.texture_coordinates)
        {
            // Two roundings of f32.
            assert!((found[1] - expected[1]).abs() < 1e-6);
        }
        assert!(turn_over(&mut scene, Path::new("a.glb")).is_empty());
    }

    #[test]
    fn seams_that_match_overrule_the_height() {
        // A legal atlas may hold a part upside down: turn the tube itself over, not its image.
        let mut object = tube();
        object.mesh.positions.iter_mut().for_each(|[x, y, _]| (*x, *y) = (-*x, 0.6 - *y));
        let evidence = Evidence::of(&object).unwrap();
        assert!(evidence.rising_area > 0.99 && evidence.seam_edges == 2 * ROWS, "{evidence:?}");
        assert!(
            evidence.difference < evidence.difference_turned && !evidence.is_upside_down(),
            "{evidence:?}"
        );
    }

    #[test]
    fn height_overrules_seams_that_do_not_match() {
        let mut object = turned_over(tube());
        object.mesh.positions.iter_mut().for_each(|[x, y, _]| (*x, *y) = (-*x, 0.6 - *y));
        assert!(!Evidence::of(&object).unwrap().is_upside_down());
    }

    #[test]
    fn an_image_without_a_right_way_up_proves_nothing() {
        let mut grey = turned_over(tube());
        grey.surface.base_colour = Some(Image { width: 1, height: 1, rgba: vec![128; 4] });
        assert!(!Evidence::of(&grey).unwrap().is_upside_down());
        let mut state = 1u32;
        for edge in [2u32, 16, 64, 256] {
            let noise = (0..4 * edge * edge).map(|_| {
                // Knuth's linear congruential generator; its high bits are noise enough.
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                (state >> 24) as u8
            });
            let image = Image { width: edge, height: edge, rgba: noise.collect() };
            let mut noisy = turned_over(tube());
            noisy.surface.base_colour = Some(image);
            let evidence = Evidence::of(&noisy).unwrap();
            assert!(!evidence.is_upside_down(), "{edge}: {evidence:?}");
        }
    }

    #[test]
    fn without_seams_nothing_is_turned() {
        let mesh = Mesh {
            positions: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
            normals: vec![[0.0, 0.0, 1.0]; 4],
            texture_coordinates: vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
            indices: vec![0, 1, 2, 0, 2, 3],
        };
        let surface = Surface { base_colour: Some(painted(16)), ..Surface::default() };
        let quad = Object { name: "quad".into(), mesh, surface };
        let evidence = Evidence::of(&quad).unwrap();
        assert_eq!((evidence.rising_area, evidence.seam_edges), (1.0, 0));
        assert_eq!(turn_over(&mut Scene::new(vec![quad.clone()]), Path::new("a.glb")), []);
        let plain = Object { surface: Surface::default(), ..quad };
        assert_eq!(Evidence::of(&plain), None);
    }
}
