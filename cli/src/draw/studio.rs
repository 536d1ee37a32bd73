//! Frames of a scene.

use std::time::{Duration, Instant};

use subsurface_codegen::Compilation;
use subsurface_runtime::{
    self as runtime, CompositeInputs, CompositePass, CompositeSettings, DebugView, DirectionalLight,
    DistancePass, Extent, GBuffer, Geometry, Object, Path, Renderer, SubsurfaceView, SurfaceDescriptor,
    Target, TexturePixels, Vertex, wgpu,
};

use super::device::Device;
use super::{beyond_device, subsurface_pass};
use crate::failure::Failure;
use crate::picture::{DisplayPicture, LinearPicture};
use crate::scene::camera::{Camera, Light, Size};
use crate::scene::{Image, Scene};

/// glTF and the bust are in metres.
const MILLIMETRES_PER_WORLD_UNIT: f32 = 1000.0;

/// Format of the picture for the screen: its bytes are sRGB code values.
const DISPLAY_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;

/// Format of the picture in linear light.
const LINEAR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

/// Irradiance from everywhere alike, so that no shadow is black: a fortieth of a light of intensity 1.
const AMBIENT_INTENSITY: f32 = 0.025;

/// One picture to draw.
#[derive(Clone, Copy, Debug)]
pub struct Frame<'a> {
    /// What is drawn.
    pub scene: &'a Scene,
    /// Number of the material of each object, in the order of `scene.objects`.
    pub material_of_object: &'a [u32],
    /// Where one looks from.
    pub camera: Camera,
    /// Where the light comes from; the first one is the most important.
    pub lights: &'a [Light],
    /// Size of the picture.
    pub size: Size,
    /// Pixels drawn per pixel of the picture, along each side: 1, or more for smooth silhouettes.
    pub supersampling: u32,
    /// What of it is shown.
    pub shown: Shown,
    /// Whether the intermediate targets are wanted.
    pub wants_aovs: bool,
    /// Whether each pass is timed: the frame is then drawn twice, since the first time compiles shaders.
    pub wants_timings: bool,
}

/// What of a frame is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shown {
    /// The picture.
    Subsurface,
    /// The picture without light below the surface.
    Surface,
    /// What the subsurface pass does.
    Debug(DebugView),
}

/// What came of a [`Frame`].
#[derive(Clone, Debug)]
pub struct Drawn {
    /// Tone-mapped, sRGB: for PNG.
    pub display: DisplayPicture,
    /// Before tone mapping, linear: for EXR.
    pub linear: LinearPicture,
    /// Intermediate targets by name, if they were wanted: `irradiance`, `diffused_irradiance`, `specular_transmission`,
    /// `surface_albedo`, `material` (−1: none), `distance_mm` (along the view axis; 0: background).
    pub aovs: Vec<(String, LinearPicture)>,
    /// How long each pass took, in the order of the frame, if that was wanted; from submission until it was done.
    pub timings: Vec<(String, Duration)>,
}

/// A device with the passes of one material set.
#[derive(Debug)]
pub struct Studio {
    device: Device,
    renderer: Renderer,
    linear: CompositePass,
}

impl Studio {
    /// Opens a device and makes the pipelines; `path` is the subsurface pass's, by default what the device has.
    pub fn open(materials: &Compilation, path: Option<Path>) -> Result<Self, Failure> {
        let device = Device::open()?;
        let (renderer, linear) = device.checked(|| {
            let mut renderer = Renderer::new(&device.device, &materials.parts, DISPLAY_FORMAT);
            if path.is_some() {
                let (format, stencil) = (GBuffer::COLOUR_FORMAT, Some(GBuffer::DEPTH_STENCIL_FORMAT));
                renderer.subsurface = subsurface_pass(&device, &materials.parts, format, stencil, path)?;
            }
            Ok((renderer, CompositePass::new(&device.device, LINEAR_FORMAT)))
        })?;
        Ok(Self { device, renderer, linear })
    }

    /// The adapter that draws, for people.
    pub fn description(&self) -> String {
        self.device.description()
    }

    /// Draws a frame.
    pub fn draw(&mut self, frame: &Frame<'_>) -> Result<Drawn, Failure> {
        let Self { device, renderer, linear } = self;
        device.checked(|| draw(device, renderer, linear, frame))
    }
}

