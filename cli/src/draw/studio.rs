//! Frames of a scene.

use std::fmt;
use std::time::{Duration, Instant};

use subsurface_codegen::Compilation;
use subsurface_runtime::{
    self as runtime, CompositeDescriptor, CompositeInputs, CompositePass, CompositeSettings, DebugView,
    DistancePass, Extent, FrameError, GBuffer, Geometry, Object, PassTimer, Renderer, RendererDescriptor,
    SubsurfaceView, SurfaceDescriptor, Target, TexturePixels, Vertex, wgpu,
};

use super::device::{Device, DeviceError};
use super::route::Route;
use super::{beyond_device, load, out_of_order};
use crate::failure::Failure;
use crate::picture::{DisplayPicture, LinearPicture};
use crate::scene::camera::{Camera, Size};
use crate::scene::environment::Environment;
use crate::scene::light::Light;
use crate::scene::{Image, MILLIMETRES_PER_METRE, Scene, Surface};

/// Format of the picture for the screen: its bytes are sRGB code values.
const DISPLAY_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;

/// Format of the picture in linear light.
const LINEAR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

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
    /// Irradiance that comes from everywhere alike, as a light's intensity.
    pub ambient_intensity: f32,
    /// Light from all around, if there is some.
    pub environment: Option<&'a Environment>,
    /// Size of the picture.
    pub size: Size,
    /// Pixels drawn per pixel of the picture, along each side: 1, or more for smooth silhouettes.
    pub supersampling: u32,
    /// What of it is shown.
    pub shown: Shown,
    /// Whether the intermediate targets are wanted.
    pub wants_aovs: bool,
    /// Whether each pass is timed: a studio's first frame is then drawn twice, since the first time compiles shaders.
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
    /// How long each pass took, if that was wanted.
    pub timings: Option<Timings>,
}

/// How long each pass of a frame took.
#[derive(Clone, Debug)]
pub struct Timings {
    /// Names and times, in the order of the frame.
    pub passes: Vec<(String, Duration)>,
    /// Whether the device took the times. If it cannot, they go from submission until it was done, and hold what
    /// submitting costs.
    pub by_device: bool,
}

/// `12.3 ms (shadow 1.2 ms, …)`
impl fmt::Display for Timings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let milliseconds = |time: &Duration| time.as_secs_f64() * 1e3;
        let total: f64 = self.passes.iter().map(|(_, time)| milliseconds(time)).sum();
        let passes: Vec<String> =
            self.passes.iter().map(|(pass, time)| format!("{pass} {:.3} ms", milliseconds(time))).collect();
        write!(f, "{total:.3} ms ({})", passes.join(", "))
    }
}

/// What a scene asks of a renderer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Needs {
    /// Objects scale the mean free path.
    pub mean_free_path_scale: bool,
    /// Objects are clear.
    pub clear: bool,
    /// Texels per side of a shadow map, where the renderer's own number will not do.
    pub shadow_map_size: Option<u32>,
}

impl Needs {
    /// Of this scene.
    pub fn of(scene: &Scene) -> Self {
        let any = |has: fn(&Surface) -> bool| scene.objects.iter().any(|object| has(&object.surface));
        Self {
            mean_free_path_scale: any(|surface| {
                surface.mean_free_path_scale.is_some() || surface.mean_free_path_scale_factor != 1.0
            }),
            clear: any(|surface| surface.clear.is_some()),
            shadow_map_size: None,
        }
    }
}

/// A device with the passes of one material set.
#[derive(Debug)]
pub struct Studio {
    device: Device,
    renderer: Renderer,
    linear: CompositePass,
    /// `None` on a device that cannot time passes.
    timer: Option<PassTimer>,
    /// A frame was drawn, so that drivers have compiled what they compile at the first use.
    is_warm: bool,
}

impl Studio {
    /// Opens a device and makes the pipelines; `route` is the subsurface pass's.
    pub fn open(materials: &Compilation, route: Route, needs: Needs) -> Result<Self, Failure> {
        Self::on(Device::open()?, materials, route, needs)
    }

    /// The same on a device that is open.
    pub fn on(device: Device, materials: &Compilation, route: Route, needs: Needs) -> Result<Self, Failure> {
        let timer = PassTimer::new(&device.device, &device.queue, &Renderer::PASSES).ok();
        let (renderer, linear) = device.checked(|| {
            let kernel = load(&device, &materials.parts)?;
            let timer = timer.as_ref();
            let Route { path, shape } = route;
            let descriptor = RendererDescriptor {
                format: DISPLAY_FORMAT,
                mean_free_path_scale: needs.mean_free_path_scale,
                clear: needs.clear,
                shadow_map_size: needs.shadow_map_size,
                path,
                shape,
                timer,
                ..Default::default()
            };
            let renderer = Renderer::new(&device.device, &kernel, &descriptor)
                .map_err(|error| Failure::new(error.to_string(), "choose another --path, or none"))?;
            route.check(&renderer.subsurface)?;
            let descriptor =
                CompositeDescriptor { format: LINEAR_FORMAT, kernel: Some(&kernel), ..Default::default() };
            Ok((renderer, CompositePass::new(&device.device, &descriptor)))
        })?;
        Ok(Self { device, renderer, linear, timer, is_warm: false })
    }

