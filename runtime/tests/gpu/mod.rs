//! The device that tests run on, and how they read textures and buffers back.

#![allow(dead_code, unreachable_pub, reason = "each test binary uses its own part of this module")]

pub mod ball;
mod evaluation;

use subsurface_codegen::{Compilation, Compiler, OutputFormat};
use subsurface_profile::description::Notation;
use subsurface_profile::{Channel, Medium, Model, ModelKind};
use subsurface_runtime::{Extent, FrameError, KernelParts, LoadedKernel, Readback, Target, wgpu};

/// A device and its queue.
pub struct Gpu {
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
}

impl Gpu {
    /// Opens the first adapter. A machine without one fails the test: it never skips.
    pub fn open() -> Self {
        Self::with_limits(wgpu::Limits::default())
    }

    /// The same with other limits than WebGPU's.
    pub fn with_limits(limits: wgpu::Limits) -> Self {
        Self::with(limits, wgpu::Features::empty())
    }

    /// The same with other limits than WebGPU's, and with features that the adapter must have.
    pub fn with(limits: wgpu::Limits, features: wgpu::Features) -> Self {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
        let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))
            .expect("no graphics adapter: run `cargo xtask test`, or install mesa-vulkan-drivers");
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("test device"),
            required_features: features,
            required_limits: limits.using_resolution(adapter.limits()),
            ..Default::default()
        }))
        .expect("the adapter refuses a device with these limits");
        Self { device, queue }
    }

    /// Runs `body` and fails on any validation error.
    pub fn validated<T>(&self, body: impl FnOnce() -> T) -> T {
        let scope = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let value = body();
        if let Some(error) = pollster::block_on(scope.pop()) {
            panic!("validation error: {error}");
        }
        value
    }

    /// A kernel on this device.
    pub fn load(&self, parts: &KernelParts) -> LoadedKernel {
        LoadedKernel::new(&self.device, &self.queue, parts).expect("the kernel is small")
    }

    /// Submits what `record` records.
    pub fn submit(&self, record: impl FnOnce(&mut wgpu::CommandEncoder) -> Result<(), FrameError>) {
        let mut encoder = self.device.create_command_encoder(&Default::default());
        record(&mut encoder).expect("the pass is bound and prepared");
        self.queue.submit([encoder.finish()]);
    }

    /// A texture of four f32 per pixel.
    pub fn rgba32(&self, size: [u32; 2], pixel: impl Fn(u32, u32) -> [f32; 4]) -> wgpu::TextureView {
        self.texture(size, wgpu::TextureFormat::Rgba32Float, bytemuck::cast_slice(&texels(size, pixel)))
    }

    /// A texture of one f32 per pixel.
    pub fn r32(&self, size: [u32; 2], pixel: impl Fn(u32, u32) -> f32) -> wgpu::TextureView {
        self.texture(size, wgpu::TextureFormat::R32Float, bytemuck::cast_slice(&texels(size, pixel)))
    }

    /// A texture of `bytes`, rows from the top.
    pub fn texture(
        &self,
        [width, height]: [u32; 2],
        format: wgpu::TextureFormat,
        bytes: &[u8],
    ) -> wgpu::TextureView {
        let size = Extent::new(width, height);
        let made = Target::from_texels(&self.device, &self.queue, size, format, "test input", bytes);
        made.expect("the texels fit the size").view
    }

    /// Bytes of a texture, row by row without padding.
    pub fn read_texture(&self, texture: &wgpu::Texture) -> Vec<u8> {
        let mut encoder = self.device.create_command_encoder(&Default::default());
        let readback = Readback::record(&self.device, &mut encoder, texture);
        self.queue.submit([encoder.finish()]);
        readback.wait(&self.device).expect("the device answers")
    }

    /// Bytes of a buffer that can be mapped.
    pub fn map(&self, buffer: &wgpu::Buffer) -> Vec<u8> {
        buffer.map_async(wgpu::MapMode::Read, .., |result| result.expect("mapping a readback buffer"));
        self.device.poll(wgpu::PollType::wait_indefinitely()).expect("the device answers");
        let mapped = buffer.get_mapped_range(..);
        #[cfg(feature = "wgpu-30")]
        let mapped = mapped.expect("mapped above");
        mapped.to_vec()
    }
}

/// Compiles material files in memory; the compute path of the result writes `Rgba32Float`.
pub fn compile(files: &[(&str, &str)]) -> Compilation {
    Compiler::from_memory(files.iter().map(|(path, text)| (*path, *text)))
        .output_format(OutputFormat::Rgba32Float)
        .compile()
        .unwrap_or_else(|report| panic!("{report}"))
}

/// Every profile that the device can evaluate: the published ones, and one of each model that has none, called by it.
pub fn stems() -> Vec<&'static str> {
    let unpublished = ModelKind::ALL.iter().filter(|kind| kind.published().is_empty());
    Model::PUBLISHED.into_iter().chain(unpublished.map(|kind| kind.description().stem)).collect()
}