fn draw(
    device: &Device,
    renderer: &mut Renderer,
    linear: &mut CompositePass,
    frame: &Frame<'_>,
) -> Result<Drawn, Failure> {
    let factor = frame.supersampling.max(1);
    let drawn_size = Size {
        width: frame.size.width.saturating_mul(factor),
        height: frame.size.height.saturating_mul(factor),
    };
    let size = Extent::new(drawn_size.width, drawn_size.height);
    renderer.resize(&device.device, size).map_err(|error| beyond_device(&error))?;
    let debug_view = match frame.shown {
        Shown::Debug(view) => Some(view),
        Shown::Subsurface | Shown::Surface => None,
    };
    renderer
        .subsurface
        .set_debug_view(debug_view)
        .map_err(|error| Failure::new(error.to_string(), "please report this as a defect"))?;
    let objects = objects(device, renderer, frame)?;
    let view = prepare(device, renderer, frame, size);

    let target =
        |format, label| Target::new(&device.device, size, format, label).map_err(|e| beyond_device(&e));
    let display = target(DISPLAY_FORMAT, "Studio display picture")?;
    let linear_target = target(LINEAR_FORMAT, "Studio linear picture")?;
    let mut timings = Vec::new();
    if frame.wants_timings {
        run_passes(device, renderer, &objects, &display)?;
        timings = run_passes(device, renderer, &objects, &display)?;
    } else {
        submit(device, |encoder| renderer.encode(encoder, &objects, &display.view));
    }

    let (Some(targets), Some(diffused)) = (renderer.targets(), renderer.subsurface.output()) else {
        return Err(Failure::new("the frame has no targets", "please report this as a defect"));
    };
    linear.resize(
        &device.device,
        &CompositeInputs {
            diffused: &diffused.view,
            unscattered: &targets.unscattered.view,
            surface: &targets.surface.view,
        },
    );
    linear.prepare(&device.queue, &CompositeSettings { tone_map: false, ..Default::default() });
    submit(device, |encoder| linear.encode(encoder, &linear_target.view));

    let (display, linear) = if let Shown::Debug(_) = frame.shown {
        // Colours of the pass's own, not light: they go past the surface albedo and the tone mapping.
        let linear = picture(device, diffused, drawn_size)?;
        (linear.to_display(), linear)
    } else {
        let bytes = device.read_bytes(&display.texture)?;
        let pixels = bytes.chunks_exact(4).map(|texel| [texel[0], texel[1], texel[2]]).collect();
        (DisplayPicture { size: drawn_size, pixels }, picture(device, &linear_target, drawn_size)?)
    };
    Ok(Drawn {
        display: display.shrunk(factor),
        linear: linear.shrunk(factor),
        // Depth and material numbers have no mean: these stay as they were drawn.
        aovs: if frame.wants_aovs { aovs(device, targets, diffused, &view, drawn_size)? } else { Vec::new() },
        timings,
    })
}

/// Uploads the frame; returns how the subsurface pass sees it.
fn prepare(device: &Device, renderer: &mut Renderer, frame: &Frame<'_>, size: Extent) -> SubsurfaceView {
    let lights: Vec<DirectionalLight> = frame
        .lights
        .iter()
        .map(|light| DirectionalLight {
            direction: light.direction,
            // A white diffuse surface under irradiance π has radiance 1.
            irradiance: [std::f32::consts::PI * light.intensity; 3],
        })
        .collect();
    let bounds = runtime::Bounds {
        centre: frame.scene.bounds.centre(),
        // A single point still needs a sphere to fit shadow maps to.
        radius: frame.scene.bounds.radius().max(1e-4),
    };
    let camera = runtime::Camera {
        position: frame.camera.position,
        target: frame.camera.target,
        fov_y_radians: frame.camera.fov_y_degrees.to_radians(),
    };
    let frame = runtime::Frame {
        camera,
        lights: &lights,
        ambient_irradiance: [std::f32::consts::PI * AMBIENT_INTENSITY; 3],
        bounds,
        millimetres_per_world_unit: MILLIMETRES_PER_WORLD_UNIT,
        transmission: if frame.shown == Shown::Surface { 0.0 } else { 1.0 },
        taps: if frame.shown == Shown::Surface { Some(0) } else { None },
        frame_index: 0,
        composite: CompositeSettings::default(),
    };
    renderer.prepare(&device.queue, &frame);
    frame.subsurface_view(size)
}

