//! The lights of a frame on the device.

use crate::bindings::kernel;
use crate::pass::gbuffer::GBufferView;
use crate::wgpu;

/// Lights that the first buffer holds; it grows with the frames.
const FIRST_LIGHTS: usize = 8;

/// A storage buffer of lights.
#[derive(Debug)]
pub(crate) struct LightBuffer {
    buffer: wgpu::Buffer,
    label: String,
    /// How many it holds.
    capacity: usize,
    /// What is written to it, kept from frame to frame.
    rows: Vec<kernel::Light>,
}

impl LightBuffer {
    pub(crate) fn new(device: &wgpu::Device, label: String) -> Self {
        Self::of(device, label, FIRST_LIGHTS)
    }

    fn of(device: &wgpu::Device, label: String, capacity: usize) -> Self {
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(&label),
            size: (capacity * size_of::<kernel::Light>()) as u64,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { buffer, label, capacity, rows: Vec::with_capacity(capacity) }
    }

    pub(crate) fn binding(&self) -> wgpu::BufferBinding<'_> {
        self.buffer.as_entire_buffer_binding()
    }

    /// Writes a view's lights by their ranks. Where they are more than it holds it is made anew, twice as large: then
    /// the answer is true, and what binds it must bind again.
    pub(crate) fn upload(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        view: &GBufferView<'_>,
    ) -> bool {
        let count = view.lights.len();
        let is_new = count > self.capacity;
        if is_new {
            *self = Self::of(device, std::mem::take(&mut self.label), count.next_power_of_two());
        }
        self.rows.clear();
        let row = |index: usize, layer| {
            view.lights[index].uniform(layer, &view.bounds, view.millimetres_per_world_unit)
        };
        match view.ranks {
            Some(ranks) => {
                self.rows.extend(ranks.order().iter().map(|&index| row(index, ranks.layer(index))));
            }
            None => self.rows.extend((0..count).map(|index| row(index, None))),
        }
        queue.write_buffer(&self.buffer, 0, bytemuck::cast_slice(&self.rows));
        is_new
    }
}
