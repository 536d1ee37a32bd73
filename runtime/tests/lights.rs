//! Lights, their shadows and their order, on scenes whose light is known.

#![allow(clippy::print_stdout, reason = "measured figures, shown on request")]

mod gpu;

use std::f64::consts::PI;

use gpu::ball::ball;
use gpu::{Gpu, compile};
use subsurface_runtime::{
    Bounds, Camera, CompositeSettings, DirectionalLight, Environment, EnvironmentError, Extent, Frame,
    Geometry, Light, LoadedKernel, Object, PointLight, Renderer, RendererDescriptor, SpotLight,
    SurfaceDescriptor, Target, Vertex, wgpu,
};

const SIZE: Extent = Extent::new(96, 64);

/// Lambert's, and no boundary: what is seen is the irradiance over π.
const CHALK: &str = "Material(profile: \"two_exponential_dipole_searchlight\", mean_free_path_mm: (1.0, 1.0, 1.0), \
                     surface_albedo: (0.8, 0.5, 0.3), specular: (reflectance_at_normal: 0), diffuse: Lambert)";

/// A mesh, in metres.
type Mesh = (Vec<Vertex>, Vec<u32>);

/// A rectangle about a point: half edges along two directions, facing their cross product.
fn plate(middle: [f32; 3], u: [f32; 3], v: [f32; 3]) -> Mesh {
    let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let corner = |a: f32, b: f32| Vertex {
        position: [0, 1, 2].map(|axis: usize| middle[axis] + a * u[axis] + b * v[axis]),
        normal,
        texture_coordinate: [0.0; 2],
    };
    (vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)], vec![0, 1, 2, 0, 2, 3])
}

struct Scene<'a> {
    gpu: &'a Gpu,
    renderer: Renderer,
    objects: Vec<Object>,
}

impl<'a> Scene<'a> {
    fn new(gpu: &'a Gpu, material: &str, meshes: &[Mesh]) -> Self {
        let kernel: LoadedKernel = gpu.load(&compile(&[("chalk.ron", material)]).parts);
        let descriptor =
            RendererDescriptor { format: wgpu::TextureFormat::Rgba32Float, ..Default::default() };
        let mut renderer = Renderer::new(&gpu.device, &kernel, &descriptor).expect("it has a G-buffer");
        renderer.resize(&gpu.device, SIZE).expect("a small frame");
        let surface = SurfaceDescriptor { material: kernel.material_number("chalk"), ..Default::default() };
        let object = |(vertices, indices): &Mesh| {
            let geometry = Geometry::new(&gpu.device, vertices, indices);
            Object::new(&gpu.device, &gpu.queue, geometry, &surface).expect("no textures")
        };
        let objects = meshes.iter().map(object).collect();
        Self { gpu, renderer, objects }
    }

    /// The picture, without the subsurface pass: radiance, and 1 where an object is.
    fn picture(&mut self, frame: &Frame<'_>) -> Vec<[f32; 4]> {
        let frame = Frame {
            taps: Some(0),
            composite: CompositeSettings { tone_map: false, background: [[0.0; 3]; 2], ..Default::default() },
            ..*frame
        };
        self.renderer.prepare(&self.gpu.queue, &frame).expect("resized above");
        let output =
            Target::new(&self.gpu.device, SIZE, wgpu::TextureFormat::Rgba32Float, "picture").expect("small");
        self.gpu.submit(|encoder| self.renderer.encode(encoder, &self.objects, &output.view));
        bytemuck::pod_collect_to_vec(&self.gpu.read_texture(&output.texture))
    }
}

fn at(picture: &[[f32; 4]], x: u32, y: u32) -> [f32; 4] {
    picture[(y * SIZE.width + x) as usize]
}

/// From above on the plane y = 0, z down the picture: a pixel spans 1 mm.
fn from_above() -> Camera {
    // As good as straight down, with a horizon.
    let fov = 2.0 * (0.032_f32 / 2.0).atan();
    Camera { position: [0.0, 2.0, 1e-4], target: [0.0; 3], fov_y_radians: fov }
}

