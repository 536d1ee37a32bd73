//! The error that the compiler states, against what the device draws.
//!
//! The compiler tries kernels on the processor, on squares of pixels that lie here and there in each picture. Here the
//! device draws whole pictures, with the feature at every phase of blocks and lattices, and is compared with an exact result that
//! comes from elsewhere: the edge-spread function of the profile crate, or the kernel that sums every pixel.

mod gpu;

use gpu::Gpu;
use subsurface_codegen::{Compilation, Compiler, Estimator, OutputFormat, PictureReport};
use subsurface_profile::{Channel, EdgeSpread, Medium, Model, RadialProfile};
use subsurface_runtime::{SubsurfaceDescriptor, SubsurfaceInputs, SubsurfacePass, SubsurfaceView, wgpu};

/// A profile that does not depend on the surface albedo: others are tried where they are white as well, and the error that
/// is stated is that of the worse.
const UNIFORM: &str = "dipole_skin1";

/// A profile that does, for the picture that is not tried where they are white.
const TEXTURED: &str = "two_exponential_dipole_searchlight";

const LENGTH_MM: [f64; 3] = [1.3, 0.95, 0.67];
const SURFACE_ALBEDO: [f64; 3] = [0.83, 0.64, 0.55];

/// Period of blocks and lattices on the screen, pixels.
const PERIOD: i32 = 4;

/// Differences between the statement and the pictures: the statement's squares are a sample of their pixels (measured:
/// within 14 %), and stages keep nine bits, which is 1e-3 of the white level.
const TOLERANCE: (f64, f64) = (0.2, 1e-3);

/// A set of one material with a profile, whose file says `choice`.
fn compiled(profile: &str, choice: &str) -> Compilation {
    let skin = format!(
        "Material(profile: \"{profile}\", mean_free_path_mm: ({}, {}, {}), surface_albedo: ({}, {}, {}))",
        LENGTH_MM[0], LENGTH_MM[1], LENGTH_MM[2], SURFACE_ALBEDO[0], SURFACE_ALBEDO[1], SURFACE_ALBEDO[2]
    );
    let files = [("skin.ron", skin), ("set.ron", format!("MaterialSet({choice})"))];
    let compiler = Compiler::from_memory(files).without_gbuffer().output_format(OutputFormat::Rgba32Float);
    compiler.compile().unwrap_or_else(|report| panic!("{report}"))
}

/// The profiles of the three channels where the surface albedo has a factor.
fn profiles(stem: &str, albedo: f64) -> [Box<dyn RadialProfile>; 3] {
    let model = Model::published(stem).expect("it is published");
    Channel::ALL.map(|channel| {
        let index = channel.index();
        let medium = Medium::new(albedo * SURFACE_ALBEDO[index], LENGTH_MM[index]).expect("a medium");
        model.profile(medium, channel).expect("a profile")
    })
}

/// Mean radius in mm of the widest channel, over all but the last 1e-4 of its light, as curves hold it.
fn mean_radius_mm(profile: &str) -> f64 {
    let red = &profiles(profile, 1.0)[0];
    (0..9999).map(|place| red.sample_radius((f64::from(place) + 0.5) / 1e4)).sum::<f64>() / 9999.0
}

/// What a picture shows: irradiance, and depth in pixels where there is a surface, by place about its feature.
#[derive(Clone, Copy)]
struct Picture {
    name: &'static str,
    profile: &'static str,
    light: fn(i32, i32, f64) -> bool,
    depth: fn(i32, i32) -> Option<f64>,
    /// Factor on the surface albedo, by column.
    albedo: fn(i32) -> f64,
}

impl Picture {
    const fn new(
        name: &'static str,
        light: fn(i32, i32, f64) -> bool,
        depth: fn(i32, i32) -> Option<f64>,
    ) -> Self {
        Self { name, profile: UNIFORM, light, depth, albedo: |_| 1.0 }
    }
}

const FLAT: fn(i32, i32) -> Option<f64> = |_, _| Some(0.0);

const PICTURES: [Picture; 5] = [
    Picture::new("step edge", |x, _, _| x >= 0, FLAT),
    Picture::new("line", |x, _, _| x == 0, FLAT),
    Picture::new("disc", |x, y, mean| f64::from(x * x + y * y) <= (1.5 * mean).powi(2), FLAT),
    Picture::new("pixel", |x, y, _| (x, y) == (0, 0), FLAT),
    Picture::new("crease", |x, _, _| x >= 0, |x, _| Some((f64::from(x) + 0.5).abs())),
];

