//! What is clear: absorption, walls, refraction.

use std::f64::consts::PI;

use glam::{Mat4, Quat, Vec3};
use subsurface_runtime::{
    Bounds, ClearMaterial, Environment, Renderer, RendererDescriptor, SurfaceDescriptor, Vertex, wgpu,
};

use crate::gpu::Gpu;
use crate::scene::{MIDDLE, Mesh, SIZE, Scene, block, medium, quad, sphere, tilted};

const BOUNDS: Bounds = Bounds::new([0.0; 3], 0.1);

/// Absorption per mm.
const ABSORPTION: [f32; 3] = [0.01, 0.1, 0.5];

/// Air that absorbs.
const SMOKE: ClearMaterial = ClearMaterial {
    absorption_per_mm: ABSORPTION,
    refractive_index: 1.0,
    roughness: 0.0,
    shell_thickness_mm: None,
};

fn scene(gpu: &Gpu) -> Scene<'_> {
    let mut scene = Scene::with(gpu, &[("skin.ron", &medium("diffuse: Lambert"))], &[], true);
    scene.background = 1.0;
    scene
}

/// What the middle of the frame shows of clear objects, before a background of 1.
fn seen(gpu: &Gpu, clear: ClearMaterial, mesh: &Mesh, world_from_object: Mat4) -> [f64; 3] {
    let mut scene = scene(gpu);
    let surface = SurfaceDescriptor {
        clear: Some(clear),
        world_from_object: world_from_object.to_cols_array_2d(),
        ..Default::default()
    };
    scene.objects = vec![scene.surfaced(mesh, surface)];
    let picture = scene.picture(&[], 0.0, BOUNDS);
    [0, 1, 2].map(|channel: usize| f64::from(picture[MIDDLE][channel]))
}

fn left(way_mm: f64) -> [f64; 3] {
    ABSORPTION.map(|absorption| (-f64::from(absorption) * way_mm).exp())
}

#[track_caller]
fn assert_near(found: [f64; 3], expected: [f64; 3], tolerance: f64) {
    let near = found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < tolerance);
    assert!(near, "{found:?}, not {expected:?}");
}

#[test]
fn what_is_filled_absorbs_along_the_ray() {
    let gpu = Gpu::open();
    for thickness_mm in [1.0, 4.0, 12.0] {
        let slab = block([0.05, 0.05, 0.5e-3 * thickness_mm as f32]);
        for degrees in [0.0, 40.0, 65.0_f32] {
            let turn = Mat4::from_rotation_y(degrees.to_radians());
            let way = thickness_mm / f64::from(degrees.to_radians().cos());
            // Half floats.
            assert_near(seen(&gpu, SMOKE, &slab, turn), left(way), 2e-3);
        }
    }
    // A ball by its diameter; facets are inside of it.
    assert_near(seen(&gpu, SMOKE, &sphere(3e-3), Mat4::IDENTITY), left(6.0), 2e-3);
    // One way after another: T(d₁ + d₂) = T(d₁) T(d₂).
    let of = |thickness: f32| seen(&gpu, SMOKE, &block([0.05, 0.05, 0.5e-3 * thickness]), Mat4::IDENTITY);
    let (two, three, five) = (of(2.0), of(3.0), of(5.0));
    assert_near([0, 1, 2].map(|c: usize| two[c] * three[c]), five, 2e-3);
}

#[test]
fn a_boundary_reflects_and_a_wall_has_two() {
    let gpu = Gpu::open();
    let fresnel = |cosine: f64| 0.04 + 0.96 * (1.0 - cosine).powi(5);
    for cosine in [1.0, 0.5, 0.3_f64] {
        let glass = ClearMaterial { shell_thickness_mm: Some(2.0), refractive_index: 1.5, ..SMOKE };
        let through = left(2.0 / cosine).map(|left| left * (1.0 - fresnel(cosine)) / (1.0 + fresnel(cosine)));
        assert_near(seen(&gpu, glass, &tilted(cosine), Mat4::IDENTITY), through, 2e-3);
    }
    let filled = ClearMaterial { refractive_index: 1.5, ..SMOKE };
    let slab = block([0.05, 0.05, 2e-3]);
    let through = left(4.0).map(|left| left * 0.96 * 0.96);
    assert_near(seen(&gpu, filled, &slab, Mat4::IDENTITY), through, 2e-3);
    // Light from everywhere is reflected; of a wall in a white room all of it arrives.
    let mut white = scene(&gpu);
    let glass = ClearMaterial { shell_thickness_mm: Some(1.0), ..Default::default() };
    let surface = SurfaceDescriptor { clear: Some(glass), ..Default::default() };
    white.objects = vec![white.surfaced(&tilted(0.4), surface)];
    let picture = white.picture(&[], PI as f32, BOUNDS);
    assert!((picture[MIDDLE][1] - 1.0).abs() < 2e-3, "{:?}", picture[MIDDLE]);
}