/// Share of a disc's light beyond a half-plane's edge; u = -1 to 1 across the penumbra.
fn half_plane(u: f64) -> f64 {
    let u = u.clamp(-1.0, 1.0);
    0.5 + (u.asin() + u * (1.0 - u * u).sqrt()) / PI
}

#[test]
fn the_penumbra_of_a_half_plane_is_that_of_its_formula() {
    let gpu = Gpu::open();
    let ground = plate([0.0; 3], [0.0, 0.0, 0.2], [0.2, 0.0, 0.0]);
    for (height_mm, degrees) in [(20.0, 20.0), (50.0, 10.0), (100.0, 10.0_f32)] {
        // Covers x < 0 at that height.
        let screen = plate([-0.1, 1e-3 * height_mm as f32, 0.0], [0.0, 0.0, 0.2], [0.1, 0.0, 0.0]);
        let mut scene = Scene::new(&gpu, CHALK, &[ground.clone(), screen]);
        let light = DirectionalLight { angular_diameter_radians: degrees.to_radians(), ..Default::default() };
        let frame = Frame {
            lights: &[light.into()],
            ..Frame::new(from_below(), Bounds::new([0.0, 0.0, 0.0], 0.3), 1000.0)
        };
        let picture = scene.picture(&frame);
        let width_mm = height_mm * f64::from(0.5 * degrees).to_radians().tan();
        let mut worst = 0.0_f64;
        // Looking down, +x is up in the picture.
        for y in 0..SIZE.height {
            // The mean over a row: taps are turned from pixel to pixel.
            let row = (0..SIZE.width).map(|x| f64::from(at(&picture, x, y)[0]) / 0.8);
            let mean = row.sum::<f64>() / f64::from(SIZE.width);
            let expected = half_plane(millimetres(SIZE.height - 1 - y, SIZE.height) / width_mm);
            worst = worst.max((mean - expected).abs());
        }
        println!("{height_mm} mm, {degrees}°: {worst:.4}");
        assert!(worst < 0.03, "{height_mm} mm, {degrees}°: off by {worst:.4}");
    }
}

/// Looks down on the plane from just above it, below every screen; a pixel spans 0.25 mm.
fn from_below() -> Camera {
    const HEIGHT: f32 = 0.015;
    let fov = 2.0 * (0.25e-3 * SIZE.height as f32 / 2.0 / HEIGHT).atan();
    Camera { position: [0.0, HEIGHT, 1e-6], target: [0.0; 3], fov_y_radians: fov }
}

/// Where a pixel's middle is in that picture, along a side of so many pixels.
fn millimetres(pixel: u32, pixels: u32) -> f64 {
    0.25 * (f64::from(pixel) + 0.5 - f64::from(pixels) / 2.0)
}

fn around(picture: &[[f32; 4]]) -> f64 {
    let seen: Vec<f64> =
        picture.iter().filter(|pixel| pixel[3] > 0.5).map(|pixel| f64::from(pixel[0])).collect();
    seen.iter().sum::<f64>() / seen.len() as f64
}

#[test]
fn a_lamp_s_light_falls_by_the_square_and_the_cosine() {
    let gpu = Gpu::open();
    let mut scene = Scene::new(&gpu, CHALK, &[plate([0.0; 3], [0.0, 0.0, 0.2], [0.2, 0.0, 0.0])]);
    let mut seen = |light: Light| {
        let frame =
            Frame { lights: &[light], ..Frame::new(from_above(), Bounds::new([0.0; 3], 0.3), 1000.0) };
        f64::from(at(&scene.picture(&frame), SIZE.width / 2, SIZE.height / 2)[0])
    };
    for position in [[0.0, 1.0, 0.0], [0.0, 0.1, 0.0], [0.3, 0.4, 0.0], [2.0, 1.0, -1.0_f32]] {
        let square: f64 = position.iter().map(|x| f64::from(x * x)).sum();
        let expected = 0.8 * f64::from(position[1]) / square.powf(1.5);
        let lamp = PointLight { position, ..Default::default() };
        let spot = SpotLight { position, direction: position.map(|x| -x), ..Default::default() };
        for (name, light) in [("point", lamp.into()), ("spot", Light::from(spot))] {
            let found = seen(light);
            // A pixel is not in the very middle; half floats.
            assert!((found / expected - 1.0).abs() < 0.01, "{name} at {position:?}: {found}, not {expected}");
        }
        let away = SpotLight { position, direction: position, ..Default::default() };
        assert_eq!(seen(away.into()), 0.0, "a cone that looks away");
        let shut = SpotLight { outer_angle_radians: 0.0, ..spot };
        assert_eq!(seen(shut.into()), 0.0, "a cone of 0°");
    }
}

