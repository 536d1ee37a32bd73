//! Thin wgpu passes for subsurface scattering: shadow → G-buffer → subsurface → composite.
//!
//! The central type is [`SubsurfacePass`]: give it three textures of your frame (irradiance, surface albedo with
//! material number, depth) and a [`SubsurfaceView`], and it diffuses the irradiance into a texture of yours.
//! [`KernelParts`] say which materials it knows; `subsurface-codegen` generates them from RON, and a [`LoadedKernel`]
//! holds them on the device for all passes. [`Renderer`] orders all four passes, for a whole picture.
//!
//! Rules of every pass:
//!
//! - `new` makes all that does not depend on the frame's size, `bind` takes the inputs, `prepare` uploads one frame's
//!   parameters, `encode` records into the caller's texture. Nothing is submitted, and `prepare` and `encode` allocate
//!   nothing (the compute path makes bind groups the first time that it sees an output). A call that comes too early is
//!   an error.
//! - The caller owns the device, the queue and the submission.
//! - World scale is not guessed: the caller says how many millimetres a world unit has.
//! - Descriptors have defaults, and every GPU object has a label that begins with the descriptor's.
//!
//! # Features
//!
//! `wgpu-30` (default) or `wgpu-29`: the version of wgpu whose types the passes take; [`wgpu`] is that version. Exactly
//! one must be on. `vulkan`, `metal` and `dx12` (default), `gles`, `webgpu` and `webgl` are wgpu's backends.
//!
//! What this crate does not know: RON, files, windows; and how a kernel came to be.

#[cfg(all(feature = "wgpu-29", feature = "wgpu-30"))]
compile_error!(
    "subsurface-runtime is built against one version of wgpu, and both `wgpu-29` and `wgpu-30` are on: `wgpu-30` is a \
     default feature, so for wgpu 29 write `default-features = false, features = [\"wgpu-29\", \"vulkan\"]`"
);
#[cfg(not(any(feature = "wgpu-29", feature = "wgpu-30")))]
compile_error!(
    "subsurface-runtime is built against one version of wgpu, and none is chosen: turn on the feature `wgpu-30` or \
     `wgpu-29`, and a backend such as `vulkan`"
);

pub use bytemuck;
#[cfg(all(feature = "wgpu-29", not(feature = "wgpu-30")))]
pub use wgpu_29 as wgpu;
#[cfg(feature = "wgpu-30")]
pub use wgpu_30 as wgpu;

mod albedo_mixes;
mod bind_error;
mod bindings;
mod camera;
mod clear_material;
mod environment;
mod extent;
mod frame;
mod frame_error;
mod gbuffer;
mod geometry;
mod input;
mod label;
mod light;
mod load_error;
mod loaded_kernel;
mod material_table;
mod mips;
mod object;
mod output;
pub mod pass;
mod readback;
mod renderer;
mod target;
mod texture_format;
mod timestamps;
mod unknown_material;
mod view;
mod viewport;
mod wgpu_version;

pub use bind_error::BindError;
pub use bindings::kernel::GBufferVertex as Vertex;
pub use camera::{Bounds, Camera};
pub use clear_material::ClearMaterial;
pub use environment::{Environment, EnvironmentError};
pub use extent::{Extent, SizeError};
pub use frame::Frame;
pub use frame_error::FrameError;
pub use gbuffer::{GBuffer, TRANSLUCENT_STENCIL};
pub use geometry::Geometry;
pub use light::{DirectionalLight, Light, LightRanks, PointLight, SHADOW_MAPS, SpotLight};
pub use load_error::LoadError;
pub use loaded_kernel::LoadedKernel;
pub use object::{Object, SurfaceDescriptor, TexturePixels};
pub use pass::PassError;
pub use pass::clear::{ClearDescriptor, ClearPass};
pub use pass::composite::{CompositeDescriptor, CompositeInputs, CompositePass, CompositeSettings};
pub use pass::distance::{DistanceDescriptor, DistancePass};
pub use pass::gbuffer::{GBufferDescriptor, GBufferPass, GBufferView};
pub use pass::shadow::{ShadowDescriptor, ShadowPass};
pub use pass::subsurface::{Path, SubsurfaceDescriptor, SubsurfaceInputs, SubsurfacePass};
pub use pass::tone::{ToneDescriptor, TonePass};
pub use readback::{Readback, ReadbackError};
pub use renderer::{Renderer, RendererDescriptor};
pub use subsurface_kernel::{
    ComputeShape, DebugView, Estimator, EstimatorError, KernelModule, KernelParts, KernelPartsBuilder,
    OutputFormat, PartsError, RowBinding,
};
pub use target::{Target, TexelsError};
pub use texture_format::{output_format, texture_format};
pub use timestamps::{NoTimestamps, PassTimer, Timestamps};
pub use unknown_material::UnknownMaterial;
pub use view::SubsurfaceView;
pub use viewport::Viewport;
