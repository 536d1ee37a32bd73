//! `cargo xtask shader-cost`: what GPU compilers make of the kernels, on a machine without a GPU.
//!
//! Mesa's RADV compiles for AMD GPUs that are not there, and tells registers, occupancy, code size and its own estimate of
//! the cycles. Loads are counted in the IR. A process asks for one GPU, since the driver reads the name of the family
//! from the environment once; so the command runs itself once for each.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a command line speaks to its user")]

mod blessed;
mod copy;
mod failure;
mod family;
mod figures;
mod loads;
mod loops;
mod radv;
mod spirv;
mod stage;
mod table;

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

use clap::Parser;
use naga::ShaderStage;
use subsurface_codegen::Compiler;
use subsurface_kernel::Estimator;

use blessed::Measured;
use failure::{Failure, MISSING};
use family::Family;
use figures::Figures;
use radv::Radv;
use stage::Stage;

/// What GPU compilers make of the kernels: registers, spills, occupancy, estimated cycles, loads.
///
/// Needs no GPU: Mesa's RADV compiles for AMD GPUs that are not there. Cycles are the compiler's static estimate of what
/// a pixel takes of a SIMD, loads are counted, both with all taps of the kernel.
#[derive(Debug, Parser)]
#[command(
    name = "shader-cost",
    bin_name = "cargo xtask shader-cost",
    after_help = "\
Exit status: 1 figures differ, or an error; 3 they were accepted with another version of Mesa; 4 there is no RADV.

Examples:
  cargo xtask shader-cost
  cargo xtask shader-cost --gpu navi21 --gpu gfx1100 --kernel interleaved:4 --kernel separable:17
  cargo xtask shader-cost --materials my/materials --json cost.json
  cargo xtask shader-cost --check"
)]
struct Arguments {
    /// Directory of materials: the set whose kernels are compiled.
    #[arg(long, value_name = "DIR", default_value = "materials")]
    materials: PathBuf,
    /// A GPU; may be given several times, all by default.
    #[arg(long = "gpu", value_name = "FAMILY")]
    gpus: Vec<Family>,
    /// A kernel, with its taps behind a colon; may be given several times, all by default.
    #[arg(long = "kernel", value_name = "NAME[:TAPS]")]
    kernels: Vec<Estimator>,
    /// Write the figures to a file too.
    #[arg(long, value_name = "FILE.json")]
    json: Option<PathBuf>,
    /// Fail where a figure differs by more than 5 % from the accepted ones.
    #[arg(long, conflicts_with_all = ["bless", "materials", "gpus", "kernels"])]
    check: bool,
    /// Accept the figures of the presets: all kernels, all GPUs.
    #[arg(long, conflicts_with_all = ["materials", "gpus", "kernels"])]
    bless: bool,
    /// Print the figures of one GPU, which the environment names, as JSON: how the command runs itself.
    #[arg(long, hide = true)]
    only: Option<Family>,
}

/// The accepted figures, from the root.
const BLESSED: &str = "cost/blessed.json";

/// Where Vulkan's loader looks for drivers.
const DRIVERS: [&str; 3] = ["/usr/share/vulkan/icd.d", "/usr/local/share/vulkan/icd.d", "/etc/vulkan/icd.d"];

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    match run(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("error: {failure}");
            ExitCode::from(failure.exit_code())
        }
    }
}

fn run(arguments: &Arguments) -> Result<(), Failure> {
    let kernels =
        if arguments.kernels.is_empty() { Estimator::ALL.to_vec() } else { arguments.kernels.clone() };
    if let Some(gpu) = arguments.only {
        let measured = measure(gpu, &arguments.materials, &kernels)?;
        let text = serde_json::to_string(&measured);
        println!("{}", text.map_err(|error| child(gpu, error.to_string()))?);
        return Ok(());
    }
    let gpus = if arguments.gpus.is_empty() { Family::ALL.to_vec() } else { arguments.gpus.clone() };
    let mut all = Measured { compiler: String::new(), figures: Vec::new() };
    for &gpu in &gpus {
        eprintln!("Compiling for {} …", gpu.name());
        let measured = ask(gpu, arguments)?;
        all.compiler = measured.compiler;
        all.figures.extend(measured.figures);
    }
    println!("{}\n", all.compiler);
    print!("{}", table::render(&all.figures, &gpus, &kernels));
    if let Some(path) = &arguments.json {
        all.write(path)?;
    }
    if arguments.bless {
        all.write(Path::new(BLESSED))?;
    }
    if arguments.check { all.check(Path::new(BLESSED)) } else { Ok(()) }
}

/// Runs this program for one GPU.
fn ask(gpu: Family, arguments: &Arguments) -> Result<Measured, Failure> {
    let program = std::env::current_exe().map_err(|error| child(gpu, error.to_string()))?;
    let mut command = Command::new(program);
    command.arg("--only").arg(gpu.name()).arg("--materials").arg(&arguments.materials);
    for kernel in &arguments.kernels {
        let taps = kernel.tap_counts().map(|_| format!(":{}", kernel.taps())).unwrap_or_default();
        command.arg("--kernel").arg(format!("{}{taps}", kernel.command_name()));
    }
    command.env("RADV_FORCE_FAMILY", gpu.name()).env("MESA_SHADER_CACHE_DISABLE", "true");
    if let Some(driver) = driver().filter(|_| std::env::var_os("VK_DRIVER_FILES").is_none()) {
        command.env("VK_DRIVER_FILES", driver);
    }
    let output = command.output().map_err(|error| child(gpu, error.to_string()))?;
    if !output.status.success() {
        let why = String::from_utf8_lossy(&output.stderr);
        let why = why.trim_start_matches("error: ").trim_end().to_owned();
        let is_missing = output.status.code() == Some(i32::from(MISSING));
        return Err(if is_missing { Failure::Missing(why) } else { child(gpu, why) });
    }
    serde_json::from_slice(&output.stdout).map_err(|error| child(gpu, error.to_string()))
}

fn child(gpu: Family, why: String) -> Failure {
    Failure::Child { family: gpu.name(), why }
}

/// RADV's description for the loader.
fn driver() -> Option<PathBuf> {
    let files = DRIVERS.iter().filter_map(|folder| std::fs::read_dir(folder).ok()).flatten().flatten();
    let mut found: Vec<PathBuf> = files
        .map(|file| file.path())
        .filter(|path| path.file_name().is_some_and(|name| name.to_string_lossy().starts_with("radeon_icd")))
        .collect();
    found.sort();
    // Where a machine has those of two word sizes, the longer one is ours: x86_64 before i686 by its name.
    found.into_iter().next_back()
}

/// Compiles every stage for one GPU.
fn measure(gpu: Family, materials: &Path, kernels: &[Estimator]) -> Result<Measured, Failure> {
    let radv = Radv::open()?;
    let mut figures = Vec::new();
    for &kernel in kernels {
        let compilation = Compiler::new(materials)
            .estimator(kernel)
            .compile()
            .map_err(|report| Failure::Materials(report.to_string()))?;
        let stages = Stage::all(kernel, compilation.wgsl())?;
        let vertex = stages.iter().find(|stage| stage.kind == ShaderStage::Vertex);
        for stage in stages.iter().filter(|stage| stage.kind != ShaderStage::Vertex) {
            figures.push(Figures::of(&radv, gpu, stage, vertex)?);
        }
    }
    Ok(Measured { compiler: radv.version().to_owned(), figures })
}
