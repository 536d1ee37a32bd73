//! Textures of a surface: mips, constants, and normals whose lost length widens the lobe.

use subsurface_runtime::{Bounds, Geometry, Object, SurfaceDescriptor, TexturePixels};

use crate::gpu::Gpu;
use crate::scene::{Scene, medium, quad, tilted};

#[test]
fn a_texture_far_away_is_its_mean() {
    let gpu = Gpu::open();
    // White and black in turn, in a size that no power of two is.
    const SIDE: u32 = 255;
    let texels: Vec<u8> =
        (0..SIDE * SIDE).flat_map(|at| if at % 2 == 0 { [255; 4] } else { [0, 0, 0, 255] }).collect();
    let mut scene = Scene::new(&gpu, &medium(""), &[]);
    let (vertices, indices) = quad();
    let geometry = Geometry::new(&gpu.device, &vertices, &indices);
    let surface = SurfaceDescriptor {
        material: scene.kernel.material_number("skin"),
        surface_albedo: Some(TexturePixels::new(SIDE, SIDE, &texels)),
        ..Default::default()
    };
    scene.objects = vec![Object::new(&gpu.device, &gpu.queue, geometry, &surface).expect("four bytes each")];
    scene.middle([0.0, 0.0, 1.0], Bounds::new([0.0; 3], 0.1));
    let albedo = scene.texel(&scene.renderer.targets().expect("resized").surface);
    // Half of the light, in codes of eight bits on eight levels.
    assert!(albedo[..3].iter().all(|albedo| (albedo - 0.5).abs() < 0.02), "{albedo:?}");
}

/// What a tilted square shows under a light, with a surface of a caller's.
fn textured(gpu: &Gpu, material: &str, surface: SurfaceDescriptor<'_>) -> [[f64; 3]; 2] {
    let mut scene = Scene::new(gpu, material, &[]);
    scene.objects = vec![scene.surfaced(&tilted(0.7), surface)];
    // The mirror's direction: 2 (n·v) n − v.
    let sine = (1.0 - 0.7 * 0.7_f64).sqrt();
    scene.radiance(Some([1.4 * sine, 0.0, 1.4 * 0.7 - 1.0]))
}

#[test]
fn a_texture_of_one_value_is_the_material_s_own_bit_for_bit() {
    let gpu = Gpu::open();
    // Codes that stand for numbers without rounding.
    let texel = |green: u8, alpha: u8| [7, green, 9, alpha].repeat(16);
    let map = texel(255, 255);
    let rough = TexturePixels::new(4, 4, &map);
    let own = textured(&gpu, &medium("specular: (roughness: 0.25)"), SurfaceDescriptor::default());
    let roughness =
        SurfaceDescriptor { roughness: Some(rough), roughness_factor: 0.25, ..Default::default() };
    assert_eq!(textured(&gpu, &medium("specular: (roughness: 0.9)"), roughness), own);
    let strength = SurfaceDescriptor { specular_strength: Some(rough), ..Default::default() };
    assert_eq!(textured(&gpu, &medium("specular: (roughness: 0.25)"), strength), own);
    // Half as strong, by the factor alone.
    let half = SurfaceDescriptor { specular_strength_factor: 0.5, ..Default::default() };
    let halved = textured(&gpu, &medium("specular: (roughness: 0.25, reflectance_at_normal: 0.06)"), half);
    let expected = textured(
        &gpu,
        &medium("specular: (roughness: 0.25, reflectance_at_normal: 0.03)"),
        SurfaceDescriptor::default(),
    );
    assert_eq!(halved[1], expected[1]);
}

#[test]
fn normals_that_differ_make_a_surface_rougher_from_afar() {
    let gpu = Gpu::open();
    let material = medium("specular: (roughness: 0.2)");
    let code = |value: f64| (127.5 + 127.5 * value).round() as u8;
    let map = |tilt: f64| -> Vec<u8> {
        (0..64 * 64)
            .flat_map(|at| {
                let x = if (at % 64 + at / 64) % 2 == 0 { tilt } else { -tilt };
                [code(x), 128, code((1.0 - x * x).sqrt()), 255]
            })
            .collect()
    };
    let seen = |texels: &[u8]| {
        let normals =
            SurfaceDescriptor { normals: Some(TexturePixels::new(64, 64, texels)), ..Default::default() };
        textured(&gpu, &material, normals)[1][0]
    };
    let (flat, bumpy) = (seen(&map(0.0)), seen(&map(0.4)));
    // The mean of the normals is as long as √(1 − 0.4²): α² = 0.2⁴ + 2 · (1 − 0.917 − 0.01).
    let alpha2 = 0.2_f64.powi(4) + 2.0 * (1.0 - (1.0_f64 - 0.16).sqrt() - 0.01);
    let expected = textured(
        &gpu,
        &medium(&format!("specular: (roughness: {})", alpha2.sqrt().sqrt())),
        SurfaceDescriptor::default(),
    )[1][0];
    assert!(bumpy < 0.1 * flat, "{bumpy} of {flat}");
    // Codes of eight bits.
    assert!((bumpy / expected - 1.0).abs() < 0.1, "{bumpy}, not {expected}");
    let none = textured(&gpu, &material, SurfaceDescriptor::default())[1][0];
    // The code 128 is a slope of 0.004.
    assert!((flat / none - 1.0).abs() < 0.05, "a flat map changes the roughness: {flat}, {none}");
}
