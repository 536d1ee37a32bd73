//! Objects that say how thick they are, and how dense in which places.

use std::f64::consts::PI;

use subsurface_profile::single_scattering_albedo::Entry;
use subsurface_profile::{HalfSpace, Medium, Slab};
use subsurface_runtime::{
    Bounds, DirectionalLight, Light, Renderer, RendererDescriptor, SurfaceDescriptor, TexturePixels, wgpu,
};

use crate::gpu::Gpu;
use crate::scene::{MEAN_FREE_PATH_MM, SIZE, SURFACE_ALBEDO, Scene, block, medium, quad, tilted};

const BOUNDS: Bounds = Bounds::new([0.0; 3], 0.25);

/// A texture of one value in red and green.
fn constant(code: u8) -> [u8; 16] {
    [[code, code, 0, 255]; 4].concat().try_into().expect("four texels")
}

fn slab_law(channel: usize, thickness_mm: f64) -> f64 {
    let medium = Medium::new(SURFACE_ALBEDO[channel], MEAN_FREE_PATH_MM[channel]).expect("in the domain");
    Slab::new(medium).transmittance(thickness_mm)
}

#[test]
fn a_factor_on_the_mean_free_path_is_the_material_s_own() {
    let gpu = Gpu::open();
    let texels = constant(255);
    let map = TexturePixels::new(2, 2, &texels);
    // A light in front and one behind, all of the frame: what comes through is scaled too.
    let seen = |lengths: &str, surface: SurfaceDescriptor<'_>| {
        let text = medium("").replace("mean_free_path_mm: (1.3, 0.95, 0.67)", lengths);
        let mut scene = Scene::new(&gpu, &text, &[]);
        scene.taps = None;
        scene.objects = vec![scene.surfaced(&block([3e-3, 3e-3, 1e-3]), surface)];
        let light = |direction| -> Light { DirectionalLight { direction, ..Default::default() }.into() };
        scene.picture(&[light([0.6, 0.0, -0.8]), light([0.6, 0.0, 0.8])], 0.2, Bounds::new([0.0; 3], 0.01))
    };
    let own = "mean_free_path_mm: (1.3, 0.95, 0.67)";
    let plain = seen(own, SurfaceDescriptor::default());
    let unscaled = SurfaceDescriptor { mean_free_path_scale: Some(map), ..Default::default() };
    assert_eq!(seen(own, unscaled), plain, "a texture of ones");
    for (factor, lengths) in
        [(0.5, "mean_free_path_mm: (0.65, 0.475, 0.335)"), (4.0, "mean_free_path_mm: (5.2, 3.8, 2.68)")]
    {
        let expected = seen(lengths, SurfaceDescriptor::default());
        let by_factor = SurfaceDescriptor { mean_free_path_scale_factor: factor, ..Default::default() };
        let by_both = SurfaceDescriptor { mean_free_path_scale: Some(map), ..by_factor };
        assert_eq!(seen(lengths, by_both).len(), expected.len());
        for (surface, what) in [(by_factor, "factor"), (by_both, "texture")] {
            let found = seen(own, surface);
            let differs = plain.iter().zip(&expected).any(|(a, b)| (a[0] - b[0]).abs() > 0.02);
            assert!(differs, "{factor}: the scale changes nothing");
            for (found, expected) in found.iter().zip(&expected) {
                for channel in 0..3 {
                    let (found, expected) = (found[channel], expected[channel]);
                    // Radii in half as many bits: the taps of the kernel round the other way.
                    assert!(
                        (found - expected).abs() < 2e-3 + 2e-3 * expected,
                        "{factor} by {what}: {found}, {expected}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_sheet_takes_the_object_s_thickness_bit_for_bit() {
    let gpu = Gpu::open();
    let texels = constant(255);
    let seen = |material_mm: f64, surface: SurfaceDescriptor<'_>| {
        let mut scene = Scene::new(&gpu, &medium(&format!("thin: (thickness_mm: {material_mm:?})")), &[]);
        scene.objects = vec![scene.surfaced(&quad(), surface)];
        let back = DirectionalLight { direction: [0.3, 0.2, 0.9], ..Default::default() };
        let front = DirectionalLight { direction: [0.3, 0.2, -0.9], ..Default::default() };
        scene.lit(&[back.into(), front.into()], 0.3, BOUNDS)
    };
    let own = seen(0.25, SurfaceDescriptor::default());
    let by_object = SurfaceDescriptor { thickness_mm: 0.25, ..Default::default() };
    assert_eq!(seen(2.0, by_object), own);
    let textured = SurfaceDescriptor { thickness: Some(TexturePixels::new(2, 2, &texels)), ..by_object };
    assert_eq!(seen(2.0, textured), own);
    assert_ne!(seen(2.0, SurfaceDescriptor::default()), own);
}

#[test]
fn light_from_all_around_comes_through_a_solid_that_says_how_thick_it_is() {
    let gpu = Gpu::open();
    const THICKNESS_MM: f64 = 2.0;
    for (fields, angles) in [
        ("diffuse: Lambert, specular: (reflectance_at_normal: 0)", false),
        ("specular: (reflectance_at_normal: 0)", true),
    ] {
        let mut scene = Scene::new(&gpu, &medium(fields), &[]);
        let surface = SurfaceDescriptor { thickness_mm: THICKNESS_MM as f32, ..Default::default() };
        scene.objects = vec![scene.surfaced(&tilted(0.6), surface)];
        let [_, found, _] = scene.lit(&[], PI as f32, BOUNDS);
        for channel in 0..3 {
            let half_space = HalfSpace::of(Entry::Searchlight, SURFACE_ALBEDO[channel]);
            // 2 ∫ H(μ)/H(1) μ dμ by many steps.
            let cosines = (0..500).map(|step| (f64::from(step) + 0.5) / 500.0);
            let entered = cosines.map(|mu| 2.0 * mu * half_space.through_entry(mu)).sum::<f64>() / 500.0;
            let factor = if angles { entered * half_space.through_exit(0.6) } else { 1.0 };
            let expected = slab_law(channel, THICKNESS_MM) * factor;
            // The mean of H has an error of 1 %.
            assert!((found[channel] / expected - 1.0).abs() < 0.015, "{fields}: {found:?}, not {expected}");
        }
    }
}

#[test]
fn a_white_solid_under_a_white_sky_is_white() {
    let gpu = Gpu::open();
    let white = medium("diffuse: Lambert, specular: (reflectance_at_normal: 0, coupling: None)")
        .replace("surface_albedo: (0.83, 0.64, 0.55)", "surface_albedo: (1.0, 0.5, 0.0)");
    for thickness_mm in [0.1, 1.0, 4.0, 20.0] {
        let mut scene = Scene::new(&gpu, &white, &[]);
        let surface = SurfaceDescriptor { thickness_mm, ..Default::default() };
        scene.objects = vec![scene.surfaced(&tilted(0.7), surface)];
        let [.., found] = scene.lit(&[], PI as f32, BOUNDS);
        // What it does not send back comes through.
        assert!((found[0] - 1.0).abs() < 2e-3, "{thickness_mm} mm: {found:?}");
        assert!(found[1] < 1.0 && found[2] < 1.0, "{thickness_mm} mm: {found:?}");
    }
}

#[test]
fn a_light_without_a_map_comes_through_by_the_object_s_thickness() {
    let gpu = Gpu::open();
    let mut scene = Scene::new(&gpu, &medium("diffuse: Lambert, specular: (reflectance_at_normal: 0)"), &[]);
    let light = |z: f32, irradiance: f32| -> Light {
        DirectionalLight { direction: [0.0, 0.0, z], irradiance: [irradiance; 3], ..Default::default() }
            .into()
    };
    // Four that matter more have the maps.
    let lights = [light(-1.0, 4.0), light(-1.0, 4.0), light(-1.0, 4.0), light(-1.0, 4.0), light(1.0, 1.0)];
    let surface = SurfaceDescriptor { thickness_mm: 1.5, ..Default::default() };
    for (surface, expected) in [(surface, slab_law(1, 1.5) / PI), (SurfaceDescriptor::default(), 0.0)] {
        scene.objects = vec![scene.surfaced(&quad(), surface)];
        let [_, found, _] = scene.lit(&lights, 0.0, BOUNDS);
        assert!((found[1] - expected).abs() < 1e-3 * expected + 1e-6, "{found:?}, not {expected}");
    }
}

#[test]
fn a_renderer_without_a_target_for_it_refuses_a_scale() {
    let gpu = Gpu::open();
    let scene = Scene::new(&gpu, &medium(""), &[]);
    let descriptor = RendererDescriptor { format: wgpu::TextureFormat::Rgba32Float, ..Default::default() };
    let mut renderer = Renderer::new(&gpu.device, &scene.kernel, &descriptor).expect("it has a G-buffer");
    renderer.resize(&gpu.device, SIZE).expect("small");
    let frame = subsurface_runtime::Frame::new(Default::default(), BOUNDS, 1000.0);
    renderer.prepare(&gpu.queue, &frame).expect("resized");
    let output = renderer.diffused().expect("resized").view.clone();
    let surface = SurfaceDescriptor { mean_free_path_scale_factor: 2.0, ..Default::default() };
    let object = scene.surfaced(&quad(), surface);
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let refused = renderer.encode(&mut encoder, &[object], &output).expect_err("nowhere to write it");
    assert!(refused.to_string().contains("set `mean_free_path_scale`"), "{refused}");
}
