//! `subsurface bench`.

use super::diffuse::read;
use super::kernel::RouteArguments;
use super::render::DEFAULT_MATERIAL;
use super::view::{MeshArguments, load_scene};
use super::{material_set, number, output};
use crate::draw::PixelScale;
use crate::draw::device::Device;
use crate::failure::Failure;
use crate::kernel_bench::{
    self, Case, Contender, KernelContender, Options, Report, SceneCases, Subject, YARDSTICK, figure, table,
};
use crate::picture::file;
use crate::plot::FigureFile;
use crate::say;
use crate::scene::camera::{Size, Triple};
use clap::{Args, Parser, Subcommand, value_parser};
use std::ffi::OsString;
use std::path::PathBuf;
use subsurface_codegen::{Compilation, Estimator};
use subsurface_runtime::Path;

/// Measure kernels and pictures: errors and times side by side.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  subsurface bench kernels
  subsurface bench kernels --size 1920x1080 --csv kernels.csv --plot kernels.svg
  subsurface bench pictures --sheet pictures.png")]
pub struct BenchArguments {
    /// What to measure.
    #[command(subcommand)]
    pub command: BenchCommand,
}

/// What to measure.
#[derive(Debug, Subcommand)]
pub enum BenchCommand {
    /// Error against the dense kernel and time per frame, for every kernel and number of taps.
    ///
    /// Scenes are drawn once for each footprint: the pixels that the mean radius of the material's widest channel
    /// spans. With --input alone only that G-buffer is diffused. The error is over translucent pixels, against the
    /// kernel `dense` with the same profile. The time is that of the subsurface pass alone, from submission until the device
    /// is idle, as a ratio to importance-sampled with 17 taps in the same run: rounds in which every kernel runs once,
    /// and the median of the ratios. A second estimator bears witness to the reference; where they differ, a line warns.
    Kernels(Box<KernelsArguments>),
    /// Error of pictures against a path tracer's: by profile model, and by cause.
    ///
    /// A truth is a scene that `subsurface export` wrote and reference/pictures/render.py rendered. Each is drawn with the
    /// variants of its material, four by four pixels for one, and compared as `subsurface compare` does.
    Pictures(super::pictures::PicturesArguments),
}

/// Arguments of `subsurface bench kernels`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  subsurface bench kernels
  subsurface bench kernels --mesh head.glb --footprints 5 --kernel interleaved:4
  subsurface bench kernels --profile burley_searchlight --size 1920x1080 --plot kernels.svg
  subsurface bench kernels --input gbuffer.exr --fov-y-degrees 14 --white 3 --csv kernels.csv")]
pub struct KernelsArguments {
    /// Directory of materials: one .ron file each, profiles in DIR/profiles.
    #[arg(long, value_name = "DIR", default_value = material_set::DEFAULT_DIRECTORY)]
    pub materials: PathBuf,
    /// Material of the set.
    #[arg(long, value_name = "NAME", default_value = DEFAULT_MATERIAL)]
    pub material: String,
    /// Measure with this profile too, in place of the material's own: the stem of a file in DIR/profiles. May be given
    /// several times.
    #[arg(long = "profile", value_name = "STEM")]
    pub profiles: Vec<String>,
    /// Estimator and taps, as in `subsurface render --kernel`. May be given several times; by default 14 of them.
    #[arg(long = "kernel", value_name = "NAME[:TAPS]", value_parser = contender)]
    pub kernels: Vec<Estimator>,
    /// What is drawn.
    #[command(flatten)]
    pub mesh: MeshArguments,
    /// The point in the middle of the pictures, in metres; by default the middle of the scene, of the bust its cheek.
    #[arg(long, value_name = "x,y,z", allow_hyphen_values = true)]
    pub target: Option<Triple>,
    /// Size of the pictures in pixels.
    #[arg(long, value_name = "WxH", default_value = "192x240")]
    pub size: Size,
    /// Pixels that the mean radius of the widest channel spans: one picture each. By default 1.5,5,15, or no picture
    /// where --input is given without --mesh.
    #[arg(long, value_name = "PX,PX,…", value_delimiter = ',', value_parser = number::footprint_pixels, allow_hyphen_values = true)]
    pub footprints: Vec<f64>,
    /// Buffers as `subsurface diffuse` reads them. May be given several times.
    #[arg(long = "input", value_name = "IN.exr", requires = "InputScale")]
    pub inputs: Vec<PathBuf>,
    /// How large a pixel of the inputs is.
    #[command(flatten)]
    pub scale: InputScale,
    /// Give every pixel the material's own surface albedo in place of what textures and inputs say: published methods
    /// know one profile per object.
    #[arg(long)]
    pub uniform_albedo: bool,
    /// How often each kernel is timed.
    #[arg(long, value_name = "N", default_value_t = 7, value_parser = value_parser!(u32).range(1..=1000))]
    pub repeats: u32,
    /// Irradiance that PSNR is relative to; by default the largest value of each reference picture.
    #[arg(long, value_name = "X", value_parser = number::white, allow_hyphen_values = true)]
    pub white: Option<f64>,
    /// Which shaders diffuse.
    #[command(flatten)]
    pub route: RouteArguments,
    /// Also write all numbers as CSV, unrounded; `-` prints that in place of the tables.
    #[arg(long, value_name = "FILE.csv")]
    pub csv: Option<PathBuf>,
    /// Draw PSNR over time, .svg or .png; of several profiles, a file for each with the profile's name added.
    #[arg(long, value_name = "FILE.svg|.png", value_parser = FigureFile::parse)]
    pub plot: Option<FigureFile>,
}

