//! The default scene: a bust with thin ears, as a signed distance field and polygonised.
//!
//! Lengths in these modules are millimetres; the mesh comes out in metres. The origin lies in the head between the
//! ears, +y is up and the bust looks to +z. Each part hands out its distance; the field is their smooth union.

mod body;
mod distance;
mod ear;
mod face;
mod hair;
mod polygonise;

use super::{Object, Scene, Surface};
use glam::Vec3;

/// The grid's cell for a scene (mm): well below the thickness of an ear, about 290,000 triangles.
pub const CELL_MM: f32 = 1.45;

/// The bust as a scene of one object, polygonised on a grid of `cell_mm` ([`CELL_MM`] is made for pictures).
pub fn scene(cell_mm: f32) -> Scene {
    let mesh = polygonise::polygonise(cell_mm);
    Scene::new(vec![Object { name: "bust".into(), mesh, surface: Surface::default() }])
}

/// How far the head is turned over the shoulders, to the bust's left (radians).
const TURN: f32 = 0.16;

/// Signed distance to the bust (mm): negative inside.
///
/// An estimate away from the surface: at most twice the true distance.
pub fn distance(p: Vec3) -> f32 {
    let q = fold(turn(p));
    let mut d = distance::union(face::head(q), body::body(q), 16.0);
    d = hair::hair(q, d);
    let to_ear = (q - ear::CENTRE).length() - ear::REACH;
    // The ear's joint is 5 mm wide: farther out it cannot change the union.
    if to_ear < d + 5.0 {
        d = distance::union(d, ear::ear(q), 5.0);
    }
    d
}

/// How many times the true distance [`distance`] may be; the ear's relief and the locks of hair come near it.
const STEEPEST: f32 = 2.0;

/// Undoes the turn of the head: none below the collar bones, all of it above the chin.
fn turn(p: Vec3) -> Vec3 {
    const AXIS_Z: f32 = -30.0;
    let angle = TURN * distance::step(-190.0, -95.0, p.y);
    let (sine, cosine) = angle.sin_cos();
    let z = p.z - AXIS_Z;
    Vec3::new(p.x * cosine - z * sine, p.y, p.x * sine + z * cosine + AXIS_Z)
}

/// Folds the left half onto the right, with a fillet of 1 mm instead of a crease.
fn fold(p: Vec3) -> Vec3 {
    Vec3::new((p.x * p.x + 1.0).sqrt(), p.y, p.z)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use std::collections::HashMap;

    /// Coarse, to be quick without optimisation, and still finer than the head's features.
    const TEST_CELL_MM: f32 = 4.0;

    #[test]
    fn the_surface_is_closed() {
        let scene = scene(TEST_CELL_MM);
        let mut edges = HashMap::<(u32, u32), usize>::new();
        for triangle in scene.objects[0].mesh.indices.chunks_exact(3) {
            for k in 0..3 {
                *edges.entry((triangle[k], triangle[(k + 1) % 3])).or_default() += 1;
            }
        }
        let reverse = |a: u32, b: u32| edges.get(&(b, a)).copied().unwrap_or(0);
        assert!(edges.iter().all(|((a, b), count)| reverse(*a, *b) == *count));
        // Surface nets let two sheets that pass through one cell touch in an edge of four triangles.
        let touching = edges.values().filter(|count| **count > 1).count();
        assert!(touching * 200 < edges.len(), "{touching} of {}", edges.len());
    }

    #[test]
    fn size_and_normals_are_those_of_a_head() {
        let scene = scene(TEST_CELL_MM);
        let [width, height, depth] = scene.bounds.size();
        assert!(
            (0.20..0.25).contains(&width) && (0.30..0.36).contains(&height) && (0.2..0.26).contains(&depth)
        );
        let mesh = &scene.objects[0].mesh;
        assert_eq!(mesh.positions.len(), mesh.normals.len());
        assert_eq!(mesh.positions.len(), mesh.texture_coordinates.len());
        for normal in &mesh.normals {
            // One normalisation in f32.
            assert!((Vec3::from(*normal).length() - 1.0).abs() < 1e-5);
        }
        // Signed volume by the divergence theorem: positive only if the triangles face outwards.
        let volume: f32 = mesh
            .indices
            .chunks_exact(3)
            .map(|t| {
                let [a, b, c] = [0, 1, 2].map(|k| Vec3::from(mesh.positions[t[k] as usize]));
                a.dot(b.cross(c)) / 6.0
            })
            .sum();
        assert!((3e-3..8e-3).contains(&volume), "{volume} m³");
    }

    #[test]
    fn the_same_bytes_every_time() {
        assert_eq!(scene(6.0).objects[0].mesh, scene(6.0).objects[0].mesh);
    }

    #[test]
    fn an_ear_is_thin_enough_for_light_to_come_through() {
        // Through the scapha, along the sheet's normal: how much of the ray lies inside.
        let (middle, along) = ear::probe();
        let inside = (-60..=60).filter(|step| {
            let q = middle + along * (*step as f32 * 0.1);
            distance::union(1e3, ear::ear(q), 1.0) < 0.0
        });
        let thickness_mm = inside.count() as f32 * 0.1;
        assert!((1.5..4.0).contains(&thickness_mm), "{thickness_mm} mm");
    }
}