/// A step edge where the surface albedo changes.
const ALBEDO_EDGE: Picture = Picture {
    profile: TEXTURED,
    albedo: |x| if x >= 0 { 0.85 } else { 1.0 },
    ..Picture::new("albedo edge", |x, _, _| x >= 0, FLAT)
};

/// A step edge in a frame of 20 columns.
const FRAME: Picture = Picture::new("frame", |x, _, _| x >= 0, |x, _| (-10..10).contains(&x).then_some(0.0));

/// A ball of 24 pixels in stripes of 9.
const BALL: Picture = Picture::new(
    "ball",
    |x, _, _| ((x + 24) / 9) % 2 == 0,
    |x, y| {
        let left = 24 * 24 - x * x - y * y;
        (left >= 0).then(|| -f64::from(left).sqrt())
    },
);

/// A picture on the screen: its feature at `centre` in a square of `side` pixels.
struct Drawn {
    texels: Vec<[f32; 4]>,
    side: i32,
    centre: [i32; 2],
}

impl Drawn {
    fn new(
        gpu: &Gpu,
        kernel: &Compilation,
        picture: Picture,
        mean: f64,
        side: i32,
        centre: [i32; 2],
    ) -> Self {
        let pixel_mm = mean_radius_mm(picture.profile) / mean;
        let size = [side as u32; 2];
        let place = |x: u32, y: u32| (x as i32 - centre[0], y as i32 - centre[1]);
        let irradiance = gpu.rgba32(size, |x, y| {
            let (x, y) = place(x, y);
            [f32::from(u8::from((picture.light)(x, y, mean))); 4]
        });
        let albedo = SURFACE_ALBEDO.map(|albedo| albedo as f32);
        let depth_at = |x, y| {
            let (x, y) = place(x, y);
            (picture.depth)(x, y)
        };
        let surface = gpu.rgba32(size, |x, y| {
            let material = if depth_at(x, y).is_some() { 0.0 } else { -1.0 };
            let factor = (picture.albedo)(place(x, y).0) as f32;
            [factor * albedo[0], factor * albedo[1], factor * albedo[2], material]
        });
        let depth = gpu.r32(size, |x, y| (1000.0 + pixel_mm * depth_at(x, y).unwrap_or_default()) as f32);
        let inputs = SubsurfaceInputs::new(&irradiance, &surface, &depth);
        let descriptor = SubsurfaceDescriptor::new(wgpu::TextureFormat::Rgba32Float);
        let texels = gpu.validated(|| {
            let mut pass = SubsurfacePass::new(&gpu.device, &gpu.load(&kernel.parts), &descriptor)
                .expect("every device can write this format");
            pass.bind(&gpu.device, &inputs).expect("the inputs fit");
            let output = pass.create_output(&gpu.device).expect("bound above");
            let view = SubsurfaceView::orthographic_distances(pixel_mm as f32);
            pass.prepare(&gpu.queue, &view).expect("bound above");
            gpu.submit(|encoder| pass.encode(encoder, &output.view));
            gpu.read_texture(&output.texture)
        });
        Self { texels: bytemuck::pod_collect_to_vec(&texels), side, centre }
    }

    /// The pixel at a place about the feature.
    fn at(&self, x: i32, y: i32) -> [f64; 3] {
        let texel = self.texels[((y + self.centre[1]) * self.side + x + self.centre[0]) as usize];
        [texel[0], texel[1], texel[2]].map(f64::from)
    }
}

/// Root mean squares over a region about the feature, which is drawn at every phase: the largest of the channels.
fn error(picture: Picture, pictures: &[Drawn], reach: [i32; 2], exact: impl Fn(i32, i32) -> [f64; 3]) -> f64 {
    let mut squares = [0.0; 3];
    let mut count = 0.0;
    for drawn in pictures {
        let places = (-reach[0]..reach[0]).flat_map(|x| (-reach[1]..reach[1]).map(move |y| (x, y)));
        for (x, y) in places.filter(|(x, y)| (picture.depth)(*x, *y).is_some()) {
            let (found, exact) = (drawn.at(x, y), exact(x, y));
            for channel in 0..3 {
                squares[channel] += (found[channel] - exact[channel]).powi(2);
            }
            count += 1.0;
        }
    }
    (squares.into_iter().fold(0.0, f64::max) / count).sqrt()
}

/// How far the compiler's squares of a period's side go where they have to cover this many pixels.
fn region(reach: f64) -> i32 {
    (2.0 * reach / f64::from(PERIOD)).ceil() as i32 * PERIOD / 2
}

