//! Textures and buffers on their way back to the CPU.

use crate::wgpu;
use crate::wgpu_version::mapped_bytes;

/// The texels of one texture, copied by a recorded command.
///
/// ```no_run
/// # use subsurface_runtime::{Readback, Target, wgpu};
/// # fn read(device: &wgpu::Device, queue: &wgpu::Queue, target: &Target) -> Result<(), Box<dyn std::error::Error>> {
/// let mut encoder = device.create_command_encoder(&Default::default());
/// let readback = Readback::record(device, &mut encoder, &target.texture);
/// queue.submit([encoder.finish()]);
/// let bytes = readback.wait(device)?;
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct Readback {
    buffer: wgpu::Buffer,
    row_bytes: usize,
    padded_row_bytes: usize,
}

/// Why texels did not come back.
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadbackError {
    /// The device stopped answering.
    #[error("the device was lost: {0}")]
    DeviceLost(String),
    /// The buffer cannot be mapped.
    #[error("the texels cannot be mapped: {0}")]
    NotMapped(String),
}

impl Readback {
    /// Records the copy of a whole 2-D texture of a colour format. Submit the encoder before [`wait`](Self::wait).
    pub fn record(
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        texture: &wgpu::Texture,
    ) -> Self {
        // Depth-stencil formats have no size: they cannot be copied, which wgpu then says.
        let texel = texture.format().block_copy_size(None).unwrap_or(4);
        let row = texture.width() * texel;
        let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("Readback buffer"),
            size: u64::from(padded) * u64::from(texture.height()),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let layout =
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(padded), rows_per_image: None };
        encoder.copy_texture_to_buffer(
            texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo { buffer: &buffer, layout },
            texture.size(),
        );
        Self { buffer, row_bytes: row as usize, padded_row_bytes: padded as usize }
    }

    /// Waits for the device; returns the texels, rows from the top without padding.
    ///
    /// # Errors
    /// A device that was lost.
    pub fn wait(self, device: &wgpu::Device) -> Result<Vec<u8>, ReadbackError> {
        let padded = BufferReadback::of(&self.buffer).wait(device)?;
        Ok(padded.chunks(self.padded_row_bytes).flat_map(|row| &row[..self.row_bytes]).copied().collect())
    }
}

/// The bytes of a buffer that can be mapped.
pub(crate) struct BufferReadback<'a> {
    buffer: &'a wgpu::Buffer,
}

impl<'a> BufferReadback<'a> {
    pub(crate) fn of(buffer: &'a wgpu::Buffer) -> Self {
        Self { buffer }
    }

    /// Waits for the device; the buffer is free again when this returns.
    pub(crate) fn wait(self, device: &wgpu::Device) -> Result<Vec<u8>, ReadbackError> {
        let (sender, receiver) = std::sync::mpsc::channel();
        // The receiver outlives the wait below; a closed channel has nobody left to tell.
        self.buffer.map_async(wgpu::MapMode::Read, .., move |result| sender.send(result).unwrap_or(()));
        device
            .poll(wgpu::PollType::wait_indefinitely())
            .map_err(|error| ReadbackError::DeviceLost(error.to_string()))?;
        let mapped = receiver.recv().map_err(|error| ReadbackError::DeviceLost(error.to_string()))?;
        mapped.map_err(|error| ReadbackError::NotMapped(error.to_string()))?;
        let bytes = mapped_bytes(self.buffer).map_err(ReadbackError::NotMapped)?.to_vec();
        self.buffer.unmap();
        Ok(bytes)
    }
}