/// A wall that faces +z: black to the left of an edge, white to the right.
fn wall(scene: &Scene<'_>, z: f32) -> [subsurface_runtime::Object; 2] {
    [-0.1_f32, 0.1].map(|side| {
        let corner = |x: f32, y: f32| Vertex {
            position: [x, y, z],
            normal: [0.0, 0.0, 1.0],
            texture_coordinate: [0.0; 2],
        };
        let mesh = (
            vec![corner(0.0, -0.1), corner(side, -0.1), corner(side, 0.1), corner(0.0, 0.1)],
            vec![0, 1, 2, 0, 2, 3],
        );
        let albedo = if side > 0.0 { 0.9 } else { 0.0 };
        scene.surfaced(&mesh, SurfaceDescriptor { surface_albedo_factor: [albedo; 3], ..Default::default() })
    })
}

/// Column at which the middle row passes from dark to bright.
fn edge(picture: &[[f32; 4]]) -> f64 {
    let first = (SIZE.height / 2 * SIZE.width) as usize;
    let row = &picture[first..first + SIZE.width as usize];
    // What is reflected lies over both sides.
    let (darkest, brightest) =
        row.iter().fold((f32::MAX, 0.0_f32), |(low, high), pixel| (low.min(pixel[1]), high.max(pixel[1])));
    let share = |pixel: &[f32; 4]| f64::from((pixel[1] - darkest) / (brightest - darkest));
    f64::from(SIZE.width) - row.iter().map(share).sum::<f64>()
}

#[test]
fn a_slab_moves_what_is_behind_it_as_snell_says() {
    let gpu = Gpu::open();
    const THICKNESS_MM: f64 = 6.0;
    // Of the scene's camera: 200 mm to the origin, 0.05 rad, at the wall.
    let mm_per_pixel = (200.0 + 6.0) * 2.0 * 0.025_f64.tan() / f64::from(SIZE.height);
    for (degrees, index) in [(45.0_f64, 1.5), (-45.0, 1.5), (30.0, 1.33), (60.0, 1.0)] {
        let mut scene = scene(&gpu);
        let turn = Mat4::from_rotation_y(degrees.to_radians() as f32);
        let glass = ClearMaterial { refractive_index: index, absorption_per_mm: [0.0; 3], ..SMOKE };
        let surface = SurfaceDescriptor {
            clear: Some(glass),
            world_from_object: turn.to_cols_array_2d(),
            ..Default::default()
        };
        let slab = block([0.02, 0.02, 0.5e-3 * THICKNESS_MM as f32]);
        scene.objects = wall(&scene, -6e-3).into();
        let straight = edge(&scene.picture(&[], PI as f32, BOUNDS));
        let object = scene.surfaced(&slab, surface);
        scene.objects.push(object);
        let bent = edge(&scene.picture(&[], PI as f32, BOUNDS));
        let (sin, cos) = degrees.to_radians().sin_cos();
        let below = (1.0 - sin * sin / f64::from(index * index)).sqrt();
        // t sin(θ − θ′)/cos θ′.
        let shift = THICKNESS_MM * (sin - cos * sin / f64::from(index) / below);
        let found = (bent - straight) * mm_per_pixel;
        // Half a pixel.
        assert!((found - shift).abs() < 0.15, "{degrees}°, {index}: {found} mm, not {shift}");
    }
}

#[test]
fn what_stands_before_it_is_untouched_and_what_stands_in_it_ends_the_way() {
    let gpu = Gpu::open();
    let mut scene = scene(&gpu);
    let white = SurfaceDescriptor { surface_albedo_factor: [0.9; 3], ..Default::default() };
    let at = |z: f32| Mat4::from_translation(Vec3::new(0.0, 0.0, z)).to_cols_array_2d();
    let placed = |z: f32| SurfaceDescriptor { world_from_object: at(z), ..white };
    let smoke = SurfaceDescriptor { clear: Some(SMOKE), ..Default::default() };
    scene.objects = vec![scene.surfaced(&quad(), placed(0.0))];
    let alone = scene.picture(&[], PI as f32, BOUNDS)[MIDDLE];
    let slab = block([0.05, 0.05, 4e-3]);
    for (z, way_mm) in [(6e-3, 0.0), (1e-3, 3.0), (-6e-3, 8.0)] {
        scene.objects = vec![scene.surfaced(&quad(), placed(z)), scene.surfaced(&slab, smoke)];
        let picture = scene.picture(&[], PI as f32, BOUNDS)[MIDDLE];
        let found = [0, 1, 2].map(|channel: usize| f64::from(picture[channel] / alone[channel]));
        assert_near(found, left(way_mm), 3e-3);
    }
}

#[test]
fn half_covered_is_half_of_either() {
    let gpu = Gpu::open();
    let mut scene = scene(&gpu);
    let surface = SurfaceDescriptor { clear: Some(SMOKE), clear_coverage: 0.25, ..Default::default() };
    scene.objects = vec![scene.surfaced(&block([0.05, 0.05, 2e-3]), surface)];
    let picture = scene.picture(&[], 0.0, BOUNDS)[MIDDLE];
    let expected = left(4.0).map(|left| 0.75 + 0.25 * left);
    assert_near([0, 1, 2].map(|channel: usize| f64::from(picture[channel])), expected, 2e-3);
}

