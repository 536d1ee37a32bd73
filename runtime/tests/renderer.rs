//! The four passes together, on a sphere over a floor.

mod gpu;

use gpu::{Gpu, compile};
use subsurface_runtime::{
    Bounds, Camera, CompositeSettings, DirectionalLight, Extent, Frame, GBuffer, Geometry, KernelParts,
    Object, Path, Renderer, SubsurfaceInputs, SubsurfacePass, SubsurfaceView, SurfaceDescriptor,
    TexturePixels, Vertex, wgpu,
};

const SIZE: Extent = Extent::new(96, 64);
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;
const WAX: &str = "Material(profile: ExponentialDipole(entry: Searchlight), mean_free_path_mm: (3.0, 2.0, 1.0), \
                   surface_albedo: (0.8, 0.7, 0.5))";

/// A sphere of radius 0.05 m around the origin.
fn sphere() -> (Vec<Vertex>, Vec<u32>) {
    const RINGS: u32 = 24;
    const SECTORS: u32 = 48;
    let mut vertices = Vec::new();
    for ring in 0..=RINGS {
        for sector in 0..=SECTORS {
            let (v, u) = (ring as f32 / RINGS as f32, sector as f32 / SECTORS as f32);
            let (theta, phi) = (v * std::f32::consts::PI, u * std::f32::consts::TAU);
            let normal = [theta.sin() * phi.sin(), theta.cos(), theta.sin() * phi.cos()];
            vertices.push(Vertex { position: normal.map(|x| 0.05 * x), normal, texture_coordinate: [u, v] });
        }
    }
    let mut indices = Vec::new();
    for ring in 0..RINGS {
        for sector in 0..SECTORS {
            let a = ring * (SECTORS + 1) + sector;
            let b = a + SECTORS + 1;
            indices.extend([a, b, a + 1, a + 1, b, b + 1]);
        }
    }
    (vertices, indices)
}

/// An opaque floor below the sphere.
fn floor() -> (Vec<Vertex>, Vec<u32>) {
    let corner = |x: f32, z: f32| Vertex {
        position: [0.1 * x, -0.05, 0.1 * z],
        normal: [0.0, 1.0, 0.0],
        texture_coordinate: [x, z],
    };
    (vec![corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0)], vec![0, 1, 2, 0, 2, 3])
}

struct Scene {
    renderer: Renderer,
    objects: Vec<Object>,
    kernel: KernelParts,
}

impl Scene {
    fn new(gpu: &Gpu) -> Self {
        let kernel = compile(&[("wax.ron", WAX)]).parts;
        let mut renderer = Renderer::new(&gpu.device, &kernel, FORMAT);
        renderer.resize(&gpu.device, SIZE).expect("a small frame");
        let object = |(vertices, indices): (Vec<Vertex>, Vec<u32>), material| {
            let geometry = Geometry::new(&gpu.device, &vertices, &indices);
            let surface = SurfaceDescriptor { material, ..Default::default() };
            renderer.object(&gpu.device, &gpu.queue, geometry, &surface).expect("no textures")
        };
        let objects = vec![object(sphere(), kernel.material_number("wax")), object(floor(), None)];
        Self { renderer, objects, kernel }
    }

    fn render(&mut self, gpu: &Gpu, taps: u32) -> Vec<[f32; 4]> {
        let frame = Frame {
            camera: Camera { position: [0.1, 0.1, 0.3], target: [0.0; 3], fov_y_radians: 0.5 },
            lights: &[DirectionalLight { direction: [-1.0, -1.0, 0.2], irradiance: [3.0; 3] }],
            ambient_irradiance: [0.05; 3],
            transmission: 1.0,
            bounds: Bounds { centre: [0.0; 3], radius: 0.15 },
            millimetres_per_world_unit: 1000.0,
            taps: Some(taps),
            frame_index: 0,
            composite: CompositeSettings { tone_map: false, ..Default::default() },
        };
        let output =
            subsurface_runtime::Target::new(&gpu.device, SIZE, FORMAT, "test picture").expect("small");
        self.renderer.prepare(&gpu.queue, &frame);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.renderer.encode(&mut encoder, &self.objects, &output.view);
        gpu.queue.submit([encoder.finish()]);
        bytemuck::pod_collect_to_vec(&gpu.read_texture(&output.texture))
    }
}

/// Index of the pixel in the middle of the frame: the sphere.
const MIDDLE: usize = (SIZE.height / 2 * SIZE.width + SIZE.width / 2) as usize;

