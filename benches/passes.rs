//! Time per pass at 1280×720, from submission until the device is done: a sphere that fills most of the frame.
//!
//! Absolute times belong to the adapter, whose name is printed; compare ratios of one run.

#![allow(clippy::print_stdout, reason = "names the adapter that the times belong to")]

use std::time::{Duration, Instant};

use criterion::Criterion;
use subsurface::presets::{self, Material};
use subsurface::runtime::{
    Bounds, Camera, DirectionalLight, Extent, Frame, FrameError, Geometry, Light, LoadedKernel, Object,
    Renderer, RendererDescriptor, SurfaceDescriptor, Target, Vertex, wgpu,
};

const SIZE: Extent = Extent::new(1280, 720);
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;

/// What records a pass.
type Record<'a> = dyn Fn(&mut wgpu::CommandEncoder) -> Result<(), FrameError> + 'a;

struct Gpu {
    device: wgpu::Device,
    queue: wgpu::Queue,
}

impl Gpu {
    fn open() -> Self {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
        let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))
            .expect("no graphics adapter: install a Vulkan driver such as mesa-vulkan-drivers");
        let info = adapter.get_info();
        println!("adapter: {} ({})", info.name, info.backend);
        let (device, queue) =
            pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default())).expect("a device");
        Self { device, queue }
    }

    /// Time from submission until the device is done.
    fn time(&self, record: &Record<'_>) -> Duration {
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        record(&mut encoder).expect("the passes are prepared");
        let commands = encoder.finish();
        let start = Instant::now();
        self.queue.submit([commands]);
        self.device.poll(wgpu::PollType::wait_indefinitely()).expect("the device answers");
        start.elapsed()
    }
}

/// A sphere of radius 0.1 m with 131,072 triangles.
const SUN: DirectionalLight =
    DirectionalLight { direction: [-1.0, -1.0, -0.5], irradiance: [3.0; 3], angular_diameter_radians: 0.0 };

fn sphere() -> (Vec<Vertex>, Vec<u32>) {
    const RINGS: u32 = 256;
    let point = |ring: u32, sector: u32| {
        let theta = ring as f32 / RINGS as f32 * std::f32::consts::PI;
        let phi = sector as f32 / RINGS as f32 * std::f32::consts::TAU;
        let normal = [theta.sin() * phi.sin(), theta.cos(), theta.sin() * phi.cos()];
        Vertex { position: normal.map(|x| 0.1 * x), normal, texture_coordinate: [0.0; 2] }
    };
    let vertices = (0..=RINGS).flat_map(|ring| (0..=RINGS).map(move |sector| point(ring, sector))).collect();
    let indices = (0..RINGS)
        .flat_map(|ring| (0..RINGS).map(move |sector| ring * (RINGS + 1) + sector))
        .flat_map(|a| [a, a + RINGS + 1, a + 1, a + 1, a + RINGS + 1, a + RINGS + 2])
        .collect();
    (vertices, indices)
}

fn frame(taps: u32) -> Frame<'static> {
    let camera = Camera { position: [0.0, 0.0, 0.5], fov_y_radians: 0.4, ..Default::default() };
    Frame {
        lights: &[Light::Directional(SUN)],
        ambient_irradiance: [0.05; 3],
        taps: Some(taps),
        ..Frame::new(camera, Bounds::new([0.0; 3], 0.11), 1000.0)
    }
}

fn main() {
    let mut criterion = Criterion::default()
        .configure_from_args()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(500))
        .measurement_time(Duration::from_secs(3));
    let gpu = Gpu::open();
    let kernel = LoadedKernel::new(&gpu.device, &gpu.queue, &presets::kernel()).expect("it fits any device");
    let descriptor = RendererDescriptor { format: FORMAT, ..Default::default() };
    let mut renderer = Renderer::new(&gpu.device, &kernel, &descriptor).expect("presets have a G-buffer");
    renderer.resize(&gpu.device, SIZE).expect("a frame within the limits");
    let targets = renderer.targets().expect("resized above").clone();
    let diffused = renderer.diffused().expect("resized above").clone();
    let output = Target::new(&gpu.device, SIZE, FORMAT, "bench picture").expect("within the limits");
    let (vertices, indices) = sphere();
    let geometry = Geometry::new(&gpu.device, &vertices, &indices);
    let surface = SurfaceDescriptor { material: Some(Material::Skin.number()), ..Default::default() };
    let objects: [Object; 1] =
        [Object::new(&gpu.device, &gpu.queue, geometry, &surface).expect("no textures")];
    renderer.prepare(&gpu.queue, &frame(4)).expect("resized above");

    let mut group = criterion.benchmark_group("passes/1280x720");
    let mut bench = |name: &str, record: &Record<'_>| {
        group.bench_function(name, |bencher| {
            bencher.iter_custom(|count| (0..count).map(|_| gpu.time(record)).sum());
        });
    };
    bench("shadow", &|encoder| renderer.shadow.encode(encoder, &objects));
    bench("G-buffer", &|encoder| renderer.gbuffer.encode(encoder, &objects, &targets));
    for taps in [4, 8, 16] {
        renderer.prepare(&gpu.queue, &frame(taps)).expect("resized above");
        bench(&format!("subsurface, {taps} taps"), &|encoder| {
            renderer.subsurface.encode(encoder, &diffused.view)
        });
    }
    bench("composite", &|encoder| renderer.composite.encode(encoder, &output.view));
    group.finish();
    criterion.final_summary();
}
