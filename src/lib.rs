//! Subsurface scattering as a toolchain: materials in RON become validated WGSL kernels and typed wgpu passes.
//!
//! This crate holds the ready-made materials ([`presets`]) and re-exports the [`runtime`] that renders them. For
//! materials of your own, add `subsurface-codegen` as a build-dependency; the README shows how.
//!
//! ```no_run
//! use subsurface::presets::{self, Material};
//! use subsurface::runtime::{LoadedKernel, SubsurfaceDescriptor, SubsurfacePass, wgpu};
//!
//! # fn frame(device: &wgpu::Device, queue: &wgpu::Queue) -> Result<(), Box<dyn std::error::Error>> {
//! let kernel = LoadedKernel::new(device, queue, &presets::kernel())?;
//! let pass = SubsurfacePass::new(device, &kernel, &SubsurfaceDescriptor::default())?;
//! let number_in_the_surface_target = Material::Skin.number() as f32;
//! # Ok(())
//! # }
//! ```
//!
//! What this crate does not know: anything of its own. Physics is in `subsurface-profile`, the compiler in
//! `subsurface-codegen`, the passes in `subsurface-runtime`.

pub use subsurface_runtime as runtime;

/// The materials in `materials/`: an enum, their parameter table and their kernel.
pub mod presets {
    include!(concat!(env!("OUT_DIR"), "/subsurface.rs"));
}
