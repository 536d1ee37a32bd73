//! Surface albedo before the light diffuses, after, and split.

use std::f64::consts::PI;

use subsurface_profile::{Channel, Medium, Model};
use subsurface_runtime::{Bounds, DirectionalLight, Geometry, Object, SurfaceDescriptor, Vertex};

use crate::gpu::Gpu;
use crate::scene::{SIZE, Scene, block, medium, tilted};

const MIXES: [f64; 5] = [0.0, 0.25, 0.5, 0.9, 1.0];

/// Diffuse light alone: what leaves is E A/π.
const DIFFUSE: &str = "diffuse: Lambert, specular: (reflectance_at_normal: 0, coupling: None)";

#[test]
fn where_all_is_alike_the_mix_changes_nothing() {
    let gpu = Gpu::open();
    let seen = |mix: f64| {
        let mut scene =
            Scene::new(&gpu, &medium(&format!("{DIFFUSE}, surface_albedo_mix: {mix:?}")), &[tilted(0.8)]);
        scene.taps = None;
        scene.radiance(Some([0.0, 0.0, 1.0]))
    };
    let after = seen(0.0);
    for mix in MIXES {
        let ([found, _], [expected, _]) = (seen(mix), after);
        for (found, expected) in found.into_iter().zip(expected) {
            // Half floats on either way: the surface albedo itself is one where light leaves.
            assert!((found / expected - 1.0).abs() < 4e-3, "{mix}: {found}, not {expected}");
        }
    }
}

#[test]
fn what_comes_through_is_not_split() {
    let gpu = Gpu::open();
    for more in ["", ", transmission: (diffused: true)"] {
        let seen = |mix: f64| {
            let text = medium(&format!("{DIFFUSE}, surface_albedo_mix: {mix:?}{more}"));
            let mut scene = Scene::new(&gpu, &text, &[block([0.15, 0.15, 2e-3])]);
            let light = DirectionalLight { direction: [0.3, 0.0, 0.95], ..Default::default() };
            scene.lit(&[light.into()], 0.0, Bounds::new([0.0; 3], 0.25))[2]
        };
        let after = seen(0.0);
        for mix in MIXES {
            for (found, expected) in seen(mix).into_iter().zip(after) {
                assert!((found - expected).abs() < 3e-3 * expected, "{mix}{more}: {found}, not {expected}");
            }
        }
    }
}

/// Of the scene's camera: 2 tan(0.025) · 200 mm.
const MM_PER_PIXEL: f64 = 10.002_084 / SIZE.height as f64;

/// A half-plane of one surface albedo beside one of another, under even light: radiance along the middle row, green.
fn across_an_edge(gpu: &Gpu, mix: f64, albedos: [f64; 2]) -> Vec<f64> {
    let text = format!(
        "Material(profile: \"gaussian_skin\", mean_free_path_mm: (1, 1, 1), surface_albedo: (0.5, 0.5, 0.5), \
         {DIFFUSE}, surface_albedo_mix: {mix:?})"
    );
    let mut scene = Scene::of(gpu, &[("skin.ron", &text), ("set.ron", "MaterialSet(kernel: Dense)")], &[]);
    scene.taps = None;
    // The edge lies between two pixels.
    let edge = 0.5e-3 * MM_PER_PIXEL as f32;
    for (side, albedo) in [-0.01, 0.01].into_iter().zip(albedos) {
        let corner = |x: f32, y: f32| Vertex {
            position: [edge + x, y, 0.0],
            normal: [0.0, 0.0, 1.0],
            texture_coordinate: [0.0; 2],
        };
        let vertices = [corner(0.0, -0.01), corner(side, -0.01), corner(side, 0.01), corner(0.0, 0.01)];
        let surface = SurfaceDescriptor {
            material: scene.kernel.material_number("skin"),
            surface_albedo_factor: [albedo as f32; 3],
            ..Default::default()
        };
        let geometry = Geometry::new(&gpu.device, &vertices, &[0, 1, 2, 0, 2, 3]);
        let object = Object::new(&gpu.device, &gpu.queue, geometry, &surface);
        scene.objects.push(object.expect("no textures"));
    }
    let picture = scene.picture(&[], PI as f32, Bounds::new([0.0; 3], 0.02));
    let first = (SIZE.height / 2 * SIZE.width) as usize;
    picture[first..first + SIZE.width as usize].iter().map(|pixel| f64::from(pixel[1])).collect()
}

/// Share of the light of a half-plane at a distance (mm) from its edge, inside.
fn edge_spread(distance_mm: f64) -> f64 {
    let model = Model::published("gaussian_skin").expect("it is published");
    let profile =
        model.profile(Medium::new(0.5, 1.0).expect("in the domain"), Channel::Green).expect("it has one");
    const STEPS: u32 = 4000;
    let outside = (0..STEPS).map(|step| {
        let radius = profile.sample_radius((f64::from(step) + 0.5) / f64::from(STEPS));
        (distance_mm.abs() / radius).min(1.0).acos() / PI
    });
    let outside = outside.sum::<f64>() / f64::from(STEPS);
    if distance_mm > 0.0 { 1.0 - outside } else { outside }
}

#[test]
fn before_blurs_a_texture_as_light_and_after_keeps_it_sharp() {
    let gpu = Gpu::open();
    // Black must stay black without a number that is none.
    for albedos in [[0.0, 0.9], [0.05, 0.7]] {
        let [dark, bright] = albedos;
        let distance = |x: usize| (x as f64 - f64::from(SIZE.width / 2) - 0.5) * MM_PER_PIXEL;
        for mix in [0.0, 0.5, 1.0_f64] {
            let row = across_an_edge(&gpu, mix, albedos);
            for (x, found) in row.iter().enumerate() {
                // Pixels further out reach beyond the picture.
                if distance(x).abs() > 3.0 {
                    continue;
                }
                let inside = edge_spread(distance(x));
                let power = |albedo: f64, power: f64| if power == 0.0 { 1.0 } else { albedo.powf(power) };
                let blurred = inside * power(bright, mix) + (1.0 - inside) * power(dark, mix);
                let own = if distance(x) > 0.0 { bright } else { dark };
                let expected = power(own, 1.0 - mix) * blurred;
                // The kernel holds the light of a pixel for even, which the profile's peak is not.
                assert!(
                    (found - expected).abs() < 0.01,
                    "{mix}, {albedos:?}, pixel {x}: {found}, not {expected}"
                );
            }
        }
    }
}