/// Files of the profiles of models that have none published: their own examples, but for the table.
pub fn example_files() -> impl Iterator<Item = (String, String)> {
    let unpublished = ModelKind::ALL.iter().filter(|kind| kind.published().is_empty());
    let descriptions = unpublished.map(|kind| kind.description());
    descriptions
        .filter(|description| description.notation != Notation::Table)
        .map(|description| (format!("profiles/{}.ron", description.stem), description.example.to_owned()))
}

/// The files of the profile `tabulated`: another profile by bins, at surface albedos with radii of their own.
pub fn table_files() -> [(String, String); 2] {
    let model = Model::published("exponential_dipole_searchlight").expect("a published stem");
    let mut csv = String::from("surface_albedo,r_lo,r_hi,radial_reflectance\n");
    for (surface_albedo, end) in [(0.05, 20.0), (0.4, 60.0), (0.8, 60.0), (0.97, 200.0)] {
        let medium = Medium::new(surface_albedo, 1.0).expect("in the domain");
        let profile = model.profile(medium, Channel::Red).expect("a published model");
        let edge = |bin: i32| end * (f64::from(bin) / 70.0).powi(3);
        for bin in 0..70 {
            let (r_lo, r_hi) = (edge(bin), edge(bin + 1));
            let energy = surface_albedo * (profile.radial_tail(r_lo) - profile.radial_tail(r_hi));
            csv += &format!("{surface_albedo},{r_lo:?},{r_hi:?},{:?}\n", energy / (r_hi - r_lo));
        }
    }
    let profile = "Tabulated(file: \"tables/mine.csv\")".to_owned();
    [("profiles/tabulated.ron".to_owned(), profile), ("profiles/tables/mine.csv".to_owned(), csv)]
}

/// Files of profiles that tests alone use.
pub fn test_profile_files() -> impl Iterator<Item = (String, String)> {
    let files = [
        ("exponentials_alone.ron", exponentials_alone()),
        ("many_gaussians.ron", gaussians(70)),
        ("mixture_of_mixtures.ron", mixture_of_mixtures()),
        ("short_table.ron", "Tabulated(file: \"tables/short.csv\")".to_owned()),
        ("tables/short.csv", "r_lo,r_hi,radial_reflectance\n0,0.5,0.6\n0.5,2,0.2\n2,6,0.05\n".to_owned()),
        ("two_gaussians.ron", gaussians(2)),
    ];
    files.into_iter().map(|(file, text)| (format!("profiles/{file}"), text)).chain(example_files())
}

/// Parts with lengths of their own, in mm, and parts that the mean free path scales, some of them in a mixture within.
fn mixture_of_mixtures() -> String {
    let within =
        "Mixture([(3, Polynomial(coefficients: Liang2023)), (1, TwoExponentialDipole(entry: Diffuse))])";
    format!(
        "Mixture([(0.2, {}), (0.4, {within}), (0.3, Dipole(medium: Marble)), (0.1, Tabulated(file: \
         \"tables/short.csv\"))])",
        gaussians(3)
    )
}

/// No share of the light for a dipole that would reach far.
fn exponentials_alone() -> String {
    "TwoExponentialDipole(exponential_weight: (1, 0, 0, 0), exponential_length: (10, 0, 0, 0), \
     dipole_depth: (1000, 0, 0, 0), dipole_attenuation: (0, 0, 0, 0), short_weight: 0.9, short_length: 0.01, \
     second_weight: 0, second_depth: 2)"
        .to_owned()
}

/// A sum of so many terms, with weights of their own in each channel.
fn gaussians(terms: u32) -> String {
    let terms = (0..terms).map(|index| {
        let variance = 0.01 * 1.1_f64.powf(f64::from(index));
        let [red, green, blue] = [7, 5, 3].map(|period| 0.01 + 0.01 * f64::from(index % period));
        format!("(variance_mm2: {variance}, weight: ({red}, {green}, {blue}))")
    });
    format!("GaussianSum([{}])", terms.collect::<Vec<_>>().join(", "))
}

/// The model of one of [`stems`], or of [`test_profile_files`], in f64.
pub fn model(stem: &str) -> Model {
    Model::published(stem).unwrap_or_else(|| {
        let material = format!(
            "Material(profile: {stem:?}, mean_free_path_mm: (1, 1, 1), surface_albedo: (0.5, 0.5, 0.5))"
        );
        let files =
            table_files().into_iter().chain(test_profile_files()).chain([("only.ron".to_owned(), material)]);
        let loaded = subsurface_codegen::load_memory(files);
        let set = loaded.set.unwrap_or_else(|| panic!("{}", loaded.report));
        set.materials[0].profile.model.clone()
    })
}

/// One value per pixel, rows from the top.
fn texels<T>([width, height]: [u32; 2], pixel: impl Fn(u32, u32) -> T) -> Vec<T> {
    (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| pixel(x, y)).collect()
}
