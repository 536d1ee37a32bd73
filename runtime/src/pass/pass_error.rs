//! Passes that cannot be made.

use subsurface_kernel::DebugView;

use crate::wgpu;

/// Why a pass cannot be made of a kernel on a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PassError {
    /// No compute shaders, or too small ones.
    #[error(
        "the device has no compute shaders of 256 invocations with four storage textures and up to four storage \
         buffers: use Path::Fragment"
    )]
    NoCompute,
    /// The device cannot store to the output's format.
    #[error(
        "the compute path cannot store to {output:?} on this device: take Rgba16Float or Rgba32Float, or use \
         Path::Fragment"
    )]
    NotStorable {
        /// The output's format.
        output: wgpu::TextureFormat,
    },
    /// The module has no place for another format than its own.
    #[error(
        "the kernel's compute path writes {kernel:?} alone, and the output is {output:?}: compile the kernel for that \
         format, or use Path::Fragment"
    )]
    Format {
        /// What the kernel was compiled for.
        kernel: Option<wgpu::TextureFormat>,
        /// The output's format.
        output: wgpu::TextureFormat,
    },
    /// The device cannot render to the output's format.
    #[error(
        "the fragment path and debug views cannot render to {output:?} on this device: take Rgba16Float or Rgba32Float"
    )]
    NotRenderable {
        /// The output's format.
        output: wgpu::TextureFormat,
    },
    /// The kernel was compiled without debug views.
    #[error(
        "the kernel was compiled without debug views, so `{}` cannot be shown: compile it with \
         `Compiler::with_debug_views`",
        view.name()
    )]
    NoDebugViews {
        /// The view.
        view: DebugView,
    },
    /// The kernel was compiled without the G-buffer's entry points.
    #[error("the kernel was compiled without the G-buffer pass: leave `Compiler::without_gbuffer` out")]
    NoGBuffer,
}
