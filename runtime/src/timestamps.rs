//! How long passes take on the device.

use std::time::Duration;

use crate::readback::{BufferReadback, ReadbackError};
use crate::wgpu;

/// Where a pass writes the times at which it begins and ends.
///
/// Needs [`wgpu::Features::TIMESTAMP_QUERY`]. [`PassTimer`] makes these and reads them; a query set of your own does as
/// well.
#[derive(Clone, Debug)]
pub struct Timestamps {
    /// A query set of the type `Timestamp`.
    pub query_set: wgpu::QuerySet,
    /// Number of the query that takes the beginning.
    pub beginning: u32,
    /// Number of the query that takes the end.
    pub end: u32,
}

impl Timestamps {
    /// What a render pass writes that is the first or the last of its pass, or both.
    pub(crate) fn of_render_pass(
        &self,
        is_first: bool,
        is_last: bool,
    ) -> Option<wgpu::RenderPassTimestampWrites<'_>> {
        // A pass in the middle writes nothing, which wgpu does not take.
        (is_first || is_last).then_some(wgpu::RenderPassTimestampWrites {
            query_set: &self.query_set,
            beginning_of_pass_write_index: is_first.then_some(self.beginning),
            end_of_pass_write_index: is_last.then_some(self.end),
        })
    }

    /// What a compute pass writes that is the whole of its pass.
    pub(crate) fn of_compute_pass(&self) -> wgpu::ComputePassTimestampWrites<'_> {
        wgpu::ComputePassTimestampWrites {
            query_set: &self.query_set,
            beginning_of_pass_write_index: Some(self.beginning),
            end_of_pass_write_index: Some(self.end),
        }
    }

    /// Writes both where a pass records nothing: a query that is never written is never ready.
    pub(crate) fn of_nothing(&self, encoder: &mut wgpu::CommandEncoder, label: &str) {
        drop(encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some(label),
            timestamp_writes: Some(self.of_compute_pass()),
        }));
    }
}

/// A device that has no timestamps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the device has no timestamps: ask the adapter for `Features::TIMESTAMP_QUERY`, which not all have")]
pub struct NoTimestamps;

/// Times several passes on the device.
///
/// ```no_run
/// # use subsurface_runtime::{CompositeDescriptor, CompositePass, PassTimer, wgpu};
/// # fn time(device: &wgpu::Device, queue: &wgpu::Queue) -> Result<(), Box<dyn std::error::Error>> {
/// let timer = PassTimer::new(device, queue, &["composite"])?;
/// let composite = CompositePass::new(
///     device,
///     &CompositeDescriptor { timestamps: timer.timestamps(0), ..Default::default() },
/// );
/// let mut encoder = device.create_command_encoder(&Default::default());
/// // Bind, prepare and encode the pass; then, behind all that are timed:
/// timer.resolve(&mut encoder);
/// queue.submit([encoder.finish()]);
/// for (name, time) in timer.wait(device)? {
///     println!("{name}: {time:?}");
/// }
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct PassTimer {
    names: Vec<String>,
    query_set: wgpu::QuerySet,
    /// What the queries are resolved to.
    resolved: wgpu::Buffer,
    /// What the host reads.
    readable: wgpu::Buffer,
    nanoseconds_per_tick: f32,
}

impl PassTimer {
    /// A timer of the passes with these names.
    ///
    /// # Errors
    /// A device without timestamps.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue, names: &[&str]) -> Result<Self, NoTimestamps> {
        if !device.features().contains(wgpu::Features::TIMESTAMP_QUERY) {
            return Err(NoTimestamps);
        }
        let count = 2 * names.len() as u32;
        let query_set = device.create_query_set(&wgpu::QuerySetDescriptor {
            label: Some("PassTimer queries"),
            ty: wgpu::QueryType::Timestamp,
            count,
        });
        let buffer = |label, usage| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: u64::from(count) * u64::from(wgpu::QUERY_SIZE),
                usage,
                mapped_at_creation: false,
            })
        };
        Ok(Self {
            names: names.iter().map(|&name| name.to_owned()).collect(),
            query_set,
            resolved: buffer(
                "PassTimer ticks",
                wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
            ),
            readable: buffer(
                "PassTimer readback",
                wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            ),
            nanoseconds_per_tick: queue.get_timestamp_period(),
        })
    }

    /// Where the pass of that place in the list of names writes; `None` beyond it.
    pub fn timestamps(&self, pass: usize) -> Option<Timestamps> {
        let first = 2 * u32::try_from(pass).ok()?;
        (pass < self.names.len()).then(|| Timestamps {
            query_set: self.query_set.clone(),
            beginning: first,
            end: first + 1,
        })
    }

    /// Records the copy of all times. Every pass must have been recorded before.
    pub fn resolve(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.resolve_query_set(&self.query_set, 0..2 * self.names.len() as u32, &self.resolved, 0);
        encoder.copy_buffer_to_buffer(&self.resolved, 0, &self.readable, 0, None);
    }

    /// Waits for the device; returns the passes' names and times, in the order of the names.
    ///
    /// # Errors
    /// A device that was lost.
    pub fn wait(&self, device: &wgpu::Device) -> Result<Vec<(String, Duration)>, ReadbackError> {
        let bytes = BufferReadback::of(&self.readable).wait(device)?;
        let ticks: Vec<u64> = bytemuck::pod_collect_to_vec(&bytes);
        let time = |pair: &[u64]| {
            let ticks = pair[1].saturating_sub(pair[0]);
            Duration::from_nanos((ticks as f64 * f64::from(self.nanoseconds_per_tick)) as u64)
        };
        Ok(self.names.iter().cloned().zip(ticks.chunks_exact(2).map(time)).collect())
    }
}
