//! Smooth solids whose light a path tracer can be asked for: a sphere, an ellipsoid, a slab, a shell.
//!
//! Lengths in this module are millimetres; meshes come out in metres. Each stands about the origin, thin along z.

mod cube_grid;

use super::{Mesh, Object, Scene, Surface};
use cube_grid::{cube_grid, rounded, tangents};
use glam::{Quat, Vec3};

/// Radius of the sphere (mm): about 30 mean free paths of skin.
const SPHERE_RADIUS: f32 = 40.0;

/// Half axes of the ellipsoid (mm): those of a head.
const ELLIPSOID: Vec3 = Vec3::new(60.0, 81.0, 48.0);

/// Half edges of the slab, and the radius of its rounding (mm).
const SLAB: Vec3 = Vec3::new(30.0, 30.0, 3.0);
const SLAB_ROUNDING: f32 = 2.0;

/// Half edges of the shell before it is bent about the y axis, and the radius of that (mm): as thick as an ear.
const SHELL: Vec3 = Vec3::new(18.0, 28.0, 1.5);
const SHELL_BEND: f32 = 22.0;

/// The plate that lays a shadow on the ellipsoid: half edges, the way of the light that it is made for, how far up that
/// way it stands, and how far it is moved aside so that its edge cuts the ellipsoid in two (mm).
const PLATE: Vec3 = Vec3::new(70.0, 110.0, 1.0);
const PLATE_LIGHT: Vec3 = Vec3::new(-0.8, 0.0, -0.6);
const PLATE_DISTANCE: f32 = 130.0;
const PLATE_ASIDE: f32 = 78.0;

/// Vertices along an edge of a solid's faces: facets of a millimetre.
const STEPS: usize = 96;

/// A sphere.
pub fn sphere() -> Scene {
    Scene::new(vec![object("sphere", ellipsoid_mesh(Vec3::splat(SPHERE_RADIUS)))])
}

/// An ellipsoid.
pub fn ellipsoid() -> Scene {
    Scene::new(vec![object("ellipsoid", ellipsoid_mesh(ELLIPSOID))])
}

/// The same, half in the shadow that a black plate beside it casts where light travels along (−0.8, 0, −0.6).
pub fn shadowed_ellipsoid() -> Scene {
    let aside = Vec3::Y.cross(PLATE_LIGHT);
    let turn = Quat::from_rotation_arc(Vec3::NEG_Z, PLATE_LIGHT);
    let middle = -aside * PLATE_ASIDE - PLATE_LIGHT * PLATE_DISTANCE;
    let coordinates = [rounded(PLATE.x, 0.5, 2, 2), rounded(PLATE.y, 0.5, 2, 2), rounded(PLATE.z, 0.5, 2, 2)];
    let mesh = cube_grid(&coordinates, |p| {
        let (position, normal) = rounded_box(p, PLATE, 0.5);
        (turn * position + middle, turn * normal)
    });
    let surface = Surface { is_black: true, ..Surface::default() };
    let plate = Object { name: "plate".into(), mesh, surface };
    Scene::new(vec![object("ellipsoid", ellipsoid_mesh(ELLIPSOID)), plate])
}

/// A slab with rounded edges.
pub fn slab() -> Scene {
    let mesh = cube_grid(&box_coordinates(SLAB, SLAB_ROUNDING), |p| rounded_box(p, SLAB, SLAB_ROUNDING));
    Scene::new(vec![object("slab", mesh)])
}

/// A thin shell, bent like an ear, its hollow towards −z.
pub fn shell() -> Scene {
    let mesh = cube_grid(&box_coordinates(SHELL, SHELL.z), |p| {
        let (position, normal) = rounded_box(p, SHELL, SHELL.z);
        let (sine, cosine) = (position.x / SHELL_BEND).sin_cos();
        // Lengths along x grow by (R + z)/R, so the normal's part along x shrinks by it.
        let reach = SHELL_BEND + position.z;
        let along = normal.x * SHELL_BEND / reach;
        let bent = |x: f32, y: f32, z: f32| Vec3::new(z * sine + x * cosine, y, z * cosine - x * sine);
        let middle = Vec3::Z * SHELL_BEND;
        (bent(0.0, position.y, reach) - middle, bent(along, normal.y, normal.z).normalize())
    });
    Scene::new(vec![object("shell", mesh)])
}