fn objects(device: &Device, renderer: &Renderer, frame: &Frame<'_>) -> Result<Vec<Object>, Failure> {
    let mut objects = Vec::with_capacity(frame.scene.objects.len());
    for (object, &material) in frame.scene.objects.iter().zip(frame.material_of_object) {
        let surface = &object.surface;
        let mesh = &object.mesh;
        let vertices: Vec<Vertex> = (0..mesh.positions.len())
            .map(|index| Vertex {
                position: mesh.positions[index],
                normal: mesh.normals[index],
                texture_coordinate: mesh.texture_coordinates[index],
            })
            .collect();
        let geometry = Geometry::new(&device.device, &vertices, &mesh.indices);
        let [red, green, blue, _] = surface.base_colour_factor;
        let descriptor = SurfaceDescriptor {
            material: Some(material),
            surface_albedo: surface.base_colour.as_ref().map(pixels),
            surface_albedo_factor: [red, green, blue],
            normals: surface.normal_map.as_ref().map(pixels),
            normal_scale: surface.normal_scale,
            ..Default::default()
        };
        let made = renderer.object(&device.device, &device.queue, geometry, &descriptor);
        objects.push(
            made.map_err(|error| {
                Failure::new(format!("{}: {error}", object.name), "scale its textures down")
            })?,
        );
    }
    Ok(objects)
}

fn pixels(image: &Image) -> TexturePixels<'_> {
    TexturePixels { width: image.width, height: image.height, rgba: &image.rgba }
}

fn submit(device: &Device, record: impl FnOnce(&mut wgpu::CommandEncoder)) {
    let label = Some("Studio");
    let mut encoder = device.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label });
    record(&mut encoder);
    device.queue.submit([encoder.finish()]);
}

/// Runs the passes one by one, each from submission until it is done.
fn run_passes(
    device: &Device,
    renderer: &Renderer,
    objects: &[Object],
    output: &Target,
) -> Result<Vec<(String, Duration)>, Failure> {
    let mut timings = Vec::with_capacity(4);
    let mut timed = |name: &str, record: &dyn Fn(&mut wgpu::CommandEncoder)| {
        device.wait()?;
        let start = Instant::now();
        submit(device, record);
        device.wait()?;
        timings.push((name.to_owned(), start.elapsed()));
        Ok::<(), Failure>(())
    };
    timed("shadow", &|encoder| renderer.shadow.encode(encoder, objects))?;
    timed("G-buffer", &|encoder| renderer.gbuffer.encode(encoder, objects))?;
    timed("subsurface", &|encoder| renderer.subsurface.encode(encoder))?;
    timed("composite", &|encoder| renderer.composite.encode(encoder, &output.view))?;
    Ok(timings)
}

fn picture(device: &Device, target: &Target, size: Size) -> Result<LinearPicture, Failure> {
    let texels = device.read(&target.texture)?;
    Ok(LinearPicture { size, pixels: texels.into_iter().map(|[r, g, b, _]| [r, g, b]).collect() })
}

fn aovs(
    device: &Device,
    targets: &GBuffer,
    diffused: &Target,
    view: &SubsurfaceView,
    size: Size,
) -> Result<Vec<(String, LinearPicture)>, Failure> {
    let extent = Extent::new(size.width, size.height);
    let mut distance = DistancePass::new(&device.device);
    distance.resize(&device.device, extent, &targets.depth).map_err(|error| beyond_device(&error))?;
    distance.prepare(&device.queue, view);
    submit(device, |encoder| distance.encode(encoder));
    let material = device.read(&targets.surface.texture)?;
    let material =
        LinearPicture { size, pixels: material.into_iter().map(|[.., number]| [number; 3]).collect() };
    let mut aovs = Vec::with_capacity(6);
    for (name, target) in [
        ("irradiance", &targets.irradiance),
        ("diffused_irradiance", diffused),
        ("specular_transmission", &targets.unscattered),
        ("surface_albedo", &targets.surface),
    ] {
        aovs.push((name.to_owned(), picture(device, target, size)?));
    }
    aovs.push(("material".to_owned(), material));
    if let Some(target) = distance.output() {
        aovs.push(("distance_mm".to_owned(), picture(device, target, size)?));
    }
    Ok(aovs)
}