/// How large a pixel of the inputs is: one of the two, with --input.
#[derive(Debug, Args)]
#[group(multiple = false)]
pub struct InputScale {
    /// Inputs in orthographic view: millimetres that a pixel covers.
    #[arg(long, value_name = "X", value_parser = number::pixel_mm, allow_hyphen_values = true, requires = "inputs")]
    pub mm_per_pixel: Option<f32>,
    /// Inputs in perspective view: vertical field of view in degrees.
    #[arg(long, value_name = "D", value_parser = number::fov_y_degrees, allow_hyphen_values = true, requires = "inputs")]
    pub fov_y_degrees: Option<f32>,
}

/// Footprints when none are asked for, pixels.
const FOOTPRINTS: [f64; 3] = [1.5, 5.0, 15.0];

/// A point of the bust where the key light's shadow crosses the cheek (m).
const CHEEK: [f32; 3] = [0.0, 0.0, 0.09];

fn contender(text: &str) -> Result<Estimator, String> {
    match super::kernel::estimator(text)? {
        Estimator::Dense => Err("dense is what the others are held against, and always runs".into()),
        estimator => Ok(estimator),
    }
}

/// Runs the command.
pub fn run(arguments: &BenchArguments) -> Result<(), Failure> {
    match &arguments.command {
        BenchCommand::Kernels(arguments) => run_kernels(arguments, Vec::new()),
        BenchCommand::Pictures(arguments) => super::pictures::run(arguments),
    }
}

/// Arguments as `subsurface bench kernels` takes them, for a program that brings contenders of its own.
#[derive(Debug, Parser)]
#[command(name = "kernels", max_term_width = 100)]
struct KernelsProgram {
    #[command(flatten)]
    arguments: KernelsArguments,
}

impl KernelsArguments {
    /// From a command line without the program's name; exits with a message if it makes no sense.
    pub fn parse_or_exit(arguments: impl IntoIterator<Item = OsString>) -> Self {
        KernelsProgram::parse_from(std::iter::once(OsString::from("kernels")).chain(arguments)).arguments
    }
}

