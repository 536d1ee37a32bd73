//! Pictures and times of contenders.

use super::contender::Run;
use super::report::Time;
use crate::draw::device::Device;
use crate::draw::out_of_order;
use crate::failure::Failure;
use std::time::Instant;
use subsurface_runtime::wgpu;

/// Seconds that a sample should last: well above the cost of a submission, which is some tens of microseconds.
const SAMPLE_SECONDS: f64 = 0.025;

/// Frames that fit one submission, however short they are.
const LARGEST_FRAME_COUNT: u32 = 512;

/// Draws one frame and reads it back, rows from the top.
pub(super) fn picture(device: &Device, run: &dyn Run) -> Result<Vec<[f32; 4]>, Failure> {
    sample(device, run, 1)?;
    device.read(run.output())
}

/// Seconds from submission until the device is idle, for `frames` frames in one submission.
fn sample(device: &Device, run: &dyn Run, frames: u32) -> Result<f64, Failure> {
    let label = Some("kernel bench");
    let mut encoder = device.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label });
    for _ in 0..frames {
        run.encode(&mut encoder).map_err(out_of_order)?;
    }
    let commands = encoder.finish();
    device.wait()?;
    let start = Instant::now();
    device.queue.submit([commands]);
    device.wait()?;
    Ok(start.elapsed().as_secs_f64())
}

/// Time per frame of each run. The first one is the yardstick.
///
/// Every round samples each run once, so that a machine that slows down slows all of them, and every ratio is one of
/// neighbours in time; rounds alternate in direction, so that no run is always the one after the slowest.
pub(super) fn times(
    device: &Device,
    runs: &[Box<dyn Run>],
    rounds: u32,
    mut on_sample: impl FnMut(),
) -> Result<Vec<Time>, Failure> {
    let mut frames = Vec::with_capacity(runs.len());
    for run in runs {
        let once = sample(device, &**run, 1)?;
        frames.push((SAMPLE_SECONDS / once).ceil().clamp(1.0, f64::from(LARGEST_FRAME_COUNT)) as u32);
    }
    let mut seconds: Vec<Vec<f64>> = vec![Vec::new(); runs.len()];
    for round in 0..rounds {
        let mut order: Vec<usize> = (0..runs.len()).collect();
        if round % 2 == 1 {
            order.reverse();
        }
        for index in order {
            let total = sample(device, &*runs[index], frames[index])?;
            seconds[index].push(total / f64::from(frames[index]));
            on_sample();
        }
    }
    let time = |own: &Vec<f64>| {
        let ratios = own.iter().zip(&seconds[0]).map(|(own, yardstick)| own / yardstick);
        Time { milliseconds: 1e3 * median(own.clone()), ratio: median(ratios.collect()) }
    };
    Ok(seconds.iter().map(time).collect())
}

/// The middle value, or the mean of the two in the middle; NaN of none.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let middle = values.len() / 2;
    match values.len() {
        0 => f64::NAN,
        count if count % 2 == 1 => values[middle],
        _ => 0.5 * (values[middle - 1] + values[middle]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_of_the_values_lie_on_each_side_of_the_median() {
        assert_eq!(median(vec![3.0, 1.0, 100.0]), 3.0);
        assert_eq!(median(vec![4.0, 1.0, 100.0, 2.0]), 3.0);
        assert!(median(Vec::new()).is_nan());
    }
}
