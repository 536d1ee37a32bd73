//! The device that pictures are drawn on.

use std::fmt;

use subsurface_runtime::{FrameError, Readback, wgpu};

use crate::failure::{Explain, Failure};

/// A device with its queue.
#[derive(Debug)]
pub struct Device {
    /// The device.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    adapter: wgpu::AdapterInfo,
}

/// Why there is no device.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DeviceError {
    /// No graphics adapter, real or in software.
    NoAdapter,
    /// The adapter gives no device with WebGPU's default limits.
    NoDevice {
        /// The adapter's name.
        adapter: String,
        /// What it said.
        reason: String,
    },
    /// The device stopped answering.
    Lost {
        /// What it said.
        reason: String,
    },
}

impl fmt::Display for DeviceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoAdapter => f.write_str("no graphics adapter"),
            Self::NoDevice { adapter, reason } => write!(f, "{adapter} gives no device: {reason}"),
            Self::Lost { reason } => write!(f, "the graphics device was lost: {reason}"),
        }
    }
}

impl Explain for DeviceError {
    fn help(&self) -> Option<String> {
        Some(match self {
            Self::NoAdapter => {
                "install a Vulkan driver; one in software will do: on Debian and Ubuntu `apt-get install \
                                mesa-vulkan-drivers`, in this repository `cargo xtask demo` does it"
                    .to_owned()
            }
            Self::NoDevice { .. } => {
                "update the driver, or choose another adapter with WGPU_ADAPTER_NAME".to_owned()
            }
            Self::Lost { .. } => "try again with a smaller --size or fewer --taps".to_owned(),
        })
    }
}

impl Device {
    /// Opens the strongest adapter; `WGPU_BACKEND` and `WGPU_ADAPTER_NAME` choose another.
    ///
    /// The arguments of indirect dispatches are not checked by wgpu, unless `WGPU_VALIDATION_INDIRECT_CALL` is set: that
    /// takes a dispatch more for each, and those of the subsurface pass keep to the smallest limits by themselves.
    pub fn open() -> Result<Self, DeviceError> {
        pollster::block_on(Self::request())
    }

    async fn request() -> Result<Self, DeviceError> {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle_from_env();
        if std::env::var_os("WGPU_VALIDATION_INDIRECT_CALL").is_none() {
            descriptor.flags.remove(wgpu::InstanceFlags::VALIDATION_INDIRECT_CALL);
        }
        let instance = wgpu::Instance::new(descriptor);
        let adapter = match wgpu::util::initialize_adapter_from_env(&instance, None).await {
            Ok(adapter) => adapter,
            Err(_) => {
                let options = wgpu::RequestAdapterOptions {
                    power_preference: wgpu::PowerPreference::HighPerformance,
                    ..Default::default()
                };
                instance.request_adapter(&options).await.map_err(|_| DeviceError::NoAdapter)?
            }
        };
        let info = adapter.get_info();
        let (device, queue) = adapter
            .request_device(&wgpu::DeviceDescriptor {
                label: Some("subsurface"),
                // Times of passes, for those who ask: not every adapter has them.
                required_features: adapter.features() & wgpu::Features::TIMESTAMP_QUERY,
                required_limits: wgpu::Limits::default().using_resolution(adapter.limits()),
                ..Default::default()
            })
            .await
            .map_err(|error| DeviceError::NoDevice {
                adapter: info.name.clone(),
                reason: error.to_string(),
            })?;
        Ok(Self { device, queue, adapter: info })
    }

    /// Name and interface of the adapter, for people.
    pub fn description(&self) -> String {
        format!("{} ({})", self.adapter.name, self.adapter.backend)
    }

    /// Submits what `record` records.
    pub(crate) fn submit(
        &self,
        record: impl FnOnce(&mut wgpu::CommandEncoder) -> Result<(), FrameError>,
    ) -> Result<(), Failure> {
        let label = Some("Device commands");
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label });
        record(&mut encoder).map_err(super::out_of_order)?;
        self.queue.submit([encoder.finish()]);
        Ok(())
    }

    /// Waits until all that was submitted is done.
    pub(crate) fn wait(&self) -> Result<(), Failure> {
        let polled = self.device.poll(wgpu::PollType::wait_indefinitely());
        polled.map(|_| ()).map_err(|error| DeviceError::Lost { reason: error.to_string() }.into())
    }

    /// Runs `body`; what the device finds wrong with it becomes a failure.
    pub(crate) fn checked<T>(&self, body: impl FnOnce() -> Result<T, Failure>) -> Result<T, Failure> {
        let memory = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let validation = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let result = body();
        let refused = pollster::block_on(validation.pop());
        let exhausted = pollster::block_on(memory.pop());
        if let Some(error) = exhausted {
            let message = format!("the graphics device is out of memory: {error}");
            return Err(Failure::new(
                message,
                "try a smaller --size, or a smaller --shadow-map-size if you gave one",
            ));
        }
        if let Some(error) = refused {
            let message = format!("the graphics device refuses the frame: {error}");
            return Err(Failure::new(
                message,
                "please report this as a defect, with the command and the adapter",
            ));
        }
        result
    }

    /// Texels of a texture as four f32 each, rows from the top; of the formats that passes render to.
    pub(crate) fn read(&self, texture: &wgpu::Texture) -> Result<Vec<[f32; 4]>, Failure> {
        let bytes = self.read_bytes(texture)?;
        Ok(match texture.format() {
            wgpu::TextureFormat::Rgba32Float => bytemuck::pod_collect_to_vec(&bytes),
            wgpu::TextureFormat::R32Float => {
                bytemuck::pod_collect_to_vec::<u8, f32>(&bytes).into_iter().map(|x| [x, x, x, 1.0]).collect()
            }
            wgpu::TextureFormat::Rgba16Float => bytes
                .chunks_exact(8)
                .map(|texel| {
                    std::array::from_fn(|c| half(u16::from_le_bytes([texel[2 * c], texel[2 * c + 1]])))
                })
                .collect(),
            other => {
                let message = format!("texels of the format {other:?} are not read back");
                return Err(Failure::new(message, "please report this as a defect"));
            }
        })
    }

    /// Bytes of a texture, rows from the top without padding.
    pub(crate) fn read_bytes(&self, texture: &wgpu::Texture) -> Result<Vec<u8>, Failure> {
        let label = Some("Device readback");
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label });
        let readback = Readback::record(&self.device, &mut encoder, texture);
        self.queue.submit([encoder.finish()]);
        readback.wait(&self.device).map_err(|error| DeviceError::Lost { reason: error.to_string() }.into())
    }
}

/// An IEEE 754 half as f32.
fn half(bits: u16) -> f32 {
    exr::prelude::f16::from_bits(bits).to_f32()
}