/// Runs `bench kernels` with contenders that are added to ours.
pub fn run_kernels(arguments: &KernelsArguments, more: Vec<Box<dyn Contender>>) -> Result<(), Failure> {
    if let Some(path) = &arguments.csv {
        output::check(path)?;
    }
    if let Some(plot) = &arguments.plot {
        file::folder_of(plot.path())?;
    }
    let compiler = material_set::compiler(&arguments.materials)?;
    let materials = material_set::finish(compiler.compile())?;
    let material = material_set::number(&materials, &arguments.material)?;
    let own = Subject::of_set(compiler, &materials, material)?;
    let mut subjects = vec![own.clone()];
    for stem in &arguments.profiles {
        subjects.push(own.with_profile(&materials, &arguments.materials, stem)?);
    }
    // Without an adapter, there is no point in sculpting.
    let device = Device::open()?;
    let prints_tables = arguments.csv.as_deref().is_none_or(|path| path.as_os_str() != "-");
    if prints_tables {
        say!("{}\n", device.description());
    }
    let mut cases = cases(arguments, &materials, &own)?;
    if arguments.uniform_albedo {
        cases.iter_mut().for_each(|case| case.buffers.surface_albedo = None);
    }
    let route = arguments.route.chosen();
    if route.shape.is_some() {
        let has_choice = arguments.kernels.iter().any(|kernel| kernel.has_software_shape());
        if route.path == Some(Path::Fragment) || !has_choice {
            return Err(Failure::new(
                "--shape: none of these kernels, on this path, shares its work in two ways",
                "leave out --shape, or take --path compute and a kernel `interleaved`",
            ));
        }
    }
    let contenders: Vec<Box<dyn Contender>> = ours(&arguments.kernels).chain(more).collect();
    let options = Options { rounds: arguments.repeats, route, white: arguments.white };
    let mut reports = Vec::new();
    for subject in &subjects {
        for case in &cases {
            let report = kernel_bench::run(&device, case, subject, &contenders, &options)?;
            if prints_tables {
                say!("{}", table::scores(&report));
            }
            reports.push(report);
        }
    }
    if prints_tables {
        output::print(&table::goals(&reports))?;
    }
    if let Some(path) = &arguments.csv {
        output::write(path, &Report::csv(&reports))?;
    }
    if let Some(plot) = &arguments.plot {
        draw(plot, &subjects, &reports)?;
    }
    Ok(())
}

/// Our kernels, the yardstick first.
fn ours(chosen: &[Estimator]) -> impl Iterator<Item = Box<dyn Contender>> {
    let mut kernels = if chosen.is_empty() { KernelContender::all() } else { chosen.to_vec() };
    kernels.retain(|kernel| *kernel != YARDSTICK);
    kernels.insert(0, YARDSTICK);
    kernels
        .into_iter()
        .map(|kernel| -> Box<dyn Contender> { Box::new(KernelContender { estimator: kernel }) })
}

/// The inputs, then the scene at its footprints.
fn cases(
    arguments: &KernelsArguments,
    materials: &Compilation,
    subject: &Subject,
) -> Result<Vec<Case>, Failure> {
    let mut cases = Vec::new();
    for path in &arguments.inputs {
        let InputScale { mm_per_pixel, fov_y_degrees } = arguments.scale;
        let scale = mm_per_pixel
            .map(PixelScale::MillimetresPerPixel)
            .or(fov_y_degrees.map(PixelScale::FovYDegrees))
            // clap has refused this already.
            .ok_or_else(|| {
                Failure::new("the inputs' scale is missing", "give --mm-per-pixel or --fov-y-degrees")
            })?;
        let buffers = read(path, subject.number(), materials.set.materials.len())?;
        let name = path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
        let case = Case { name, buffers, scale };
        if case.median_distance_mm().is_none() {
            let message = format!("{}: no pixel scatters, Z is 0 everywhere", path.display());
            return Err(Failure::new(message, "give distances in mm where there is a surface"));
        }
        cases.push(case);
    }
    let footprints = match &arguments.footprints[..] {
        [] if !arguments.inputs.is_empty() && arguments.mesh.mesh.is_none() => &[],
        [] => &FOOTPRINTS[..],
        given => given,
    };
    if footprints.is_empty() {
        return Ok(cases);
    }
    let scene = load_scene(&arguments.mesh)?;
    let mesh = arguments.mesh.mesh.as_deref();
    let name = mesh.map_or_else(
        || "bust".to_owned(),
        |path| path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned(),
    );
    let target = arguments.target.map(|Triple(target)| target);
    let target = target.or(mesh.is_none().then_some(CHEEK));
    let scene_cases = SceneCases { name: &name, scene: &scene, size: arguments.size, target };
    for footprint in footprints {
        cases.push(scene_cases.at_footprint(materials, subject, *footprint)?);
    }
    Ok(cases)
}

/// A figure per profile.
fn draw(plot: &FigureFile, subjects: &[Subject], reports: &[Report]) -> Result<(), Failure> {
    for (index, subject) in subjects.iter().enumerate() {
        let own: Vec<&Report> = reports.iter().filter(|report| report.profile == subject.name).collect();
        let title = format!("Kernels: error over time, {}", subject.name);
        let Some(figure) = figure::pareto(&title, &own) else { continue };
        let file = if index == 0 { plot.clone() } else { plot.with_suffix(&subject.name) };
        file.write(&figure)?;
        say!("{}", file.path().display());
    }
    Ok(())
}