#[test]
fn a_lamp_casts_the_shadow_of_what_is_before_it() {
    let gpu = Gpu::open();
    let ground = plate([0.0; 3], [0.0, 0.0, 0.2], [0.2, 0.0, 0.0]);
    // A screen half way to the lamp, 10 mm wide: its shadow is twice as wide.
    let screen = plate([0.0, 0.1, 0.0], [0.0, 0.0, 0.005], [0.005, 0.0, 0.0]);
    let mut scene = Scene::new(&gpu, CHALK, &[ground, screen]);
    for light in [
        Light::from(PointLight { position: [0.0, 0.2, 0.0], ..Default::default() }),
        SpotLight { position: [0.0, 0.2, 0.0], ..Default::default() }.into(),
    ] {
        let frame =
            Frame { lights: &[light], ..Frame::new(from_below(), Bounds::new([0.0; 3], 0.25), 1000.0) };
        let picture = scene.picture(&frame);
        let row: Vec<f32> = (0..SIZE.width).map(|x| at(&picture, x, SIZE.height / 2)[0]).collect();
        // Its edge is at 10 mm; texels of this map are 0.4 mm at the ground, and its filter as wide as three.
        for (x, value) in row.iter().enumerate() {
            let x_mm = millimetres(x as u32, SIZE.width).abs();
            let lit = x_mm > 11.0;
            if !(9.0..=11.0).contains(&x_mm) {
                assert_eq!(*value > 0.1, lit, "{light:?}: {value} at {x_mm} mm");
            }
        }
    }
}

/// Lights of all kinds.
fn many() -> [Light; 6] {
    let sun = |direction: [f32; 3], strength: f32| {
        Light::from(DirectionalLight {
            direction,
            irradiance: [strength, 0.8 * strength, 0.7 * strength],
            ..Default::default()
        })
    };
    [
        sun([0.3, -1.0, 0.2], 1.0),
        sun([-0.5, -0.4, -0.6], 0.7),
        PointLight { position: [0.3, 0.3, 0.1], intensity: [0.05; 3], radius_mm: 10.0 }.into(),
        sun([0.9, 0.1, -0.3], 0.2),
        SpotLight {
            position: [-0.2, 0.4, 0.3],
            direction: [0.5, -1.0, -0.8],
            intensity: [0.1; 3],
            ..Default::default()
        }
        .into(),
        sun([0.0, 0.2, 1.0], 1.3),
    ]
}

fn portrait() -> Camera {
    Camera { position: [0.1, 0.2, 0.5], target: [0.0; 3], fov_y_radians: 0.4 }
}

#[test]
fn the_order_of_lights_changes_no_pixel_and_neither_does_one_of_no_intensity() {
    let gpu = Gpu::open();
    let skin = "Material(profile: \"two_exponential_dipole_searchlight\", mean_free_path_mm: (1.3, 0.95, 0.67), \
                surface_albedo: (0.83, 0.64, 0.55))";
    let meshes = [ball([0.0; 3], 0.06, 48), ball([0.07, 0.05, 0.06], 0.012, 48)];
    let picture = |lights: &[Light]| {
        let mut scene = Scene::new(&gpu, skin, &meshes);
        scene.picture(&Frame { lights, ..Frame::new(portrait(), Bounds::new([0.0; 3], 0.12), 1000.0) })
    };
    let lights = many();
    let first = picture(&lights);
    assert!(around(&first) > 0.1, "something is lit");
    for order in [[5, 4, 3, 2, 1, 0], [2, 0, 5, 1, 4, 3], [1, 2, 3, 4, 5, 0]] {
        assert!(picture(&order.map(|index: usize| lights[index])) == first, "{order:?}");
    }
    // A fifth light of no intensity, whatever it is and wherever it stands.
    let four = picture(&lights[..4]);
    for dark in [
        Light::from(DirectionalLight { irradiance: [0.0; 3], ..Default::default() }),
        PointLight { position: [0.0, 0.1, 0.0], intensity: [0.0; 3], radius_mm: 0.0 }.into(),
        SpotLight { intensity: [0.0; 3], ..Default::default() }.into(),
    ] {
        let mut five = lights[..4].to_vec();
        for place in [0, 4] {
            five.insert(place, dark);
            assert!(picture(&five) == four, "{dark:?} at {place}");
            five.remove(place);
        }
    }
}

