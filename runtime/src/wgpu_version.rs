//! What differs between the versions of wgpu that the passes are built against.

use crate::wgpu;

/// Buffers of a vertex stage.
#[cfg(feature = "wgpu-30")]
pub(crate) type VertexBuffer<'a> = Option<wgpu::VertexBufferLayout<'a>>;
/// Buffers of a vertex stage.
#[cfg(not(feature = "wgpu-30"))]
pub(crate) type VertexBuffer<'a> = wgpu::VertexBufferLayout<'a>;

/// A buffer as an element of [`wgpu::VertexState::buffers`]: wgpu 30 allows gaps between them.
pub(crate) fn vertex_buffer(layout: wgpu::VertexBufferLayout<'_>) -> VertexBuffer<'_> {
    #[cfg(feature = "wgpu-30")]
    return Some(layout);
    #[cfg(not(feature = "wgpu-30"))]
    layout
}

/// Bytes of a buffer that is mapped for reading, or why there are none: wgpu 29 panics instead.
pub(crate) fn mapped_bytes(buffer: &wgpu::Buffer) -> Result<wgpu::BufferView, String> {
    #[cfg(feature = "wgpu-30")]
    return buffer.get_mapped_range(..).map_err(|error| error.to_string());
    #[cfg(not(feature = "wgpu-30"))]
    Ok(buffer.get_mapped_range(..))
}
