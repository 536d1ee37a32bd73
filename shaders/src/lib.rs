//! Hand-written WGSL, handed out as text.
//!
//! A [`Module`] is one `.wgsl` file. Library, profile and kernel modules hold pure functions; a pass module holds
//! bindings and entry points. No top-level name stands in two modules that may be linked together (library, profiles,
//! kernels), so a linker can resolve a name by itself: `subsurface-codegen` does.
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

/// Pure functions that passes, kernels and profiles share.
pub const LIBRARY: &[Module] = modules![
    "lib/covering_triangle",
    "lib/dipole_source",
    "lib/exponential",
    "lib/low_discrepancy",
    "lib/numeric_limits",
    "lib/shadow",
    "lib/shared_exponent",
    "lib/single_scattering_albedo",
    "lib/specular",
    "lib/tone",
];

/// Profile models in f32: the twins of `subsurface-profile`'s.
///
/// A module `profiles/<model>` defines `<model>_profile`, `<model>_area_pdf`, `<model>_radial_pdf`,
/// `<model>_radial_cdf` and `<model>_sample_radius`; lengths in mm. `gaussian_sum_area_pdf`,
/// `gaussian_sum_radial_cdf` and the search of a table for a radius come from the compiler, which writes them out to the
/// length that a material set needs.
pub const PROFILES: &[Module] = modules![
    "profiles/burley",
    "profiles/exponential_dipole",
    "profiles/gaussian_sum",
    "profiles/polynomial",
    "profiles/tabulated",
    "profiles/two_exponential_dipole",
];

/// What a profile is plugged into.
pub const KERNELS: &[Module] = modules![
    "kernels/block",
    "kernels/dense",
    "kernels/far_field",
    "kernels/importance_sampled",
    "kernels/input_pixel",
    "kernels/interleaved",
    "kernels/material",
    "kernels/near_field",
    "kernels/packed_pixel",
    "kernels/profile_curve",
    "kernels/rejection",
    "kernels/separable",
    "kernels/surface_point",
    "kernels/translucent_pixel",
];

/// Passes with their bindings and entry points.
///
/// Linked with the parts of the subsurface pass that all kernels share, `passes/<kernel>` is the fragment path of a
/// kernel and `passes/<kernel>_compute` its compute path. Kernels of one stage share both, `passes/single_stage` and
/// `passes/single_stage_compute`, and their `passes/<kernel>` holds what differs. The parts of two kernels bear the
/// same names.
pub const PASSES: &[Module] = modules![
    "passes/composite",
    "passes/dense",
    "passes/distance",
    "passes/gbuffer",
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
];
