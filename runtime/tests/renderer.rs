//! The four passes together, on a sphere over a floor.

mod gpu;

use gpu::{Gpu, compile};
use subsurface_codegen::Compiler;
use subsurface_runtime::{
    Bounds, Camera, CompositeSettings, DirectionalLight, Extent, Frame, FrameError, GBuffer, Geometry,
    LoadedKernel, NoTimestamps, Object, PassError, PassTimer, Path, Renderer, RendererDescriptor,
    SubsurfaceDescriptor, SubsurfaceInputs, SubsurfacePass, SubsurfaceView, SurfaceDescriptor, Target,
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

fn camera() -> Camera {
    Camera { position: [0.1, 0.1, 0.3], target: [0.0; 3], fov_y_radians: 0.5 }
}

fn bounds() -> Bounds {
    Bounds::new([0.0; 3], 0.15)
}

/// A renderer of frames of `SIZE`.
fn renderer(gpu: &Gpu, kernel: &LoadedKernel) -> Renderer {
    let descriptor = RendererDescriptor { format: FORMAT, ..Default::default() };
    let mut renderer = Renderer::new(&gpu.device, kernel, &descriptor).expect("the kernel has a G-buffer");
    renderer.resize(&gpu.device, SIZE).expect("a small frame");
    renderer
}

struct Scene {
    renderer: Renderer,
    objects: Vec<Object>,
    kernel: LoadedKernel,
}

impl Scene {
    fn new(gpu: &Gpu) -> Self {
        let kernel = gpu.load(&compile(&[("wax.ron", WAX)]).parts);
        Self::of(gpu, renderer(gpu, &kernel), kernel)
    }

    /// The sphere and the floor in front of `renderer`, whose kernel is `kernel`.
    fn of(gpu: &Gpu, renderer: Renderer, kernel: LoadedKernel) -> Self {
        let object = |(vertices, indices): (Vec<Vertex>, Vec<u32>), material| {
            let geometry = Geometry::new(&gpu.device, &vertices, &indices);
            let surface = SurfaceDescriptor { material, ..Default::default() };
            Object::new(&gpu.device, &gpu.queue, geometry, &surface).expect("no textures")
        };
        let objects = vec![object(sphere(), kernel.material_number("wax")), object(floor(), None)];
        Self { renderer, objects, kernel }
    }

    fn render(&mut self, gpu: &Gpu, taps: u32) -> Vec<[f32; 4]> {
        let frame = Frame {
            lights: &[DirectionalLight {
                direction: [-1.0, -1.0, 0.2],
                irradiance: [3.0; 3],
                ..Default::default()
            }
            .into()],
            ambient_irradiance: [0.05; 3],
            taps: Some(taps),
            composite: CompositeSettings { tone_map: false, ..Default::default() },
            ..Frame::new(camera(), bounds(), 1000.0)
        };
        let output = Target::new(&gpu.device, SIZE, FORMAT, "test picture").expect("small");
        self.renderer.prepare(&gpu.queue, &frame).expect("resized above");
        gpu.submit(|encoder| self.renderer.encode(encoder, &self.objects, &output.view));
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
    let projection = camera().projection(SIZE.aspect(), &bounds());
    let view = SubsurfaceView::from_projection(projection, SIZE.height, 1000.0).with_taps(16);
    let run = |stencil: Option<wgpu::TextureFormat>| {
        gpu.validated(|| {
            let path = Some(Path::Fragment);
            let descriptor = SubsurfaceDescriptor { stencil, path, ..SubsurfaceDescriptor::new(FORMAT) };
            let mut pass = SubsurfacePass::new(&gpu.device, &scene.kernel, &descriptor)
                .expect("every device has fragment shaders");
            let mut inputs = inputs(targets);
            inputs.depth_stencil = stencil.map(|_| &targets.depth_stencil.view);
            pass.bind(&gpu.device, &inputs).expect("a small frame");
            let output = pass.create_output(&gpu.device).expect("bound above");
            pass.prepare(&gpu.queue, &view).expect("bound above");
            gpu.submit(|encoder| pass.encode(encoder, &output.view));
            gpu.read_texture(&output.texture)
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
    let kernel = gpu.load(&compile(&[("plate.ron", &material.text())]).parts);
    let mut renderer = renderer(gpu, &kernel);
    // glTF: (0, 0) is the upper left of the image.
    let corner = |x: f32, y: f32| Vertex {
        position: [0.1 * x, 0.1 * y, 0.0],
        normal: [0.0, 0.0, 1.0],
        texture_coordinate: [0.5 + 0.5 * x, 0.5 - 0.5 * y],
    };
    let vertices = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    let geometry = Geometry::new(&gpu.device, &vertices, &[0, 1, 2, 0, 2, 3]);
    let normals = TexturePixels::new(1, 1, &texel);
    let surface = SurfaceDescriptor {
        material: material.translucent.then_some(0),
        normals: Some(normals),
        opaque_roughness: 0.0,
        ..Default::default()
    };
    let object = Object::new(&gpu.device, &gpu.queue, geometry, &surface).expect("four bytes for one pixel");
    let camera = Camera { position: [0.0, 0.0, 0.5], fov_y_radians: 0.3, ..Default::default() };
    let frame = Frame {
        lights: &[DirectionalLight {
            direction: towards_light.map(|x| -x),
            irradiance: [3.0; 3],
            ..Default::default()
        }
        .into()],
        taps: Some(8),
        ..Frame::new(camera, bounds(), 1000.0)
    };
    let output = Target::new(&gpu.device, SIZE, FORMAT, "test picture").expect("small");
    renderer.prepare(&gpu.queue, &frame).expect("resized above");
    gpu.submit(|encoder| renderer.encode(encoder, &[object], &output.view));
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
    let (vertices, indices) = floor();
    let short = TexturePixels::new(2, 2, &[0; 15]);
    let surface = SurfaceDescriptor { surface_albedo: Some(short), ..Default::default() };
    let geometry = Geometry::new(&gpu.device, &vertices, &indices);
    let error = Object::new(&gpu.device, &gpu.queue, geometry, &surface).expect_err("15 bytes");
    assert_eq!(error.to_string(), "a texture of 2×2 pixels of this format takes 16 bytes, not 15");
}

#[test]
fn a_stencil_is_given_if_and_only_if_the_pass_was_made_for_one() {
    let gpu = Gpu::open();
    let mut scene = Scene::new(&gpu);
    scene.render(&gpu, 1);
    let targets = scene.renderer.targets().expect("resized");
    let with_stencil = inputs(targets).with_depth_stencil(&targets.depth_stencil.view);
    let made_for = |stencil| {
        let descriptor = SubsurfaceDescriptor { stencil, ..SubsurfaceDescriptor::new(FORMAT) };
        SubsurfacePass::new(&gpu.device, &scene.kernel, &descriptor).expect("the format can be written")
    };
    let error = made_for(None).bind(&gpu.device, &with_stencil).expect_err("unexpected stencil");
    assert!(error.to_string().contains("made without a stencil"), "{error}");
    assert!(error.to_string().contains("`stencil: Some(Depth24PlusStencil8)`"), "{error}");
    let format = Some(GBuffer::DEPTH_STENCIL_FORMAT);
    let error = made_for(format).bind(&gpu.device, &inputs(targets)).expect_err("missing stencil");
    assert!(error.to_string().contains("made for a stencil"), "{error}");
    let other = Some(wgpu::TextureFormat::Depth32FloatStencil8);
    if gpu.device.features().contains(wgpu::Features::DEPTH32FLOAT_STENCIL8) {
        let error = made_for(other).bind(&gpu.device, &with_stencil).expect_err("another stencil");
        assert!(error.to_string().contains("Depth32FloatStencil8"), "{error}");
    }
}

/// What the subsurface pass reads of the targets.
fn inputs(targets: &GBuffer) -> SubsurfaceInputs<'_> {
    SubsurfaceInputs::new(&targets.irradiance.view, &targets.surface.view, &targets.depth)
}

/// Columns of a turn about y, an uneven scale (mirrored along x, if so wanted) and a step.
fn placed(mirrored: bool) -> [[f32; 4]; 4] {
    let (sin, cos) = 0.7_f32.sin_cos();
    let x = if mirrored { -0.8 } else { 0.8 };
    [[x * cos, 0.0, -x * sin, 0.0], [0.0, 1.25, 0.0, 0.0], [sin, 0.0, cos, 0.0], [0.01, 0.02, -0.01, 1.0]]
}

/// The mesh with its vertices moved by `matrix`, as a program without transforms would upload it.
fn baked((vertices, indices): (Vec<Vertex>, Vec<u32>), matrix: [[f32; 4]; 4]) -> (Vec<Vertex>, Vec<u32>) {
    let matrix = glam::Mat4::from_cols_array_2d(&matrix);
    let normals = glam::Mat3::from_mat4(matrix).inverse().transpose();
    let is_mirrored = matrix.determinant() < 0.0;
    let vertices = vertices.into_iter().map(|vertex| Vertex {
        position: matrix.transform_point3(vertex.position.into()).into(),
        normal: (normals * glam::Vec3::from(vertex.normal)).normalize().into(),
        ..vertex
    });
    let indices = indices.chunks(3).flat_map(|corners| {
        // A mirror turns triangles round; a program that bakes it turns them back.
        if is_mirrored { [corners[0], corners[2], corners[1]] } else { [corners[0], corners[1], corners[2]] }
    });
    (vertices.collect(), indices.collect())
}

#[test]
fn an_object_that_moves_looks_like_one_that_was_made_there() {
    let gpu = Gpu::open();
    let mut moved = Scene::new(&gpu);
    let mut made = Scene::new(&gpu);
    let still = moved.render(&gpu, 8);
    for mirrored in [false, true] {
        moved.objects[0].set_transform(&gpu.queue, placed(mirrored));
        let (vertices, indices) = baked(sphere(), placed(mirrored));
        let surface =
            SurfaceDescriptor { material: made.kernel.material_number("wax"), ..Default::default() };
        let geometry = Geometry::new(&gpu.device, &vertices, &indices);
        made.objects[0] = Object::new(&gpu.device, &gpu.queue, geometry, &surface).expect("no textures");
        let (moved, made) = (moved.render(&gpu, 8), made.render(&gpu, 8));
        assert!(moved != still, "the object moves");
        // The same but for rounding, which puts some pixels of silhouettes and of shadows' borders on the other side.
        let differing = moved
            .iter()
            .zip(&made)
            .filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| (a - b).abs() > 2e-3))
            .count();
        assert!(differing <= moved.len() / 200, "{differing} of {} pixels differ", moved.len());
    }
    // And back, to the bit.
    let identity = glam::Mat4::IDENTITY.to_cols_array_2d();
    moved.objects[0].set_transform(&gpu.queue, identity);
    assert!(moved.render(&gpu, 8) == still);
}

#[test]
fn an_edited_set_takes_over_while_the_program_runs() {
    let gpu = Gpu::open();
    let mut scene = Scene::new(&gpu);
    let before = scene.render(&gpu, 16);
    // A material that comes before wax by its name: numbers move.
    let marble = "Material(profile: ExponentialDipole(entry: Searchlight), mean_free_path_mm: (0.3, 0.2, 0.1), \
                  surface_albedo: (0.2, 0.4, 0.9))";
    let edited = gpu.load(&compile(&[("marble.ron", marble), ("wax.ron", WAX)]).parts);
    let (old, new) = (scene.kernel.material_number("wax"), edited.material_number("wax"));
    assert_eq!((old, new, edited.material_number("jade")), (Some(0), Some(1), None));
    let after = gpu.validated(|| {
        scene.renderer.set_kernel(&gpu.device, &edited).expect("the set has a G-buffer");
        assert_eq!(scene.renderer.subsurface.kernel().material_number("wax"), new);
        let stale = scene.render(&gpu, 16);
        assert!(stale != before, "the old number is another material now");
        scene.objects[0].set_material(&gpu.queue, new);
        assert_eq!(scene.objects[0].material(), new);
        scene.render(&gpu, 16)
    });
    // The bits of the number are taken from the packed distance, which is all that differs.
    let largest = before.iter().zip(&after).flat_map(|(a, b)| a.iter().zip(b)).map(|(a, b)| (a - b).abs());
    assert!(largest.fold(0.0, f32::max) < 2e-2, "the same material looks the same");
}

#[test]
fn passes_that_come_too_early_say_so() {
    let gpu = Gpu::open();
    let kernel = gpu.load(&compile(&[("wax.ron", WAX)]).parts);
    let descriptor = RendererDescriptor { format: FORMAT, ..Default::default() };
    let mut renderer = Renderer::new(&gpu.device, &kernel, &descriptor).expect("the kernel has a G-buffer");
    let frame = Frame::new(camera(), bounds(), 1000.0);
    let output = Target::new(&gpu.device, SIZE, FORMAT, "test picture").expect("small");
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let refused = |result: Result<(), FrameError>| result.expect_err("too early");
    assert_eq!(refused(renderer.prepare(&gpu.queue, &frame)), FrameError::NotResized);
    assert_eq!(refused(renderer.encode(&mut encoder, &[], &output.view)), FrameError::NotResized);
    let targets = GBuffer::new(&gpu.device, SIZE).expect("small");
    for (error, says) in [
        (refused(renderer.shadow.encode(&mut encoder, &[])), "ShadowPass does not know the frame"),
        (refused(renderer.gbuffer.encode(&mut encoder, &[], &targets)), "GBufferPass has nothing to read"),
        (refused(renderer.subsurface.encode(&mut encoder, &output.view)), "SubsurfacePass has nothing"),
        (refused(renderer.composite.encode(&mut encoder, &output.view)), "CompositePass has nothing"),
    ] {
        assert!(error.to_string().starts_with(says), "{error}");
    }
    renderer.resize(&gpu.device, SIZE).expect("small");
    let error = refused(renderer.encode(&mut encoder, &[], &output.view));
    assert!(error.to_string().contains("call `prepare`"), "{error}");
    // More lights than the first buffer holds are no error either.
    let lights = [DirectionalLight::default().into(); 40];
    renderer.prepare(&gpu.queue, &Frame { lights: &lights, ..frame }).expect("resized");
    renderer.encode(&mut encoder, &[], &output.view).expect("prepared");
    // An empty picture is no error: no light, and nothing to see.
    renderer.prepare(&gpu.queue, &frame).expect("resized");
    renderer.encode(&mut encoder, &[], &output.view).expect("prepared");
    let small = Target::new(&gpu.device, Extent::new(8, 8), FORMAT, "small picture").expect("small");
    let error = refused(renderer.encode(&mut encoder, &[], &small.view));
    assert_eq!(
        error.to_string(),
        "CompositePass writes to a texture of 8×8 pixels, and its inputs have 96×64: give one of that size"
    );
}

#[test]
fn a_kernel_without_the_gbuffer_is_refused() {
    let gpu = Gpu::open();
    let compiler = Compiler::from_memory([("wax.ron", WAX)]).without_gbuffer();
    let kernel = gpu.load(&compiler.compile().unwrap_or_else(|report| panic!("{report}")).parts);
    let error = Renderer::new(&gpu.device, &kernel, &RendererDescriptor::default()).expect_err("no G-buffer");
    assert_eq!(error, PassError::NoGBuffer);
}

#[test]
fn passes_are_timed_where_the_device_can() {
    let gpu = Gpu::open();
    assert_eq!(PassTimer::new(&gpu.device, &gpu.queue, &["a"]).expect_err("not asked for"), NoTimestamps);
    // Every driver that tests run on has them.
    let gpu = Gpu::with(wgpu::Limits::default(), wgpu::Features::TIMESTAMP_QUERY);
    let timer =
        PassTimer::new(&gpu.device, &gpu.queue, &Renderer::PASSES).expect("the device has timestamps");
    let kernel = gpu.load(&compile(&[("wax.ron", WAX)]).parts);
    for path in [Path::Compute, Path::Fragment] {
        let (path, timer) = (Some(path), Some(&timer));
        let descriptor = RendererDescriptor { format: FORMAT, path, timer, ..Default::default() };
        let renderer = Renderer::new(&gpu.device, &kernel, &descriptor).expect("the kernel has a G-buffer");
        let mut scene = Scene::of(&gpu, renderer, kernel.clone());
        scene.renderer.resize(&gpu.device, SIZE).expect("small");
        for lights in [1, 0, 3] {
            let light = [DirectionalLight::default().into(); 3];
            let frame = Frame { lights: &light[..lights], ..Frame::new(camera(), bounds(), 1000.0) };
            let output = Target::new(&gpu.device, SIZE, FORMAT, "test picture").expect("small");
            scene.renderer.prepare(&gpu.queue, &frame).expect("resized");
            let timer = timer.expect("given above");
            gpu.validated(|| {
                gpu.submit(|encoder| {
                    scene.renderer.encode(encoder, &scene.objects, &output.view)?;
                    timer.resolve(encoder);
                    Ok(())
                });
            });
            let times = timer.wait(&gpu.device).expect("the device answers");
            let names: Vec<_> = times.iter().map(|(name, _)| name.as_str()).collect();
            assert_eq!(names, Renderer::PASSES);
            let (_, subsurface) = times[2];
            assert!(!subsurface.is_zero() && subsurface.as_secs() < 60, "{path:?}: {times:?}");
        }
    }
}
