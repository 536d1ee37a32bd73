//! Subsurface scattering as a toolchain: materials in RON become validated WGSL kernels and typed wgpu passes.
//!
//! This crate holds the ready-made materials ([`presets`]) and re-exports the [`runtime`] that renders them. For
//! materials of your own, add `subsurface-codegen` as a build-dependency; the README shows how.
//!
//! ```no_run
//! use subsurface::presets::{self, Material};
//! use subsurface::runtime::{SubsurfacePass, wgpu};
//!
//! # fn frame(device: &wgpu::Device) {
//! let pass = SubsurfacePass::new(device, &presets::kernel(), wgpu::TextureFormat::Rgba16Float, None);
//! let number_in_the_surface_target = Material::Skin.number() as f32;
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
