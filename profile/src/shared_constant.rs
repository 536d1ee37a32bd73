//! Coefficients of formulas that have a twin in WGSL: the compiler declares them there.

use crate::{dipole, half_space, single_scattering_albedo, slab};

/// Coefficients that stand in Rust and in WGSL.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct SharedConstant {
    /// Name in WGSL.
    pub name: &'static str,
    /// What they are.
    pub docs: &'static str,
    /// Three or four numbers, a vector in WGSL.
    pub values: &'static [f64],
}

/// All of them.
pub const SHARED_CONSTANTS: &[SharedConstant] = &[
    SharedConstant {
        name: "SEARCHLIGHT_ALBEDO",
        docs: "c₁, c₂, c₃ of the single-scattering albedo for perpendicular entry: q = (1 − A)(1 + c₁A) / (1 + c₂A + c₃A²).",
        values: &single_scattering_albedo::SEARCHLIGHT,
    },
    SharedConstant {
        name: "DIFFUSE_ALBEDO",
        docs: "c₁, c₂, c₃ of the same for diffuse entry.",
        values: &single_scattering_albedo::DIFFUSE,
    },
    SharedConstant {
        name: "HALF_SPACE_ANGLES",
        docs: "p₀, p₁ − 1 and p₂ of a half-space's albedo by angle, over 1 − γ: coefficients of 1.",
        values: &half_space::ANGLES[0],
    },
    SharedConstant {
        name: "HALF_SPACE_SLOPES",
        docs: "The same: coefficients of γ.",
        values: &half_space::ANGLES[1],
    },
    SharedConstant {
        name: "HALF_SPACE_BENDS",
        docs: "The same: coefficients of γ².",
        values: &half_space::ANGLES[2],
    },
    SharedConstant {
        name: "HALF_SPACE_MEAN",
        docs: "1/⟨H⟩ − γ of a half-space, over 1 − γ: coefficients of 1, γ and γ².",
        values: &half_space::MEAN,
    },
    SharedConstant {
        name: "INTERNAL_REFLECTANCE",
        docs: "F_dr from η = 1 on, as coefficients of η⁻², η⁻¹, 1 and η (Jensen et al. 2001, after Groenhuis et al. 1983).",
        values: &dipole::INTERNAL_REFLECTANCE,
    },
    SharedConstant {
        name: "INTERNAL_REFLECTANCE_BELOW_1",
        docs: "F_dr below η = 1, as coefficients of 1, η⁻¹, η⁻² and η⁻³ (Egan and Hilgeman 1979).",
        values: &dipole::INTERNAL_REFLECTANCE_BELOW_1,
    },
    SharedConstant {
        name: "SLAB_STRENGTH",
        docs: "s₁, s₂, s₃ of a slab's strength: k = 2 (1 + s₁A) / (1 + s₂A + s₃A²).",
        values: &slab::STRENGTH,
    },
];
