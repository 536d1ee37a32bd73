//! Kernels side by side: how far each is from [`Dense`](subsurface_codegen::Estimator::Dense), and how long it takes.
//!
//! A [`Contender`] enters a [`Stage`], which is a [`Case`] (buffers, seen at some scale) with a [`Subject`] (a material
//! and its profile), and comes out with a [`Score`]: root mean square error and PSNR over the translucent pixels
//! against `Dense` with the same profile, and its time as a ratio to the yardstick, `ImportanceSampled` with 17 taps,
//! in the same run. [`run`] takes contenders from anybody, so that a benchmark may add its own.

pub mod case;
pub mod contender;
pub mod figure;
pub mod goal;
mod measure;
pub mod outcome;
pub mod report;
pub mod scene_case;
pub mod score;
pub mod subject;
pub mod table;

pub use case::Case;
pub use contender::{Contender, Entry, KernelContender, Run, Stage};
pub use goal::Goal;
pub use report::{Declined, Line, Report};
pub use scene_case::SceneCases;
pub use score::Score;
pub use subject::Subject;

use crate::draw::device::Device;
use crate::draw::{Precision, Route, Uploaded};
use crate::failure::Failure;
use crate::progress::bar;
use std::time::{Duration, Instant};
use subsurface_codegen::{Estimator, OutputFormat};

/// The kernel whose time counts as 1.
pub const YARDSTICK: Estimator = Estimator::ImportanceSampled { taps: 17 };

/// The kernel that bears witness to the reference: another estimator of the same sum, with taps enough to be close.
pub const WITNESS: Estimator = Estimator::ImportanceSampled { taps: 1024 };

/// How to measure.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// How often each contender is timed, ≥ 1; the median counts.
    pub rounds: u32,
    /// The shaders of every contender; a shape counts for those that have two.
    pub route: Route,
    /// Irradiance whose square PSNR is relative to; `None` for the largest in each reference picture.
    pub white: Option<f64>,
}

/// Lets every contender run on one case with one subject. The first contender must be the yardstick.
pub fn run(
    device: &Device,
    case: &Case,
    subject: &Subject,
    contenders: &[Box<dyn Contender>],
    options: &Options,
) -> Result<Report, Failure> {
    let rounds = options.rounds.max(1);
    let steps = 1 + contenders.len() as u64 * u64::from(1 + rounds);
    let progress = bar(steps, format!("{}, {}: dense", case.name, subject.name));
    // The reference alone may take minutes.
    progress.enable_steady_tick(Duration::from_millis(200));
    let (reference, dense_ms) = single_picture(device, case, subject, options, Estimator::Dense)?;
    progress.set_message(format!("{}, {}: witness", case.name, subject.name));
    let (witness, _) = single_picture(device, case, subject, options, WITNESS)?;
    progress.inc(1);

    let materials = subject.compile(YARDSTICK, OutputFormat::Rgba16Float)?;
    let textures = Uploaded::new(device, &case.buffers_of(subject), &materials, Precision::Half)?;
    let stage = Stage { device, case, subject, textures: &textures, route: options.route };
    let pixels = case.translucent();
    let white = options.white.unwrap_or_else(|| score::largest(&reference, &pixels));
    let (mut lines, mut runs, mut declined) = (Vec::new(), Vec::new(), Vec::new());
    for contender in contenders {
        let (family, taps) = (contender.family(), contender.taps());
        progress.set_message(format!("{}, {}: {family} {taps}", case.name, subject.name));
        let entry = device.checked(|| contender.enter(&stage))?;
        match entry {
            Entry::Declines(reason) => declined.push(Declined { family, taps, reason }),
            Entry::Runs(run) => {
                let picture = device.checked(|| measure::picture(device, &*run))?;
                let score = Score::of(&picture, &reference, &pixels, white);
                lines.push(Line {
                    family,
                    taps,
                    goal: contender.goal(),
                    path: run.path(),
                    score,
                    time: None,
                });
                runs.push(run);
            }
        }
        progress.inc(1);
    }
    progress.set_message(format!("{}, {}: rounds", case.name, subject.name));
    let times = device.checked(|| measure::times(device, &runs, rounds, || progress.inc(1)))?;
    for (line, time) in lines.iter_mut().zip(times) {
        line.time = Some(time);
    }
    progress.finish_and_clear();
    Ok(Report {
        case: case.name.clone(),
        profile: subject.name.clone(),
        adapter: device.description(),
        size: case.buffers.size,
        translucent_pixels: pixels.len(),
        mean_radius_mm: subject.mean_radius_mm(),
        millimetres_per_pixel: case.millimetres_per_pixel(),
        white,
        dense_ms,
        witness_taps: subject.taps_within(case.millimetres_per_pixel(), WITNESS.taps()),
        witness_db: Score::of(&witness, &reference, &pixels, white).psnr_db,
        lines,
        declined,
    })
}

/// A picture in full precision, and the milliseconds that it took.
fn single_picture(
    device: &Device,
    case: &Case,
    subject: &Subject,
    options: &Options,
    kernel: Estimator,
) -> Result<(Vec<[f32; 4]>, f64), Failure> {
    let format = OutputFormat::Rgba32Float;
    let materials = subject.compile(kernel, format)?;
    let textures = Uploaded::new(device, &case.buffers_of(subject), &materials, Precision::Half)?;
    let stage = Stage { device, case, subject, textures: &textures, route: options.route };
    device.checked(|| {
        let start = Instant::now();
        let run = contender::kernel_run(&stage, &materials, format)?;
        let picture = measure::picture(device, &run)?;
        Ok((picture, start.elapsed().as_secs_f64() * 1e3))
    })
}