#[test]
fn lamps_in_odd_places_light_without_a_pixel_that_is_no_number() {
    let gpu = Gpu::open();
    let skin = "Material(profile: \"two_exponential_dipole_searchlight\", mean_free_path_mm: (1.3, 0.95, 0.67), \
                surface_albedo: (0.83, 0.64, 0.55))";
    let mut scene = Scene::new(&gpu, skin, &[ball([0.0; 3], 0.06, 48)]);
    let lamp = |position: [f32; 3]| Light::from(PointLight { position, intensity: [1.0; 3], radius_mm: 0.0 });
    let cone = |outer: f32| {
        Light::from(SpotLight { position: [0.0, 0.3, 0.0], outer_angle_radians: outer, ..Default::default() })
    };
    let odd = [
        lamp([0.0; 3]),
        lamp([0.0, 0.0, 0.06]),
        lamp([0.0, 0.03, 0.0]),
        lamp([1e4, 0.0, 0.0]),
        lamp([1e-4, 0.0, 0.0]),
        cone(0.0),
        cone(std::f32::consts::FRAC_PI_2),
        cone(std::f32::consts::PI),
        DirectionalLight { direction: [0.0; 3], angular_diameter_radians: 9.0, ..Default::default() }.into(),
    ];
    for light in odd {
        let frame = Frame { lights: &[light], ..Frame::new(portrait(), Bounds::new([0.0; 3], 0.06), 1000.0) };
        let picture = scene.picture(&frame);
        assert!(picture.iter().flatten().all(|value| value.is_finite() && *value >= 0.0), "{light:?}");
    }
}

#[test]
fn a_ground_of_a_kilometre_cuts_off_nothing_that_is_near() {
    let gpu = Gpu::open();
    let ground = plate([0.0, -0.1, 0.0], [0.0, 0.0, 1000.0], [1000.0, 0.0, 0.0]);
    let mut scene = Scene::new(&gpu, CHALK, &[ball([0.0; 3], 0.06, 48), ground]);
    let frame = |radius| Frame {
        ambient_irradiance: [PI as f32; 3],
        ..Frame::new(portrait(), Bounds::new([0.0; 3], radius), 1000.0)
    };
    let middle = at(&scene.picture(&frame(1500.0)), SIZE.width / 2, SIZE.height / 2);
    assert_eq!(middle[3], 1.0);
    let mut alone = Scene::new(&gpu, CHALK, &[ball([0.0; 3], 0.06, 48)]);
    assert_eq!(at(&alone.picture(&frame(0.06)), SIZE.width / 2, SIZE.height / 2), middle);
}

/// An environment of this radiance by direction.
fn environment(gpu: &Gpu, of: impl Fn([f32; 3]) -> [f32; 3]) -> Environment {
    let pixel = |index: u32| {
        let (x, y) = (index % 64, index / 64);
        let longitude = std::f32::consts::TAU * ((x as f32 + 0.5) / 64.0 - 0.5);
        let latitude = std::f32::consts::PI * (y as f32 + 0.5) / 32.0;
        of([latitude.sin() * longitude.sin(), latitude.cos(), -latitude.sin() * longitude.cos()])
    };
    let pixels: Vec<[f32; 3]> = (0..64 * 32).map(pixel).collect();
    Environment::new(&gpu.device, &gpu.queue, 64, 32, &pixels).expect("it is light")
}