fn object(name: &str, mesh: Mesh) -> Object {
    Object { name: name.into(), mesh, surface: Surface::default() }
}

fn ellipsoid_mesh(half_axes: Vec3) -> Mesh {
    let edge = tangents(STEPS);
    cube_grid(&[edge.clone(), edge.clone(), edge], |p| {
        let direction = p.normalize();
        (direction * half_axes, (direction / half_axes).normalize())
    })
}

fn box_coordinates(half: Vec3, radius: f32) -> [Vec<f32>; 3] {
    half.to_array().map(|half| rounded(half, radius, STEPS / 2, 12))
}

/// Point and normal of a rounded box, from a point of the box without rounding.
fn rounded_box(p: Vec3, half: Vec3, radius: f32) -> (Vec3, Vec3) {
    let inner = p.clamp(-(half - radius), half - radius);
    let normal = (p - inner).normalize();
    (inner + radius * normal, normal)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Volume and the greatest angle between a vertex normal and that of a triangle about it.
    fn measure(mesh: &Mesh) -> (f32, f32) {
        let corner = |index: &u32| Vec3::from(mesh.positions[*index as usize]) * 1e3;
        let mut volume = 0.0;
        let mut least = 1.0_f32;
        for triangle in mesh.indices.chunks_exact(3) {
            let [a, b, c] = [0, 1, 2].map(|index| corner(&triangle[index]));
            volume += a.dot(b.cross(c)) / 6.0;
            let flat = (b - a).cross(c - a).normalize_or_zero();
            if flat != Vec3::ZERO {
                for index in triangle {
                    least = least.min(flat.dot(Vec3::from(mesh.normals[*index as usize])));
                }
            }
        }
        (volume, least.acos().to_degrees())
    }

    #[test]
    fn solids_are_closed_turned_outwards_and_as_large_as_they_should_be() {
        let ball = |half: Vec3| 4.0 / 3.0 * std::f32::consts::PI * half.element_product();
        let cases = [
            (sphere(), ball(Vec3::splat(SPHERE_RADIUS)), 2.0),
            (ellipsoid(), ball(ELLIPSOID), 3.0),
            // The rounding takes (4 - π) r² off each edge of a box, less at its corners.
            (slab(), 8.0 * SLAB.element_product() - (4.0 - std::f32::consts::PI) * 4.0 * (120.0 + 6.0), 8.0),
            (shell(), 8.0 * SHELL.element_product() - (4.0 - std::f32::consts::PI) * 2.25 * 92.0, 8.0),
        ];
        for (scene, volume, angle) in cases {
            let (name, mesh) = (&scene.objects[0].name, &scene.objects[0].mesh);
            let (found, steepest) = measure(mesh);
            // Facets lie inside of what is round: 0.1 %; the corners' rounding and the bend's: 0.5 %.
            assert!((found / volume - 1.0).abs() < 6e-3, "{name}: {found} of {volume} mm³");
            assert!(steepest < angle, "{name}: a normal is {steepest}° off its triangle's");
        }
    }

    #[test]
    fn the_plate_lies_between_the_ellipsoid_and_its_light() {
        let scene = shadowed_ellipsoid();
        let plate = &scene.objects[1];
        assert!(plate.surface.is_black);
        let aside = |p: &[f32; 3]| Vec3::from(*p).dot(Vec3::Y.cross(PLATE_LIGHT)) * 1e3;
        let nearest = plate.mesh.positions.iter().map(aside).fold(f32::NEG_INFINITY, f32::max);
        assert!((nearest + PLATE_ASIDE - PLATE.x).abs() < 0.1, "its edge is {nearest} mm off the middle");
        assert!(plate.mesh.positions.iter().all(|p| Vec3::from(*p).dot(PLATE_LIGHT) < -0.1));
    }
}
