//! Light from everywhere on convex bodies.

use std::f64::consts::PI;

use subsurface_profile::HalfSpace;
use subsurface_profile::single_scattering_albedo::Entry;
use subsurface_runtime::{Bounds, SurfaceDescriptor};

use crate::gpu::Gpu;
use crate::scene::{MEAN_FREE_PATH_MM, SURFACE_ALBEDO, Scene, block, medium, sphere};

const BOUNDS: Bounds = Bounds::new([0.0; 3], 0.1);

#[test]
fn a_ball_returns_more_than_what_is_flat() {
    let gpu = Gpu::open();
    for (fields, index) in [
        ("specular: (reflectance_at_normal: 0, coupling: None)", 1.0),
        ("specular: (coupling: None, reflectance_at_normal: 0.027777778)", 1.4),
    ] {
        // A block of the same material: its edges are few of its pixels, and its normals bend nowhere.
        let mut flat = Scene::new(&gpu, &medium(fields), &[block([0.05, 0.05, 0.01])]);
        let [flat, ..] = flat.lit(&[], PI as f32, BOUNDS);
        for (radius_mm, scale) in [(40.0, 1.0), (10.0, 1.0), (10.0, 4.0)] {
            let mut scene = Scene::new(&gpu, &medium(fields), &[]);
            let mut world_from_object = [[0.0; 4]; 4];
            for (axis, column) in world_from_object.iter_mut().enumerate() {
                column[axis] = if axis < 3 { scale } else { 1.0 };
            }
            let surface = SurfaceDescriptor { world_from_object, ..Default::default() };
            scene.objects = vec![scene.surfaced(&sphere(1e-3 * radius_mm as f32), surface)];
            let [found, ..] = scene.lit(&[], PI as f32, BOUNDS);
            for channel in 0..3 {
                let curvature = MEAN_FREE_PATH_MM[channel] / (radius_mm * f64::from(scale));
                let half_space = HalfSpace::below(Entry::Searchlight, index, SURFACE_ALBEDO[channel]);
                let expected = half_space.convex_gain(index, curvature);
                let gain = found[channel] / flat[channel];
                // Half floats.
                assert!((gain / expected - 1.0).abs() < 2e-3, "{index}, {radius_mm}: {gain}, not {expected}");
            }
        }
    }
}

#[test]
fn a_white_ball_is_as_white_as_what_is_flat() {
    let gpu = Gpu::open();
    let white = medium("specular: (reflectance_at_normal: 0)")
        .replace("surface_albedo: (0.83, 0.64, 0.55)", "surface_albedo: (1.0, 1.0, 0.0)");
    let mut scene = Scene::new(&gpu, &white, &[sphere(4e-3)]);
    let [diffuse, _] = scene.radiance(None);
    assert!((diffuse[0] - 1.0).abs() < 2e-3 && diffuse[2] == 0.0, "{diffuse:?}");
}

#[test]
fn light_leaves_a_ball_a_mean_free_path_further_on() {
    let gpu = Gpu::open();
    const RADIUS_MM: f64 = 20.0;
    for (reflectance, index) in [("0", 1.0), ("0.027777778", 1.4)] {
        let fields =
            format!("diffuse: Lambert, specular: (coupling: None, reflectance_at_normal: {reflectance})");
        let mut ball = Scene::new(&gpu, &medium(&fields), &[sphere(1e-3 * RADIUS_MM as f32)]);
        for degrees in [0.0, 30.0, 60.0, 80.0_f64] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            // Seen along the normal: nothing is shifted towards the viewer.
            let [found, _] = ball.middle([0.6 * sin, 0.8 * sin, cos], BOUNDS);
            for channel in 0..3 {
                let shift = MEAN_FREE_PATH_MM[channel] / RADIUS_MM / index * sin * sin;
                // π of the light; half floats.
                let expected = PI * (cos + shift);
                let off = (found[channel] / expected - 1.0).abs();
                assert!(off < 3e-3, "{index}, {degrees}°: {found:?}, not {expected}");
            }
        }
    }
    // What is flat has the same light everywhere.
    let mut flat = Scene::new(
        &gpu,
        &medium("diffuse: Lambert, specular: (reflectance_at_normal: 0)"),
        &[block([0.05; 3])],
    );
    let [found, _] = flat.middle([0.6, 0.0, 0.8], Bounds::new([0.0; 3], 0.1));
    assert!((found[0] / (0.8 * PI) - 1.0).abs() < 2e-3, "{found:?}");
}