    /// The adapter that draws, for people.
    pub fn description(&self) -> String {
        self.device.description()
    }

    /// Draws a frame.
    pub fn draw(&mut self, frame: &Frame<'_>) -> Result<Drawn, Failure> {
        let Self { device, renderer, linear, timer, is_warm } = self;
        let drawn = device.checked(|| draw(device, renderer, linear, timer.as_ref(), *is_warm, frame))?;
        *is_warm = true;
        Ok(drawn)
    }
}

fn draw(
    device: &Device,
    renderer: &mut Renderer,
    linear: &mut CompositePass,
    timer: Option<&PassTimer>,
    is_warm: bool,
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
        .map_err(|error| Failure::new(error.to_string(), "leave --debug out, or choose another adapter"))?;
    let environment = frame.environment.map(|environment| uploaded(device, environment)).transpose()?;
    renderer
        .set_environment(environment)
        .map_err(|error| Failure::new(error.to_string(), "please report this as a defect"))?;
    let objects = objects(device, frame)?;
    let view = prepare(device, renderer, frame, size)?;

    let target =
        |format, label| Target::new(&device.device, size, format, label).map_err(|e| beyond_device(&e));
    let display = target(DISPLAY_FORMAT, "Studio display picture")?;
    let render = |encoder: &mut wgpu::CommandEncoder| renderer.encode(encoder, &objects, &display.view);
    let timings = match timer {
        _ if !frame.wants_timings => {
            device.submit(render)?;
            None
        }
        Some(timer) => {
            if !is_warm {
                device.submit(render)?;
            }
            device.submit(|encoder| {
                render(encoder)?;
                timer.resolve(encoder);
                Ok(())
            })?;
            let passes = timer.wait(&device.device);
            let passes = passes.map_err(|error| DeviceError::Lost { reason: error.to_string() })?;
            Some(Timings { passes, by_device: true })
        }
        None => {
            if !is_warm {
                run_passes(device, renderer, &objects, &display)?;
            }
            Some(Timings { passes: run_passes(device, renderer, &objects, &display)?, by_device: false })
        }
    };

    let (Some(targets), Some(diffused)) = (renderer.targets(), renderer.diffused()) else {
        return Err(Failure::new("the frame has no targets", "please report this as a defect"));
    };
    let linear_target = target(LINEAR_FORMAT, "Studio linear picture")?;
    let inputs = CompositeInputs::new(&diffused.view, &targets.unscattered.view, &targets.surface.view);
    linear.bind(&device.device, &inputs).map_err(|error| beyond_device(&error))?;
    let settings = CompositeSettings { tone_map: false, ..Default::default() };
    linear.prepare(&device.queue, &settings).map_err(out_of_order)?;
    device.submit(|encoder| linear.encode(encoder, &linear_target.view))?;

    let (display, linear) = if let Shown::Debug(_) = frame.shown {
        // Colours of the pass's own, not light: they go past the surface albedo and the tone mapping.
        let linear = picture(device, diffused, drawn_size)?;
        (linear.to_display(), linear)
    } else {
        let bytes = device.read_bytes(&display.texture)?;
        let pixels = bytes.chunks_exact(4).map(|texel| [texel[0], texel[1], texel[2]]).collect();
        // What is clear was drawn over the composite pass's picture.
        let linear = renderer.radiance().unwrap_or(&linear_target);
        (DisplayPicture { size: drawn_size, pixels }, picture(device, linear, drawn_size)?)
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
fn prepare(
    device: &Device,
    renderer: &mut Renderer,
    frame: &Frame<'_>,
    size: Extent,
) -> Result<SubsurfaceView, Failure> {
    let lights: Vec<runtime::Light> = frame.lights.iter().map(runtime_light).collect();
    let bounds = runtime::Bounds::of_box(frame.scene.bounds.minimum, frame.scene.bounds.maximum);
    let camera = runtime::Camera {
        position: frame.camera.position,
        target: frame.camera.target,
        fov_y_radians: frame.camera.fov_y_degrees.to_radians(),
    };
    let frame = runtime::Frame {
        lights: &lights,
        ambient_irradiance: [std::f32::consts::PI * frame.ambient_intensity; 3],
        environment_intensity: frame.environment.map_or(0.0, |environment| environment.intensity),
        environment_turn_radians: frame.environment.map_or(0.0, |environment| environment.turn_radians),
        transmission: if frame.shown == Shown::Surface { 0.0 } else { 1.0 },
        taps: if frame.shown == Shown::Surface { Some(0) } else { None },
        ..runtime::Frame::new(camera, bounds, MILLIMETRES_PER_METRE)
    };
    renderer.prepare(&device.queue, &frame).map_err(out_of_order)?;
    Ok(frame.subsurface_view(size))
}

/// A light as the renderer takes it.
fn runtime_light(light: &Light) -> runtime::Light {
    // A white diffuse surface under irradiance π has radiance 1.
    let irradiance = [std::f32::consts::PI * light.intensity(); 3];
    match light {
        Light::Directional(light) => runtime::DirectionalLight {
            direction: light.direction,
            irradiance,
            angular_diameter_radians: light.angular_diameter_degrees.to_radians(),
        }
        .into(),
        Light::Point(lamp) => {
            runtime::PointLight { position: lamp.position, intensity: irradiance, radius_mm: lamp.radius_mm }
                .into()
        }
        Light::Spot(spot) => {
            let [inner_angle_radians, outer_angle_radians] = spot.angles_radians();
            runtime::SpotLight {
                position: spot.lamp.position,
                direction: spot.direction,
                intensity: irradiance,
                radius_mm: spot.lamp.radius_mm,
                inner_angle_radians,
                outer_angle_radians,
            }
            .into()
        }
    }
}

/// An environment on the device.
fn uploaded(device: &Device, environment: &Environment) -> Result<runtime::Environment, Failure> {
    let Size { width, height } = environment.radiance.size;
    let pixels = &environment.radiance.pixels;
    let made = runtime::Environment::new(&device.device, &device.queue, width, height, pixels);
    made.map_err(|error| Failure::new(format!("{}: {error}", environment.file.display()), "repair the image"))
}

fn objects(device: &Device, frame: &Frame<'_>) -> Result<Vec<Object>, Failure> {
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
        let factor = if surface.is_black { [0.0; 4] } else { surface.base_colour_factor };
        let [red, green, blue, _] = factor;
        let descriptor = SurfaceDescriptor {
            material: (!surface.is_black).then_some(material),
            opaque_reflectance_at_normal: 0.0,
            surface_albedo: surface.base_colour.as_ref().map(pixels),
            surface_albedo_factor: [red, green, blue],
            normals: surface.normal_map.as_ref().map(pixels),
            normal_scale: surface.normal_scale,
            roughness: surface.roughness.as_ref().map(pixels),
            roughness_factor: surface.roughness_factor,
            specular_strength: surface.specular_strength.as_ref().map(pixels),
            specular_strength_factor: surface.specular_strength_factor,
            mean_free_path_scale: surface.mean_free_path_scale.as_ref().map(pixels),
            mean_free_path_scale_factor: surface.mean_free_path_scale_factor,
            thickness: surface.thickness.as_ref().map(pixels),
            thickness_mm: surface.thickness_mm,
            clear: surface.clear,
            clear_coverage: surface.clear_coverage,
            ..Default::default()
        };
        let made = Object::new(&device.device, &device.queue, geometry, &descriptor);
        objects.push(
            made.map_err(|error| {
                Failure::new(format!("{}: {error}", object.name), "scale its textures down")
            })?,
        );
    }
    Ok(objects)
}

fn pixels(image: &Image) -> TexturePixels<'_> {
    TexturePixels::new(image.width, image.height, &image.rgba)
}

