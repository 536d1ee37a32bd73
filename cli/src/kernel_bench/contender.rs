//! Who takes part.

use super::case::Case;
use super::goal::Goal;
use super::subject::Subject;
use crate::draw::device::Device;
use crate::draw::{Route, Uploaded, beyond_device, out_of_order, subsurface_pass};
use crate::failure::Failure;
use subsurface_codegen::{Compilation, Estimator, OutputFormat};
use subsurface_runtime::{FrameError, Path, SubsurfacePass, Target, wgpu};

/// What a contender is given.
#[derive(Clone, Copy, Debug)]
pub struct Stage<'a> {
    /// The device that draws.
    pub device: &'a Device,
    /// What is diffused.
    pub case: &'a Case,
    /// The material.
    pub subject: &'a Subject,
    /// The case's buffers on the device, with the subject's number.
    pub textures: &'a Uploaded,
    /// The shaders that are to diffuse.
    pub route: Route,
}

/// A way to diffuse irradiance in screen space.
pub trait Contender {
    /// Contenders of one family differ in their taps alone, and share a line in the figure.
    fn family(&self) -> String;

    /// Samples per pixel (of separable kernels: per pass).
    fn taps(&self) -> u32;

    /// What the default kernel has to reach against this contender, if anything.
    fn goal(&self) -> Option<Goal> {
        None
    }

    /// Makes everything ready for the stage, or says why this contender does not suit it.
    ///
    /// # Errors
    /// What the device refuses.
    fn enter(&self, stage: &Stage<'_>) -> Result<Entry, Failure>;
}

/// What comes of entering.
pub enum Entry {
    /// Ready to run.
    Runs(Box<dyn Run>),
    /// Not made for this; the reason.
    Declines(String),
}

/// A contender, ready to run.
pub trait Run {
    /// Records one frame. Submits nothing.
    ///
    /// # Errors
    /// A pass that is not ready, which is a defect.
    fn encode(&self, encoder: &mut wgpu::CommandEncoder) -> Result<(), FrameError>;

    /// Where the diffused irradiance lies after a frame: `Rgba16Float` or `Rgba32Float`.
    fn output(&self) -> &wgpu::Texture;

    /// The path that it takes.
    fn path(&self) -> Path;
}

/// One of our kernels.
#[derive(Clone, Copy, Debug)]
pub struct KernelContender {
    /// Its estimator.
    pub estimator: Estimator,
}

impl KernelContender {
    /// The kernels and taps that are compared when none are chosen, the yardstick first.
    pub fn all() -> Vec<Estimator> {
        let taps = |kind: Estimator| -> &'static [u32] {
            match kind {
                Estimator::ImportanceSampled { .. } => &[9, 33, 65],
                Estimator::Interleaved { .. } => &[1, 2, 3, 4, 6, 8, 16],
                Estimator::Separable { rotated: false, .. } => &[11, 17, 25],
                // Rotated axes are as fast; `Dense` is what the others are compared with.
                Estimator::Separable { rotated: true, .. } | Estimator::Dense => &[],
            }
        };
        let mut all = vec![super::YARDSTICK];
        // The yardstick's own kind first.
        let kinds = std::iter::once(super::YARDSTICK).chain(Estimator::ALL);
        let with_taps = kinds.flat_map(|kind| taps(kind).iter().map(move |taps| kind.with_taps(*taps)));
        for kernel in with_taps {
            if !all.contains(&kernel) {
                all.push(kernel);
            }
        }
        all
    }
}

impl Contender for KernelContender {
    fn family(&self) -> String {
        self.estimator.command_name().to_owned()
    }

    fn taps(&self) -> u32 {
        self.estimator.taps()
    }

    fn goal(&self) -> Option<Goal> {
        match self.estimator {
            Estimator::ImportanceSampled { taps: 17 | 33 } => Some(Goal::Faster),
            Estimator::Separable { taps: 17, .. } => Some(Goal::FasterAndCloser),
            _ => None,
        }
    }

    fn enter(&self, stage: &Stage<'_>) -> Result<Entry, Failure> {
        let format = OutputFormat::Rgba16Float;
        let materials = stage.subject.compile(self.estimator, format)?;
        Ok(Entry::Runs(Box::new(kernel_run(stage, &materials, format)?)))
    }
}

/// A kernel on a stage, with an output of `format`.
pub(super) fn kernel_run(
    stage: &Stage<'_>,
    materials: &Compilation,
    format: OutputFormat,
) -> Result<impl Run + use<>, Failure> {
    let format = match format {
        OutputFormat::Rgba32Float => wgpu::TextureFormat::Rgba32Float,
        _ => wgpu::TextureFormat::Rgba16Float,
    };
    let mut pass = subsurface_pass(stage.device, &materials.parts, format, stage.route)?;
    let device = stage.device;
    pass.bind(&device.device, &stage.textures.inputs()).map_err(|error| beyond_device(&error))?;
    pass.prepare(&device.queue, &stage.case.view()).map_err(out_of_order)?;
    let output = pass.create_output(&device.device).map_err(out_of_order)?;
    Ok(KernelRun { pass, output })
}

struct KernelRun {
    pass: SubsurfacePass,
    output: Target,
}

impl Run for KernelRun {
    fn encode(&self, encoder: &mut wgpu::CommandEncoder) -> Result<(), FrameError> {
        self.pass.encode(encoder, &self.output.view)
    }

    fn output(&self) -> &wgpu::Texture {
        &self.output.texture
    }

    fn path(&self) -> Path {
        self.pass.path()
    }
}