#[test]
fn rough_glass_blurs_and_keeps_light() {
    let gpu = Gpu::open();
    let row = |roughness: f32| {
        let mut scene = scene(&gpu);
        let glass = ClearMaterial { roughness, shell_thickness_mm: Some(1.0), ..Default::default() };
        let surface = SurfaceDescriptor { clear: Some(glass), ..Default::default() };
        scene.objects = wall(&scene, -6e-3).into();
        let object = scene.surfaced(&quad(), surface);
        scene.objects.push(object);
        let picture = scene.picture(&[], PI as f32, BOUNDS);
        let first = (SIZE.height / 2 * SIZE.width) as usize;
        picture[first..first + SIZE.width as usize]
            .iter()
            .map(|pixel| f64::from(pixel[1]))
            .collect::<Vec<_>>()
    };
    let (smooth, rough) = (row(0.0), row(0.8));
    let steepest = |row: &[f64]| row.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max);
    assert!(steepest(&rough) < 0.7 * steepest(&smooth), "{} of {}", steepest(&rough), steepest(&smooth));
    let sum = |row: &[f64]| row.iter().sum::<f64>();
    assert!((sum(&rough) / sum(&smooth) - 1.0).abs() < 0.03, "{} of {}", sum(&rough), sum(&smooth));
}

#[test]
fn a_renderer_draws_nothing_clear_unless_it_is_told_to() {
    let gpu = Gpu::open();
    let mut with = scene(&gpu);
    with.objects = vec![with.surfaced(&sphere(3e-3), SurfaceDescriptor::default())];
    let mut without = Scene::new(&gpu, &medium("diffuse: Lambert"), &[sphere(3e-3)]);
    without.background = 1.0;
    // Nothing clear: one more half float on the way.
    let pictures = [&mut with, &mut without].map(|scene| scene.picture(&[], 2.0, BOUNDS));
    for (with, without) in pictures[0].iter().flatten().zip(pictures[1].iter().flatten()) {
        assert!((with - without).abs() < 1e-3 * without.max(0.1), "{with}, {without}");
    }
    let descriptor = RendererDescriptor { format: wgpu::TextureFormat::Rgba32Float, ..Default::default() };
    let mut renderer = Renderer::new(&gpu.device, &with.kernel, &descriptor).expect("it has a G-buffer");
    renderer.resize(&gpu.device, SIZE).expect("small");
    let frame = subsurface_runtime::Frame::new(Default::default(), BOUNDS, 1000.0);
    renderer.prepare(&gpu.queue, &frame).expect("resized");
    let surface = SurfaceDescriptor { clear: Some(SMOKE), ..Default::default() };
    let object = with.surfaced(&quad(), surface);
    let output = renderer.diffused().expect("resized").view.clone();
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let refused = renderer.encode(&mut encoder, &[object], &output).expect_err("no pass for it");
    assert!(refused.to_string().contains("set `clear`"), "{refused}");
}

#[test]
fn an_object_that_moves_is_clear_where_it_went() {
    let gpu = Gpu::open();
    let mut scene = scene(&gpu);
    let surface = SurfaceDescriptor { clear: Some(SMOKE), ..Default::default() };
    let object = scene.surfaced(&block([0.05, 0.05, 2e-3]), surface);
    let turn = Mat4::from_quat(Quat::from_rotation_x(1.0));
    object.set_transform(&gpu.queue, turn.to_cols_array_2d());
    scene.objects = vec![object];
    let picture = scene.picture(&[], 0.0, BOUNDS)[MIDDLE];
    let found = [0, 1, 2].map(|channel: usize| f64::from(picture[channel]));
    assert_near(found, left(4.0 / 1.0_f64.cos()), 2e-3);
}

#[test]
fn an_environment_is_seen_through_what_is_clear() {
    let gpu = Gpu::open();
    let mut scene = scene(&gpu);
    let sky =
        Environment::new(&gpu.device, &gpu.queue, 4, 2, &[[0.25; 3]; 8]).expect("twice as wide as high");
    scene.renderer.set_environment(Some(sky)).expect("the kernel is the same");
    let wall = ClearMaterial { shell_thickness_mm: Some(2.0), ..SMOKE };
    for (clear, way_mm, mesh) in [(wall, 2.0, quad()), (SMOKE, 6.0, sphere(3e-3))] {
        let surface = SurfaceDescriptor { clear: Some(clear), ..Default::default() };
        scene.objects = vec![scene.surfaced(&mesh, surface)];
        let picture = scene.picture(&[], 0.0, BOUNDS)[MIDDLE];
        let expected = left(way_mm).map(|left| 0.25 * left);
        assert_near([0, 1, 2].map(|channel: usize| f64::from(picture[channel])), expected, 2e-3);
    }
}