fn stated(compilation: &Compilation, name: &str, mean: f64) -> PictureReport {
    let report = compilation.quality.as_ref().expect("it was asked for");
    let found = report.pictures.iter().find(|p| p.name == name && p.mean_radius_pixels == mean);
    found.unwrap_or_else(|| panic!("no {name} at {mean} pixels")).clone()
}

fn assert_near(what: &str, kernel: Estimator, drawn: f64, stated: f64) {
    let (share, least) = TOLERANCE;
    assert!(
        (drawn - stated).abs() <= (share * stated).max(least),
        "{what}, {kernel}: {drawn}, stated {stated}"
    );
}

/// Whatever each kernel is asked for, a number of taps comes out that has an error worth measuring.
const CHOICES: [&str; 4] = [
    "kernel: ImportanceSampled, quality: MaxError(0.08)",
    "kernel: Separable, quality: MaxError(0.09)",
    "kernel: Interleaved, quality: MaxError(0.06)",
    "kernel: Interleaved, quality: MaxError(0.02)",
];

#[test]
fn edges_have_the_errors_that_are_stated() {
    let gpu = Gpu::open();
    let mean = 3.0;
    for picture in [PICTURES[0], ALBEDO_EDGE] {
        let pixel_mm = mean_radius_mm(picture.profile) / mean;
        let reach = region(2.0 * mean + 3.0);
        // A pixel takes light as its own surface does.
        let exact: Vec<[f64; 3]> = (-reach..reach)
            .map(|x| {
                let profiles = profiles(picture.profile, (picture.albedo)(x));
                profiles.map(|profile| EdgeSpread::new(&*profile).at((f64::from(x) + 0.5) * pixel_mm))
            })
            .collect();
        for choice in CHOICES {
            let compilation = compiled(picture.profile, choice);
            // Light from beyond the border is missing: 60 pixels hold all but 1e-3 of it.
            let centre = |phase| [60 + phase, 60];
            let pictures: Vec<Drawn> = (0..PERIOD)
                .map(|phase| Drawn::new(&gpu, &compilation, picture, mean, 126, centre(phase)))
                .collect();
            let drawn = error(picture, &pictures, [reach, PERIOD / 2], |x, _| exact[(x + reach) as usize]);
            let what = picture.name;
            assert_near(what, compilation.estimator(), drawn, stated(&compilation, what, mean).error);
        }
    }
}

#[test]
fn small_pictures_have_the_errors_that_are_stated() {
    let gpu = Gpu::open();
    let mean = 1.0;
    let dense = compiled(UNIFORM, "kernel: Dense");
    let compilations = CHOICES.map(|choice| compiled(UNIFORM, choice));
    for picture in PICTURES {
        let reach = 2.0 * mean + 3.0 + if picture.name == "disc" { 1.5 * mean } else { 0.0 };
        let reach = region(reach);
        let across = if ["disc", "pixel"].contains(&picture.name) { reach } else { PERIOD / 2 };
        let exact = Drawn::new(&gpu, &dense, picture, mean, 54, [27, 27]);
        for compilation in &compilations {
            let pictures: Vec<Drawn> = (0..PERIOD)
                .map(|phase| Drawn::new(&gpu, compilation, picture, mean, 60, [27 + phase, 27 + phase]))
                .collect();
            let drawn = error(picture, &pictures, [reach, across], |x, y| exact.at(x, y));
            let what = picture.name;
            assert_near(what, compilation.estimator(), drawn, stated(compilation, what, mean).error);
        }
    }
}

#[test]
fn what_ends_within_the_picture_has_the_error_that_is_stated() {
    let gpu = Gpu::open();
    let dense = compiled(UNIFORM, "kernel: Dense");
    for (picture, mean, side, reach) in [(BALL, 3.0, 60, [24, 24]), (FRAME, 10.0, 130, [10, PERIOD / 2])] {
        let centre = side / 2;
        let exact = Drawn::new(&gpu, &dense, picture, mean, side, [centre; 2]);
        for choice in CHOICES {
            let compilation = compiled(UNIFORM, choice);
            let pictures: Vec<Drawn> = (0..PERIOD)
                .map(|phase| Drawn::new(&gpu, &compilation, picture, mean, side + 6, [centre + phase; 2]))
                .collect();
            let drawn = error(picture, &pictures, reach, |x, y| exact.at(x, y));
            let what = picture.name;
            assert_near(what, compilation.estimator(), drawn, stated(&compilation, what, mean).error);
        }
    }
}
