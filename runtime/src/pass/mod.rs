//! The four passes, and those beside them.

pub mod clear;
pub mod composite;
mod covering_pass;
mod covering_pipeline;
pub mod distance;
pub mod gbuffer;
mod pass_error;
pub mod shadow;
pub mod subsurface;
pub mod tone;

pub use pass_error::PassError;

use crate::wgpu;

/// An attachment that is kept, and cleared before.
fn cleared(view: &wgpu::TextureView, colour: wgpu::Color) -> Option<wgpu::RenderPassColorAttachment<'_>> {
    attachment(view, wgpu::LoadOp::Clear(colour))
}

/// An attachment that is kept.
fn attachment(
    view: &wgpu::TextureView,
    load: wgpu::LoadOp<wgpu::Color>,
) -> Option<wgpu::RenderPassColorAttachment<'_>> {
    Some(wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
    })
}

/// A buffer for one `T` of a frame.
fn uniform_buffer<T>(device: &wgpu::Device, label: &str) -> wgpu::Buffer {
    device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size: size_of::<T>() as u64,
        usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}
