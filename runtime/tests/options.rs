//! Options of a material in pairs: each choice meets each other one in some material, and all of them draw.

mod gpu;

use gpu::ball::ball;
use gpu::{Gpu, compile};
use subsurface_runtime::{
    Bounds, Camera, CompositeSettings, DirectionalLight, Extent, Frame, Geometry, Light, Object, PointLight,
    Renderer, RendererDescriptor, SurfaceDescriptor, Target, wgpu,
};

const SIZE: Extent = Extent::new(48, 48);

/// Fields of RON, by option; the first of each is the default.
const OPTIONS: [&[&str]; 9] = [
    &[
        "profile: \"two_exponential_dipole_searchlight\"",
        "profile: \"burley_dmfp\"",
        "profile: \"gaussian_skin\"",
        "profile: \"dipole_marble\"",
        "profile: \"liang_2023\"",
    ],
    &[
        "mean_free_path_mm: (1.3, 0.95, 0.67), surface_albedo: (0.83, 0.64, 0.55)",
        "mean_free_path_mm: (0.1, 5.0, 0.67), surface_albedo: (0.0, 0.99, 0.5)",
        "medium: (reduced_scattering_per_mm: (0.74, 0.88, 1.01), absorption_per_mm: (0.032, 0.17, 0.48), \
         refractive_index: 1.3)",
        "medium: (scattering_per_mm: (0.0, 0.9, 10.0), anisotropy: 0.9, absorption_per_mm: (1.0, 0.1, 1e-3), \
         refractive_index: 1.0)",
    ],
    &["coupling: Full", "coupling: Entry", "coupling: None"],
    &["", "second: (roughness: 0.1, weight: 0.3)", "second: (roughness: 1.0, weight: 1.0)"],
    &[
        "roughness: 0.4",
        "roughness: 0.02",
        "roughness: 1.0, reflectance_at_normal: 0.2",
        "reflectance_at_normal: 0",
    ],
    &[
        "",
        "diffuse: Lambert",
        "diffuse: Chandrasekhar(entry: Searchlight)",
        "diffuse: Chandrasekhar(entry: Diffuse)",
        "diffuse: LommelSeeliger",
        "diffuse: Hapke(opposition: 1, opposition_width: 0.05, anisotropy: 0.9)",
        "diffuse: Hapke(refracted: true)",
        "diffuse: HanrahanKrueger(anisotropy: -0.9)",
        "diffuse: OrenNayar(sigma: 1)",
        "diffuse: Disney(subsurface: 0.5)",
    ],
    &["", "transmittance: Profile", "transmittance: Slab", "thin: (thickness_mm: 0.2)"],
    &["", "transmission: (diffused: true)", "transmission_strength: 0", "transmission_strength: 2"],
    &["", "surface_albedo_mix: 0.5", "surface_albedo_mix: 1"],
];

/// Materials in which each two choices of different options meet: greedily, the one with the most new pairs next.
fn materials() -> Vec<[usize; OPTIONS.len()]> {
    let mut pairs = Vec::new();
    for (first, of_first) in OPTIONS.iter().enumerate() {
        for (second, of_second) in OPTIONS.iter().enumerate().skip(first + 1) {
            for a in 0..of_first.len() {
                pairs.extend((0..of_second.len()).map(|b| [(first, a), (second, b)]));
            }
        }
    }
    let has = |row: &[usize], pair: &[(usize, usize); 2]| {
        pair.iter().all(|(option, choice)| row[*option] == *choice)
    };
    let mut rows = Vec::new();
    while let Some(seed) = pairs.first().copied() {
        let mut row = [usize::MAX; OPTIONS.len()];
        for (option, choice) in seed {
            row[option] = choice;
        }
        for option in 0..OPTIONS.len() {
            if row[option] == usize::MAX {
                let gain = |choice: usize| {
                    let mut tried = row;
                    tried[option] = choice;
                    pairs.iter().filter(|pair| has(&tried, pair)).count()
                };
                // The last of equals, which the defaults are not.
                row[option] = (0..OPTIONS[option].len()).max_by_key(|choice| gain(*choice)).unwrap_or(0);
            }
        }
        pairs.retain(|pair| !has(&row, pair));
        rows.push(row);
    }
    rows
}

fn text(row: &[usize; OPTIONS.len()]) -> String {
    let field = |option: usize| OPTIONS[option][row[option]];
    let specular: Vec<&str> = [2, 3, 4].map(field).into_iter().filter(|field| !field.is_empty()).collect();
    let others: Vec<&str> =
        [0, 1, 5, 6, 7, 8].map(field).into_iter().filter(|field| !field.is_empty()).collect();
    format!("Material({}, specular: ({}))", others.join(", "), specular.join(", "))
}

#[test]
fn every_pair_of_options_compiles_and_draws_light_that_is_a_number() {
    let gpu = Gpu::open();
    let rows = materials();
    let files: Vec<(String, String)> =
        rows.iter().enumerate().map(|(index, row)| (format!("m{index:03}.ron"), text(row))).collect();
    let given: Vec<(&str, &str)> = files.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect();
    let kernel = gpu.load(&compile(&given).parts);
    let descriptor = RendererDescriptor { format: wgpu::TextureFormat::Rgba32Float, ..Default::default() };
    let mut renderer = Renderer::new(&gpu.device, &kernel, &descriptor).expect("it has a G-buffer");
    renderer.resize(&gpu.device, SIZE).expect("small");
    let lights: [Light; 3] = [
        DirectionalLight { direction: [0.3, -0.5, -0.8], ..Default::default() }.into(),
        DirectionalLight { direction: [0.1, 0.2, 1.0], angular_diameter_radians: 0.1, ..Default::default() }
            .into(),
        PointLight { position: [0.05, 0.1, -0.1], intensity: [0.01; 3], radius_mm: 5.0 }.into(),
    ];
    let frame = Frame {
        lights: &lights,
        ambient_irradiance: [0.5; 3],
        composite: CompositeSettings { tone_map: false, ..Default::default() },
        ..Frame::new(
            Camera { position: [0.0, 0.02, 0.2], fov_y_radians: 0.3, ..Default::default() },
            Bounds::new([0.0; 3], 0.03),
            1000.0,
        )
    };
    for (index, (name, text)) in files.iter().enumerate() {
        let (vertices, indices) = ball([0.0; 3], 0.02, 12);
        let geometry = Geometry::new(&gpu.device, &vertices, &indices);
        let surface = SurfaceDescriptor { material: Some(index as u32), ..Default::default() };
        let object = Object::new(&gpu.device, &gpu.queue, geometry, &surface).expect("no textures");
        renderer.prepare(&gpu.queue, &frame).expect("resized above");
        let output =
            Target::new(&gpu.device, SIZE, wgpu::TextureFormat::Rgba32Float, "picture").expect("small");
        gpu.submit(|encoder| renderer.encode(encoder, std::slice::from_ref(&object), &output.view));
        let picture: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&gpu.read_texture(&output.texture));
        assert!(picture.iter().flatten().all(|value| value.is_finite()), "{name}: {text}");
        let lit = picture.iter().filter(|pixel| pixel[3] > 0.5 && pixel[1] > 0.0).count();
        assert!(lit > 300, "{name}: {lit} pixels are lit: {text}");
    }
}
