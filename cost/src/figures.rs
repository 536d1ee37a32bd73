//! The figures of one stage on one GPU.

use serde::{Deserialize, Serialize};
use subsurface_kernel::Estimator;

use crate::Failure;
use crate::family::Family;
use crate::loads::Loads;
use crate::loops::{Loop, Rounds, extrapolated, loops, written_out};
use crate::radv::{Radv, Statistics};
use crate::spirv;
use crate::stage::{Reached, Stage};
use naga::valid::{Capabilities, ValidationFlags, Validator};
use naga::{Module, ShaderStage};

/// What a compiler makes of a stage.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Figures {
    /// The GPU.
    pub(crate) gpu: Family,
    /// The kernel, as the header of its module has it.
    pub(crate) kernel: String,
    /// The entry point.
    pub(crate) stage: String,
    /// Pixels of the frame that an invocation stands for.
    pub(crate) pixels: f64,
    /// Vector registers of an invocation.
    pub(crate) vgprs: u32,
    /// Those that went to memory.
    pub(crate) spilled_vgprs: u32,
    /// Scalar registers of a wave.
    pub(crate) sgprs: u32,
    /// Those that went to vector registers.
    pub(crate) spilled_sgprs: u32,
    /// Waves that a SIMD can hold at once.
    pub(crate) waves: u32,
    /// Workgroup memory, bytes.
    pub(crate) lds_bytes: u32,
    /// Machine code, bytes.
    pub(crate) code_bytes: u32,
    /// Machine instructions.
    pub(crate) instructions: u32,
    /// Cycles that a pixel takes of a SIMD that is kept busy, as the compiler estimates them, with all taps; `None` where
    /// the number of taps is the scene's.
    pub(crate) cycles_per_pixel: Option<f64>,
    /// Texels and elements of storage buffers that a pixel loads, with all taps.
    pub(crate) loads_per_pixel: Option<f64>,
    /// Their bytes.
    pub(crate) bytes_per_pixel: Option<f64>,
}

/// Cycles of a SIMD per wave, if enough waves are there.
const THROUGHPUT: &str = "Inverse Throughput";

impl Figures {
    /// Asks the driver.
    pub(crate) fn of(
        radv: &Radv,
        gpu: Family,
        stage: &Stage,
        vertex: Option<&Stage>,
    ) -> Result<Self, Failure> {
        let whole = compile(radv, stage, &stage.module, vertex)?;
        let number = |name: &str| whole.get(name).copied().unwrap_or(0.0);
        let whole_number = |name: &str| number(name) as u32;
        let reached = Reached::of(stage);
        let loops = loops(&stage.module, &reached);
        let rounds: Option<Vec<Rounds>> = loops
            .iter()
            .map(|own| own.rounds(stage.estimator))
            .collect::<Result<Option<Vec<_>>, Failure>>()?;
        let pixels = stage.pixels;
        let cycles = match &rounds {
            None => None,
            Some(rounds) => {
                let per_wave =
                    extrapolated(rounds, |copies| throughput(radv, stage, vertex, &loops, copies))?;
                Some(rounded(per_wave / number("Subgroup size") / pixels))
            }
        };
        let loads = Loads::of(stage)?.map(|loads| loads.times(1.0 / pixels));
        Ok(Self {
            gpu,
            kernel: stage.estimator.to_string(),
            stage: stage.entry_point.clone(),
            pixels: stage.pixels,
            vgprs: whole_number("VGPRs"),
            spilled_vgprs: whole_number("Spilled VGPRs"),
            sgprs: whole_number("SGPRs"),
            spilled_sgprs: whole_number("Spilled SGPRs"),
            waves: whole_number("Subgroups per SIMD"),
            lds_bytes: whole_number("LDS size"),
            code_bytes: whole_number("Code size"),
            instructions: whole_number("Instructions"),
            cycles_per_pixel: cycles,
            loads_per_pixel: loads.map(|loads| rounded(loads.count)),
            bytes_per_pixel: loads.map(|loads| rounded(loads.bytes)),
        })
    }
}

/// Two digits behind the point: what a table shows, so that a file does not change for less.
fn rounded(value: f64) -> f64 {
    (value * 100.0).round() / 100.0
}

/// The throughput of a stage whose loops run that often.
fn throughput(
    radv: &Radv,
    stage: &Stage,
    vertex: Option<&Stage>,
    loops: &[Loop],
    copies: &[u32],
) -> Result<f64, Failure> {
    let copies: Vec<(Loop, u32)> = loops.iter().cloned().zip(copies.iter().copied()).collect();
    let module = written_out(&stage.module, &copies)?;
    let statistics = compile(radv, stage, &module, vertex)?;
    Ok(statistics.get(THROUGHPUT).copied().unwrap_or(0.0))
}

fn compile(
    radv: &Radv,
    stage: &Stage,
    module: &Module,
    vertex: Option<&Stage>,
) -> Result<Statistics, Failure> {
    let info = Validator::new(ValidationFlags::all(), Capabilities::all())
        .validate(module)
        .map_err(|error| Failure::Naga(stage.entry_point.clone(), error.emit_to_string("")))?;
    let words = spirv::words(module, &info, &stage.entry_point, stage.kind)?;
    let vertex = match vertex.filter(|_| stage.kind == ShaderStage::Fragment) {
        Some(vertex) => Some((vertex.entry_point.as_str(), spirv::of(vertex)?)),
        None => None,
    };
    let vertex = vertex.as_ref().map(|(name, words)| (*name, words.as_slice()));
    radv.compile(stage, &info, &words, vertex)
}

/// The sum of a path's stages: what a translucent pixel costs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Total {
    pub(crate) cycles: Option<f64>,
    pub(crate) loads: Option<f64>,
    pub(crate) bytes: Option<f64>,
}

impl Total {
    /// Of the stages of `estimator` on `gpu` that end in `suffix`, all of which run for a translucent pixel.
    pub(crate) fn of(figures: &[Figures], gpu: Family, estimator: Estimator, suffix: &str) -> Self {
        let kernel = estimator.to_string();
        let own: Vec<&Figures> = figures
            .iter()
            .filter(|own| own.gpu == gpu && own.kernel == kernel && own.stage.ends_with(suffix))
            // One copies what does not scatter; one stands in for another on software drivers.
            .filter(|own| {
                !["passthrough_fragment", "subsurface_software_compute"].contains(&own.stage.as_str())
            })
            .collect();
        let sum = |of: fn(&Figures) -> Option<f64>| own.iter().map(|own| of(own)).sum::<Option<f64>>();
        Self {
            cycles: sum(|own| own.cycles_per_pixel),
            loads: sum(|own| own.loads_per_pixel),
            bytes: sum(|own| own.bytes_per_pixel),
        }
    }
}