#[test]
fn four_passes_run_without_a_validation_error_and_scatter_light() {
    let gpu = Gpu::open();
    let (sharp, soft) = gpu.validated(|| {
        let mut scene = Scene::new(&gpu);
        (scene.render(&gpu, 0), scene.render(&gpu, 32))
    });
    assert!(sharp.iter().chain(&soft).flatten().all(|value| value.is_finite()));
    assert_eq!(sharp[0][3], 0.0, "the corner shows the background");
    assert_eq!(sharp[MIDDLE][3], 1.0, "the middle shows the sphere");
    let changed = sharp.iter().zip(&soft).filter(|(a, b)| (a[0] - b[0]).abs() > 1e-3).count();
    assert!(changed > 300, "scattering changed only {changed} pixels");
    // Light spreads but is not made: the mean moves by less than what renormalizing at the silhouette shifts.
    let mean =
        |picture: &[[f32; 4]]| picture.iter().map(|p| f64::from(p[1])).sum::<f64>() / picture.len() as f64;
    assert!((mean(&soft) / mean(&sharp) - 1.0).abs() < 0.05, "{} against {}", mean(&soft), mean(&sharp));
}

#[test]
fn the_same_frame_gives_the_same_bytes() {
    let gpu = Gpu::open();
    let mut scene = Scene::new(&gpu);
    let first = scene.render(&gpu, 16);
    let mut again = Scene::new(&gpu);
    assert!(first == again.render(&gpu, 16), "two renders of one frame differ");
}

#[test]
fn the_stencil_changes_what_is_shaded_and_not_the_picture() {
    let gpu = Gpu::open();
    let mut scene = Scene::new(&gpu);
    scene.render(&gpu, 16);
    let targets = scene.renderer.targets().expect("resized");
    let camera = Camera { position: [0.1, 0.1, 0.3], target: [0.0; 3], fov_y_radians: 0.5 };
    let bounds = Bounds { centre: [0.0; 3], radius: 0.15 };
    let projection = camera.projection(SIZE.width as f32 / SIZE.height as f32, &bounds);
    let view = SubsurfaceView::from_projection(projection, SIZE.height, 1000.0).with_taps(16);
    let run = |stencil: Option<wgpu::TextureFormat>| {
        gpu.validated(|| {
            let path = Path::Fragment;
            let mut pass = SubsurfacePass::with_path(&gpu.device, &scene.kernel, FORMAT, stencil, path)
                .expect("every device has fragment shaders");
            let inputs = SubsurfaceInputs {
                irradiance: &targets.irradiance.view,
                surface: &targets.surface.view,
                depth: &targets.depth,
                depth_stencil: stencil.map(|_| &targets.depth_stencil.view),
                mean_free_path_scale: None,
            };
            pass.resize(&gpu.device, SIZE, &inputs).expect("a small frame");
            pass.prepare(&gpu.queue, &view);
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            pass.encode(&mut encoder);
            gpu.queue.submit([encoder.finish()]);
            gpu.read_texture(&pass.output().expect("resized").texture)
        })
    };
    assert!(run(None) == run(Some(GBuffer::DEPTH_STENCIL_FORMAT)), "the stencil changed the picture");
}

#[test]
fn an_opaque_object_keeps_its_irradiance() {
    let gpu = Gpu::open();
    let mut scene = Scene::new(&gpu);
    let (sharp, soft) = (scene.render(&gpu, 0), scene.render(&gpu, 32));
    let surface = &scene.renderer.targets().expect("resized").surface.texture;
    // Half floats: the material number is the fourth of each pixel, −1 on the floor.
    let bytes = gpu.read_texture(surface);
    let opaque = |index: usize| bytes[index * 8 + 7] & 0x80 != 0;
    assert!(
        (0..sharp.len()).any(|index| opaque(index) && sharp[index][3] == 1.0),
        "the floor is in the picture"
    );
    for index in (0..sharp.len()).filter(|&index| opaque(index)) {
        assert_eq!(sharp[index], soft[index], "pixel {index} is opaque");
    }
}

/// Mean green radiance of a quad that faces the camera, with one normal texel, lit from `towards_light`.
fn lit_quad(gpu: &Gpu, texel: [u8; 4], towards_light: [f32; 3], material: &SubsurfaceDescription) -> f32 {
    let kernel = compile(&[("plate.ron", &material.text())]).parts;
    let mut renderer = Renderer::new(&gpu.device, &kernel, FORMAT);
    renderer.resize(&gpu.device, SIZE).expect("a small frame");
    // glTF: (0, 0) is the upper left of the image.
    let corner = |x: f32, y: f32| Vertex {
        position: [0.1 * x, 0.1 * y, 0.0],
        normal: [0.0, 0.0, 1.0],
        texture_coordinate: [0.5 + 0.5 * x, 0.5 - 0.5 * y],
    };
    let vertices = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    let geometry = Geometry::new(&gpu.device, &vertices, &[0, 1, 2, 0, 2, 3]);
    let normals = TexturePixels { width: 1, height: 1, rgba: &texel };
    let surface = SurfaceDescriptor {
        material: material.translucent.then_some(0),
        normals: Some(normals),
        opaque_roughness: 0.0,
        ..Default::default()
    };
    let object =
        renderer.object(&gpu.device, &gpu.queue, geometry, &surface).expect("four bytes for one pixel");
    let frame = Frame {
        camera: Camera { position: [0.0, 0.0, 0.5], target: [0.0; 3], fov_y_radians: 0.3 },
        lights: &[DirectionalLight { direction: towards_light.map(|x| -x), irradiance: [3.0; 3] }],
        ambient_irradiance: [0.0; 3],
        transmission: 1.0,
        bounds: Bounds { centre: [0.0; 3], radius: 0.15 },
        millimetres_per_world_unit: 1000.0,
        taps: Some(8),
        frame_index: 0,
        composite: CompositeSettings { tone_map: true, ..Default::default() },
    };
    let output = subsurface_runtime::Target::new(&gpu.device, SIZE, FORMAT, "test picture").expect("small");
    renderer.prepare(&gpu.queue, &frame);
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    renderer.encode(&mut encoder, &[object], &output.view);
    gpu.queue.submit([encoder.finish()]);
    let picture: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&gpu.read_texture(&output.texture));
    assert!(picture.iter().flatten().all(|value| value.is_finite()), "a pixel is not finite");
    picture[MIDDLE][1]
}