#[test]
fn an_environment_that_is_the_same_everywhere_is_ambient_light() {
    let gpu = Gpu::open();
    for material in [
        CHALK,
        "Material(profile: \"two_exponential_dipole_searchlight\", mean_free_path_mm: (1.0, 1.0, 1.0), \
         surface_albedo: (0.8, 0.5, 0.3), specular: (roughness: 0.3))",
        "Material(profile: \"two_exponential_dipole_searchlight\", mean_free_path_mm: (1.0, 1.0, 1.0), \
         surface_albedo: (0.8, 0.5, 0.3), thin: (thickness_mm: 0.5))",
    ] {
        let mut scene = Scene::new(&gpu, material, &[ball([0.0; 3], 0.06, 48)]);
        let frame = Frame::new(portrait(), Bounds::new([0.0; 3], 0.06), 1000.0);
        let ambient = scene.picture(&Frame { ambient_irradiance: [0.5 * PI as f32; 3], ..frame });
        scene.renderer.set_environment(Some(environment(&gpu, |_| [0.25; 3]))).expect("it has a G-buffer");
        let around = scene.picture(&Frame { environment_intensity: 2.0, ..frame });
        for (ambient, around) in ambient.iter().flatten().zip(around.iter().flatten()) {
            // Half floats, twice.
            assert!((ambient - around).abs() < 2e-3 * ambient + 1e-6, "{ambient}, {around}");
        }
        scene.renderer.set_environment(None).expect("it has a G-buffer");
        assert!(scene.picture(&frame).iter().all(|pixel| pixel[..3] == [0.0; 3]), "no light is left");
    }
}

#[test]
fn an_environment_lights_what_faces_it_and_turns() {
    let gpu = Gpu::open();
    // A soft light from the right.
    let from_the_right = |[x, _, _]: [f32; 3]| [x.max(0.0).powi(2); 3];
    let mut scene = Scene::new(&gpu, CHALK, &[ball([0.0; 3], 0.06, 48)]);
    scene.renderer.set_environment(Some(environment(&gpu, from_the_right))).expect("it has a G-buffer");
    let camera = Camera { position: [0.0, 0.0, 0.5], target: [0.0; 3], fov_y_radians: 0.3 };
    let mut sides = |degrees: f32| {
        let frame = Frame {
            environment_turn_radians: degrees.to_radians(),
            ..Frame::new(camera, Bounds::new([0.0; 3], 0.06), 1000.0)
        };
        let picture = scene.picture(&frame);
        let half =
            |range: std::ops::Range<u32>| -> f32 { range.map(|x| at(&picture, x, SIZE.height / 2)[0]).sum() };
        [half(0..SIZE.width / 2), half(SIZE.width / 2..SIZE.width)]
    };
    let [left, right] = sides(0.0);
    assert!(right > 3.0 * left, "{left}, {right}");
    let [left, right] = sides(180.0);
    assert!(left > 3.0 * right, "{left}, {right}");
    // From behind the camera, or from before it: both sides alike. +x goes to +z, towards the camera, or away.
    let [towards, away] = [90.0, -90.0].map(&mut sides);
    for [left, right] in [towards, away] {
        assert!((left / right - 1.0).abs() < 0.05, "{left}, {right}");
    }
    assert!(towards[0] > 3.0 * away[0] || away[0] > 3.0 * towards[0], "{towards:?}, {away:?}");
}

#[test]
fn what_is_no_environment_is_refused() {
    let gpu = Gpu::open();
    let new = |width, height, pixels: &[[f32; 3]]| {
        Environment::new(&gpu.device, &gpu.queue, width, height, pixels).map(|_| ())
    };
    assert_eq!(new(1, 1, &[[1.0; 3]]), Err(EnvironmentError::Aspect { width: 1, height: 1 }));
    assert_eq!(new(0, 0, &[]), Err(EnvironmentError::Aspect { width: 0, height: 0 }));
    assert_eq!(new(2, 1, &[[1.0; 3]]), Err(EnvironmentError::Pixels { found: 1, width: 2, height: 1 }));
    assert_eq!(new(2, 1, &[[1.0; 3]; 2]), Ok(()), "two pixels are enough");
    for value in [f32::NAN, f32::INFINITY, -1.0] {
        let error = new(2, 1, &[[1.0; 3], [0.0, value, 0.0]]).expect_err("no light");
        assert!(error.to_string().contains("at pixel (1, 0)"), "{error}");
    }
}
