//! Materials after every name is resolved and every value is checked: what the back half of the compiler reads.

use std::collections::BTreeMap;

use subsurface_profile::Model;

use crate::quality_request::QualityRequest;
use crate::source::Span;
use subsurface_kernel::Estimator;
use subsurface_kernel::Rejection;

/// Everything a kernel needs to know of one material. All values are checked: finite, in range, representable in
/// `f32`.
#[derive(Clone, Debug)]
pub struct Material {
    /// Name: an identifier in both WGSL and Rust, at most 64 characters, whose CamelCase form is unique in its set.
    pub name: String,
    /// The `///` lines above the material, without the slashes and one following space.
    pub docs: Vec<String>,
    /// The radial profile model and where it came from.
    pub profile: ResolvedProfile,
    /// Length that scales the profile, per channel (red, green, blue), in mm, > 0: the mean free path ℓ = 1/σt or the
    /// diffuse mean free path ℓ_d = 1/σtr, as [`Model::length`] says.
    pub mean_free_path_mm: [f64; 3],
    /// Surface albedo A = ∫ R(r) 2πr dr per channel, in [0, 1].
    pub surface_albedo: [f64; 3],
    /// Fresnel reflectance at normal incidence F0, in [0, 1].
    pub reflectance_at_normal: f64,
    /// Perceptual roughness of the specular lobe, in [0, 1].
    pub roughness: f64,
    /// Factor on the light that comes through thin parts, ≥ 0; 1 is the model's own transmittance.
    pub transmission_strength: f64,
    /// The word `Material` in the file that declares it.
    pub span: Span,
}

/// A profile model with its origin.
#[derive(Clone, Debug)]
pub struct ResolvedProfile {
    /// Stem of the profile file (`burley_diffuse` for `profiles/burley_diffuse.ron`), after aliases are followed;
    /// `None` for a model written inline.
    pub stem: Option<String>,
    /// The model and its coefficients.
    pub model: Model,
    /// The `///` lines above the model in its file.
    pub docs: Vec<String>,
    /// The model's name in the file that writes it out, or the string that names a built-in profile.
    pub span: Span,
    /// Where the file writes each coefficient, by path (`terms[2].variance_mm2`); empty for a built-in profile.
    pub coefficient_spans: BTreeMap<String, Span>,
}

/// A set of materials that compiles to one kernel module.
#[derive(Clone, Debug, Default)]
pub struct MaterialSet {
    /// The materials, sorted by name; an index in this list is the material's id on the GPU.
    pub materials: Vec<Material>,
    /// The estimator that the set's own file asks for, or the default one.
    pub estimator: Estimator,
    /// Which taps the estimator leaves out, as the set's own file says, or the default.
    pub rejection: Rejection,
    /// What the set's own file asks of the estimator in place of a number of taps.
    pub quality: Option<QualityRequest>,
}

impl MaterialSet {
    /// The material of this name.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&Material> {
        self.index_of(name).map(|index| &self.materials[index])
    }

    /// Index of the material of this name: its id on the GPU.
    #[must_use]
    pub fn index_of(&self, name: &str) -> Option<usize> {
        self.materials.binary_search_by(|material| material.name.as_str().cmp(name)).ok()
    }
}
