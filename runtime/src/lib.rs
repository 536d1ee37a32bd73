//! Thin wgpu passes for subsurface scattering: shadow → G-buffer → subsurface → composite.
//!
//! The central type is [`SubsurfacePass`]: give it three textures of your frame (irradiance, surface albedo with
//! material number, depth) and a [`SubsurfaceView`], and it gives one texture back. [`KernelParts`] say which materials it
//! knows; `subsurface-codegen` generates them from RON. [`Renderer`] orders all four passes, for a whole picture.
//!
//! Rules of every pass:
//!
//! - `new` makes all that does not depend on the frame's size, `resize` the targets and bindings, `prepare` uploads one
//!   frame's parameters, `encode` records. Nothing is submitted, and `prepare` and `encode` allocate nothing.
//! - The caller owns the device, the queue and the submission.
//! - World scale is not guessed: the caller says how many millimetres a world unit has.
//!
//! What this crate does not know: RON, files, windows; and how a kernel came to be.

mod bindings;
mod camera;
mod error;
mod geometry;
mod kernel_format;
mod light;
mod material_table;
pub mod pass;
mod readback;
mod renderer;
mod target;
mod view;

pub use bytemuck;
pub use wgpu;

pub use bindings::kernel::GBufferVertex as Vertex;
pub use camera::{Bounds, Camera};
pub use error::{DebugViewError, ResizeError, SizeError, TexelsError};
pub use geometry::{Geometry, Object, SurfaceDescriptor, TexturePixels};
pub use kernel_format::texture_format;
pub use light::{DirectionalLight, LIGHT_CAPACITY};
pub use pass::composite::{CompositeInputs, CompositePass, CompositeSettings};
pub use pass::distance::DistancePass;
pub use pass::gbuffer::{GBufferPass, GBufferView};
pub use pass::shadow::ShadowPass;
pub use pass::subsurface::{Path, PathError, SubsurfaceInputs, SubsurfacePass};
pub use readback::{Readback, ReadbackError};
pub use renderer::{Frame, Renderer};
pub use subsurface_kernel::{
    DebugView, Estimator, EstimatorError, KernelModule, KernelParts, KernelPartsBuilder, OutputFormat,
    PartsError, RowBinding,
};
pub use target::{Extent, GBuffer, TRANSLUCENT_STENCIL, Target};
pub use view::SubsurfaceView;