/// A plate's material.
struct SubsurfaceDescription {
    roughness: f32,
    translucent: bool,
}

impl SubsurfaceDescription {
    fn text(&self) -> String {
        format!(
            "Material(profile: Burley(parametrization: Searchlight), mean_free_path_mm: (1.0, 1.0, 1.0), \
             surface_albedo: (0.5, 0.5, 0.5), specular: (reflectance_at_normal: 0.028, roughness: {:?}))",
            self.roughness
        )
    }
}

#[test]
fn a_normal_map_leans_towards_growing_u_and_falling_v() {
    let gpu = Gpu::open();
    let plate = SubsurfaceDescription { roughness: 0.6, translucent: true };
    let (right, up) = ([255, 128, 180, 255], [128, 255, 180, 255]);
    let lit = |texel, towards| lit_quad(&gpu, texel, towards, &plate);
    // u grows to the right and v falls upwards, so these normals lean right and up.
    let (from_right, from_left) = (lit(right, [1.0, 0.0, 1.0]), lit(right, [-1.0, 0.0, 1.0]));
    assert!(
        from_right > 1.5 * from_left,
        "leaning right: {from_right} from the right, {from_left} from the left"
    );
    let (from_above, from_below) = (lit(up, [0.0, 1.0, 1.0]), lit(up, [0.0, -1.0, 1.0]));
    assert!(from_above > 1.5 * from_below, "leaning up: {from_above} from above, {from_below} from below");
}

#[test]
fn a_mirror_s_highlight_stays_finite() {
    let gpu = Gpu::open();
    let flat = [128, 128, 255, 255];
    for translucent in [true, false] {
        // The half vector hits the normal: the lobe's peak is far beyond what a half float holds.
        let mirror = SubsurfaceDescription { roughness: 0.0, translucent };
        let radiance = lit_quad(&gpu, flat, [0.0, 0.0, 1.0], &mirror);
        assert!(radiance > 0.9, "the highlight is white: {radiance}");
    }
}

#[test]
fn textures_whose_bytes_do_not_fit_are_refused() {
    let gpu = Gpu::open();
    let scene = Scene::new(&gpu);
    let (vertices, indices) = floor();
    let short = TexturePixels { width: 2, height: 2, rgba: &[0; 15] };
    let surface = SurfaceDescriptor { surface_albedo: Some(short), ..Default::default() };
    let geometry = Geometry::new(&gpu.device, &vertices, &indices);
    let error = scene.renderer.object(&gpu.device, &gpu.queue, geometry, &surface).expect_err("15 bytes");
    assert_eq!(error.to_string(), "a texture of 2×2 pixels of this format takes 16 bytes, not 15");
}

#[test]
fn a_stencil_is_given_if_and_only_if_the_pass_was_made_for_one() {
    let gpu = Gpu::open();
    let mut scene = Scene::new(&gpu);
    scene.render(&gpu, 1);
    let targets = scene.renderer.targets().expect("resized");
    let inputs = |stencil: bool| SubsurfaceInputs {
        irradiance: &targets.irradiance.view,
        surface: &targets.surface.view,
        depth: &targets.depth,
        depth_stencil: stencil.then_some(&targets.depth_stencil.view),
        mean_free_path_scale: None,
    };
    let made_for = |stencil| SubsurfacePass::new(&gpu.device, &scene.kernel, FORMAT, stencil);
    let error = made_for(None).resize(&gpu.device, SIZE, &inputs(true)).expect_err("unexpected stencil");
    assert!(error.to_string().contains("without a stencil"), "{error}");
    let format = Some(GBuffer::DEPTH_STENCIL_FORMAT);
    let error = made_for(format).resize(&gpu.device, SIZE, &inputs(false)).expect_err("missing stencil");
    assert!(error.to_string().contains("made for a stencil"), "{error}");
}