/// Runs the passes one by one, each from submission until it is done.
fn run_passes(
    device: &Device,
    renderer: &Renderer,
    objects: &[Object],
    output: &Target,
) -> Result<Vec<(String, Duration)>, Failure> {
    let (Some(targets), Some(diffused)) = (renderer.targets(), renderer.diffused()) else {
        return Ok(Vec::new());
    };
    let mut times = Vec::with_capacity(4);
    let mut timed = |record: &dyn Fn(&mut wgpu::CommandEncoder) -> Result<(), FrameError>| {
        device.wait()?;
        let start = Instant::now();
        device.submit(record)?;
        device.wait()?;
        times.push(start.elapsed());
        Ok::<(), Failure>(())
    };
    timed(&|encoder| renderer.shadow.encode(encoder, objects))?;
    timed(&|encoder| renderer.gbuffer.encode(encoder, objects, targets))?;
    timed(&|encoder| renderer.subsurface.encode(encoder, &diffused.view))?;
    timed(&|encoder| renderer.encode_picture(encoder, objects, &output.view))?;
    Ok(Renderer::PASSES.map(str::to_owned).into_iter().zip(times).collect())
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
    let mut pass = DistancePass::new(&device.device, &Default::default());
    pass.bind(&device.device, &targets.depth).map_err(|error| beyond_device(&error))?;
    let distance = pass.create_output(&device.device).map_err(out_of_order)?;
    pass.prepare(&device.queue, view).map_err(out_of_order)?;
    device.submit(|encoder| pass.encode(encoder, &distance.view))?;
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
    aovs.push(("distance_mm".to_owned(), picture(device, &distance, size)?));
    Ok(aovs)
}
