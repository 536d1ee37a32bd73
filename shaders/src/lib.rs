//! Hand-written WGSL, handed out as text.
//!
//! A [`Module`] is one `.wgsl` file, and each folder is a room: pure functions ([`LIBRARY`]), profile models
//! ([`PROFILES`]), what all estimators share ([`GATHER`]), the estimators ([`KERNELS`]), the light of the G-buffer
//! ([`LIGHT`]), and bindings with entry points ([`PASSES`]). The first line of a file that takes something from others names
//! them, and what it leaves open for the pass that links it:
//!
//! ```wgsl
//! // uses: gather/{channel, gathered, input, point, rejection}, kernel/constants, lib/angle; needs: input_pixel
//! ```
//!
//! No top-level name stands in two modules that may be linked together, so a linker can resolve a name by itself:
//! `subsurface-codegen` does, checks those lines, and leaves them out.
//!
//! ```
//! let burley = subsurface_shaders::PROFILES.iter().find(|module| module.name == "profiles/burley").unwrap();
//! assert!(burley.text.contains("fn burley_radial_cdf"));
//! ```
//!
//! What this crate does not know: naga, wgpu, materials, the file system.

/// One WGSL file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Module {
    /// Folder and file stem, such as `profiles/burley`.
    pub name: &'static str,
    /// The file's text.
    pub text: &'static str,
}

macro_rules! modules {
    ($($name:literal),+ $(,)?) => {
        &[$(Module { name: $name, text: include_str!(concat!("../", $name, ".wgsl")) }),+]
    };
}

/// Constants, noise and pure functions.
pub const LIBRARY: &[Module] = modules![
    "lib/albedo_mix",
    "lib/angle",
    "lib/covering_triangle",
    "lib/dipole_source",
    "lib/distance",
    "lib/exponential",
    "lib/exponential_source_sum",
    "lib/half_space",
    "lib/medium_angles",
    "lib/noise",
    "lib/numeric_limits",
    "lib/object_transform",
    "lib/shared_exponent",
    "lib/single_scattering_albedo",
    "lib/slab",
    "lib/tone",
    "lib/vogel_disc",
];

/// Profile models in f32: the twins of `subsurface-profile`'s.
///
/// A module `profiles/<model>` defines `<model>_profile`, `<model>_area_pdf`, `<model>_radial_pdf`,
/// `<model>_radial_cdf` and `<model>_sample_radius`; lengths in mm. `gaussian_sum_area_pdf`,
/// `gaussian_sum_radial_cdf`, the sums over the parts of a mixture and the search of a table for a radius come from the
/// compiler, which writes them out to the length that a material set needs.
pub const PROFILES: &[Module] = modules![
    "profiles/burley",
    "profiles/dipole",
    "profiles/exponential_dipole",
    "profiles/gaussian_sum",
    "profiles/mixture",
    "profiles/polynomial",
    "profiles/tabulated",
    "profiles/two_exponential_dipole",
];

/// What all estimators share: inputs, points, curves, taps, rejection.
pub const GATHER: &[Module] = modules![
    "gather/channel",
    "gather/classification",
    "gather/curve",
    "gather/footprint",
    "gather/gathered",
    "gather/input",
    "gather/material",
    "gather/mean_free_path_scale",
    "gather/normal",
    "gather/packed_pixel",
    "gather/pixel_point",
    "gather/point",
    "gather/profile",
    "gather/rejection",
    "gather/tap",
    "gather/tile",
    "gather/tile_list",
    "gather/tile_listing",
    "gather/view",
];

/// The estimators, which a profile is plugged into.
pub const KERNELS: &[Module] = modules![
    "kernels/debug_view",
    "kernels/dense",
    "kernels/importance_sampled",
    "kernels/interleaved",
    "kernels/interleaved/agreement",
    "kernels/interleaved/block",
    "kernels/interleaved/block_light",
    "kernels/interleaved/block_ring",
    "kernels/interleaved/coarse",
    "kernels/interleaved/coarse_square",
    "kernels/interleaved/far",
    "kernels/interleaved/far_fields",
    "kernels/interleaved/mixture",
    "kernels/interleaved/near",
    "kernels/interleaved/packing",
    "kernels/interleaved/receiver",
    "kernels/interleaved/ring",
    "kernels/interleaved/rows",
    "kernels/interleaved/square",
    "kernels/interleaved/tile_memory",
    "kernels/interleaved/window",
    "kernels/probe",
    "kernels/separable",
    "kernels/separable/edge_spread",
    "kernels/separable/packed_line",
    "kernels/separable/strips",
    "kernels/separable/taps",
    "kernels/single_stage",
];

/// Light on surfaces: what enters, what is reflected, what comes through.
pub const LIGHT: &[Module] = modules![
    "light/absorption",
    "light/coupling",
    "light/diffuse_lobe",
    "light/environment",
    "light/fresnel",
    "light/light",
    "light/lit_surface",
    "light/normal_map",
    "light/refraction",
    "light/shadow",
    "light/specular",
    "light/specular_albedo",
    "light/specular_surface",
    "light/transmission",
];

/// Passes with their bindings and entry points.
///
/// Linked with the parts of the subsurface pass that all kernels share, `passes/<kernel>` is the fragment path of a
/// kernel and `passes/<kernel>_compute` its compute path. Kernels of one stage share both, `passes/single_stage` and
/// `passes/single_stage_compute`, and their `passes/<kernel>` says what those gather by. The parts of two kernels bear
/// the same names.
pub const PASSES: &[Module] = modules![
    "passes/classify_compute",
    "passes/clear",
    "passes/clear_exit",
    "passes/composite",
    "passes/dense",
    "passes/distance",
    "passes/gbuffer",
    "passes/halve",
    "passes/importance_sampled",
    "passes/interleaved",
    "passes/interleaved_compute",
    "passes/separable",
    "passes/separable_compute",
    "passes/shadow",
    "passes/single_stage",
    "passes/single_stage_compute",
    "passes/subsurface",
    "passes/subsurface_compute",
    "passes/subsurface_debug",
    "passes/subsurface_fragment",
    "passes/tone",
];

/// Every module, room by room.
pub fn modules() -> impl Iterator<Item = &'static Module> {
    [LIBRARY, PROFILES, GATHER, KERNELS, LIGHT, PASSES].into_iter().flatten()
}
