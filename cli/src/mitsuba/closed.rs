//! What a path tracer needs of a mesh that a rasteriser does not: an inside.

use crate::failure::Explain;
use crate::scene::{Mesh, Scene};
use glam::Vec3;
use std::collections::HashMap;
use std::fmt;

/// What is wrong with a mesh as the boundary of a medium.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Flaw {
    /// Edges that one triangle has alone.
    Open {
        /// The object's name.
        object: String,
        /// How many.
        edges: usize,
    },
    /// Its triangles face inwards.
    InsideOut {
        /// The object's name.
        object: String,
    },
}

impl fmt::Display for Flaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Open { object, edges } => {
                write!(f, "`{object}` is open: {edges} of its edges belong to one triangle alone")
            }
            Self::InsideOut { object } => write!(f, "`{object}` is inside out"),
        }
    }
}

impl Explain for Flaw {
    fn help(&self) -> Option<String> {
        Some(
            match self {
                Self::Open { .. } => {
                    "a path tracer takes what lies behind a hole for the medium, or loses the light there; close it, \
                     or compare with a --mask that leaves the places near it out"
                }
                Self::InsideOut { .. } => {
                    "a path tracer then fills all space but the object with the medium; turn its triangles over"
                }
            }
            .into(),
        )
    }
}

/// What is wrong with the scene's meshes; black objects need no inside.
pub fn flaws(scene: &Scene) -> Vec<Flaw> {
    let mut flaws = Vec::new();
    for object in scene.objects.iter().filter(|object| !object.surface.is_black) {
        let edges = open_edges(&object.mesh);
        if edges > 0 {
            flaws.push(Flaw::Open { object: object.name.clone(), edges });
        }
        if volume(&object.mesh) < 0.0 {
            flaws.push(Flaw::InsideOut { object: object.name.clone() });
        }
    }
    flaws
}

/// Edges without a neighbour that runs the other way; vertices at one place, up to rounding, are one.
fn open_edges(mesh: &Mesh) -> usize {
    let largest = mesh.positions.iter().flatten().fold(0.0_f32, |largest, value| largest.max(value.abs()));
    let tolerance = (1e-6 * largest).max(f32::MIN_POSITIVE);
    let mut places = HashMap::new();
    let place_of: Vec<usize> = mesh
        .positions
        .iter()
        .map(|position| {
            let next = places.len();
            let cell = position.map(|value| (value / tolerance).round() as i64);
            *places.entry(cell).or_insert(next)
        })
        .collect();
    let mut balance: HashMap<(usize, usize), i32> = HashMap::new();
    for triangle in mesh.indices.chunks_exact(3) {
        let corners = [0, 1, 2].map(|corner| place_of[triangle[corner] as usize]);
        for (from, to) in [(0, 1), (1, 2), (2, 0)].map(|(a, b)| (corners[a], corners[b])) {
            if from != to {
                *balance.entry((from.min(to), from.max(to))).or_default() += if from < to { 1 } else { -1 };
            }
        }
    }
    balance.values().filter(|sum| **sum != 0).count()
}

fn volume(mesh: &Mesh) -> f32 {
    let corner = |index: u32| Vec3::from(mesh.positions[index as usize]);
    let sixfold = mesh.indices.chunks_exact(3).map(|triangle| {
        let [a, b, c] = [0, 1, 2].map(|index| corner(triangle[index]));
        a.dot(b.cross(c))
    });
    sixfold.sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::shapes;

    #[test]
    fn procedural_solids_are_closed() {
        for scene in [shapes::sphere(), shapes::ellipsoid(), shapes::slab(), shapes::shell()] {
            assert_eq!(flaws(&scene), []);
        }
    }

    #[test]
    fn a_hole_and_a_turned_mesh_are_named() {
        let mut scene = shapes::sphere();
        let indices = &mut scene.objects[0].mesh.indices;
        indices.truncate(indices.len() - 3);
        assert_eq!(flaws(&scene), [Flaw::Open { object: "sphere".into(), edges: 3 }]);
        let mut scene = shapes::sphere();
        scene.objects[0].mesh.indices.reverse();
        assert_eq!(flaws(&scene), [Flaw::InsideOut { object: "sphere".into() }]);
    }
}
