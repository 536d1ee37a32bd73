//! Materials after every name is resolved and every value is checked: what the back half of the compiler reads.

use std::collections::BTreeMap;

use subsurface_kernel::constants::{
    COUPLING_ENTRY, COUPLING_FULL, COUPLING_NONE, DIFFUSE_DISNEY, DIFFUSE_EVERYWHERE,
    DIFFUSE_HANRAHAN_KRUEGER, DIFFUSE_HAPKE, DIFFUSE_LAMBERT, DIFFUSE_LOMMEL_SEELIGER, DIFFUSE_OREN_NAYAR,
    DIFFUSE_SEARCHLIGHT, DIFFUSE_SHIRLEY,
};
use subsurface_profile::single_scattering_albedo::{
    Entry, diffuse_per_mean_free_path, from_surface_albedo_below,
};
use subsurface_profile::{Length, Model};

use crate::clear::ClearMaterial;
use crate::quality_request::QualityRequest;
use crate::source::Span;
use subsurface_kernel::Estimator;
use subsurface_kernel::Rejection;
use subsurface_quality::gather::curve::LARGEST_SURFACE_ALBEDO;

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
    /// Power of the surface albedo that light is multiplied by where it enters, in [0, 1]; where it leaves, it is
    /// multiplied by the rest: 0 blurs no texture, 1 blurs it as the light (d'Eon and Luebke 2007).
    pub surface_albedo_mix: f64,
    /// Refractive index of the medium over that of what is outside, in [1, 2], where the material gives its coefficients:
    /// the surface albedo is then that of a medium below such a boundary, per energy that entered.
    pub refractive_index: Option<f64>,
    /// Fresnel reflectance at normal incidence F0, in [0, 1].
    pub reflectance_at_normal: f64,
    /// Perceptual roughness of the specular lobe, in [0, 1].
    pub roughness: f64,
    /// A second specular lobe over the same boundary; `None` for one alone.
    pub second_lobe: Option<SecondLobe>,
    /// How the diffuse light knows of the specular lobe.
    pub coupling: Coupling,
    /// How diffuse light depends on the angles at which it enters and leaves.
    pub diffuse: DiffuseLobe,
    /// Factor on the light that comes through thin parts, ≥ 0; 1 is what `transmittance` says.
    pub transmission_strength: f64,
    /// Whether what comes through diffuses below the surface that it leaves by, as what enters there does.
    pub transmission_diffused: bool,
    /// How much light comes through thin parts.
    pub transmittance: Transmittance,
    /// Thickness of a material that is a sheet, in mm, > 0; `None` for one that fills what it bounds.
    pub thin_thickness_mm: Option<f64>,
    /// The word `Material` in the file that declares it.
    pub span: Span,
}

impl Material {
    /// Mean free path ℓ = 1/σt per channel, in mm, by which a slab's light falls.
    ///
    /// Where the material gives the diffuse one, that of its own surface albedo; one above 0.999 counts as 0.999, as it
    /// does for the profile's curves: at 1 the diffuse mean free path has no end.
    #[must_use]
    pub fn slab_mean_free_path_mm(&self) -> [f64; 3] {
        let length = self.mean_free_path_mm;
        match self.profile.model.length() {
            Length::MeanFreePath => length,
            Length::DiffuseMeanFreePath => [0, 1, 2].map(|channel: usize| {
                let albedo = self.surface_albedo[channel].min(LARGEST_SURFACE_ALBEDO);
                let index = self.refractive_index.unwrap_or(1.0);
                let alpha = from_surface_albedo_below(self.entry(), index, albedo);
                length[channel] / diffuse_per_mean_free_path(alpha)
            }),
        }
    }
}

impl Material {
    /// How the light enters that the surface albedo is for; perpendicular where neither lobe nor profile says.
    #[must_use]
    pub fn entry(&self) -> Entry {
        match self.diffuse {
            DiffuseLobe::Chandrasekhar(entry) => entry,
            _ => self.profile.model.entry().unwrap_or(Entry::Searchlight),
        }
    }

    /// Refractive index of the boundary that the reflectance at normal incidence F0 = ((η − 1)/(η + 1))² says; that of a
    /// mirror is 19.
    #[must_use]
    pub fn boundary_index(&self) -> f64 {
        let root = self.reflectance_at_normal.sqrt().min(0.9);
        (1.0 + root) / (1.0 - root)
    }
}

/// A specular lobe beside the first: f = (1 - w) f(r₁) + w f(r₂).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SecondLobe {
    /// Its perceptual roughness r₂, in [0, 1].
    pub roughness: f64,
    /// Its share w of both, in [0, 1].
    pub weight: f64,
}

/// How diffuse light knows of the specular lobe above it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Coupling {
    /// Not at all.
    None,
    /// What a mirror of the same reflectance sends back does not enter: (1 - F(μ)), Real-Time Rendering 4, eq. 9.62.
    Entry,
    /// What the lobe itself sends back does not enter, and as much is lost where light leaves: (1 - E(μ_l))(1 - E(μ_v))
    /// over (1 - Ē), Real-Time Rendering 4, eq. 9.65. Reciprocal; conserves energy at every roughness under
    /// [`DiffuseLobe::Lambert`], and nearly under the other.
    #[default]
    Full,
}

impl Coupling {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::None, Self::Entry, Self::Full];

    /// The word in RON.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "None",
            Self::Entry => "Entry",
            Self::Full => "Full",
        }
    }

    /// The number in the parameter table.
    pub(crate) const fn number(self) -> u32 {
        match self {
            Self::None => COUPLING_NONE,
            Self::Entry => COUPLING_ENTRY,
            Self::Full => COUPLING_FULL,
        }
    }
}

/// How diffuse light depends on the angles at which it enters and leaves.
///
/// The formulas are in `shaders/light/diffuse_lobe.wgsl`, as f π/A of a BRDF f.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DiffuseLobe {
    /// Not at all.
    Lambert,
    /// As of Chandrasekhar's half-space: [`HalfSpace`](subsurface_profile::HalfSpace). The profile is for this entry.
    Chandrasekhar(Entry),
    /// As below a mirror of the material's reflectance, Real-Time Rendering 4, eq. 9.64 (Shirley et al. 1997).
    Shirley,
    /// As of light that is scattered once (Lommel 1889, Seeliger 1887), its mean that of the surface albedo.
    LommelSeeliger {
        /// Whether cosines are those below the boundary: f(μ_l′, μ_v′)/η².
        refracted: bool,
    },
    /// As of dust (Hapke 1981).
    Hapke {
        /// B₀, by how much light that goes straight back is brighter, 0 to 1.
        opposition: f64,
        /// Half the width of that, as the tangent of half an angle, above 0.
        opposition_width: f64,
        /// Mean cosine of the angle at which a grain scatters, −0.95 to 0.95.
        anisotropy: f64,
        /// Whether cosines are those below the boundary.
        refracted: bool,
    },
    /// As of a layer below a boundary that scatters light once (Hanrahan and Krueger 1993).
    HanrahanKrueger {
        /// Mean cosine of the angle at which it scatters, −0.95 to 0.95.
        anisotropy: f64,
    },
    /// As of a rough surface of Lambert's facets (Oren and Nayar 1994).
    OrenNayar {
        /// σ, standard deviation of the facets' slopes in radians, 0 to 1.
        sigma: f64,
    },
    /// As of Burley 2012, "Physically Based Shading at Disney".
    Disney {
        /// Share of the flatter form, 0 to 1.
        subsurface: f64,
    },
}

impl DiffuseLobe {
    /// The words in RON.
    pub(crate) const WORDS: [&'static str; 9] = [
        "Lambert",
        "Coupled",
        "Chandrasekhar",
        "Shirley",
        "LommelSeeliger",
        "Hapke",
        "HanrahanKrueger",
        "OrenNayar",
        "Disney",
    ];

    /// The word in RON.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Lambert => "Lambert",
            Self::Chandrasekhar(_) => "Chandrasekhar",
            Self::Shirley => "Shirley",
            Self::LommelSeeliger { .. } => "LommelSeeliger",
            Self::Hapke { .. } => "Hapke",
            Self::HanrahanKrueger { .. } => "HanrahanKrueger",
            Self::OrenNayar { .. } => "OrenNayar",
            Self::Disney { .. } => "Disney",
        }
    }

    /// Whether it is a BRDF of its own, beside the half-space's and Lambert's.
    pub(crate) const fn is_brdf(self) -> bool {
        !matches!(self, Self::Lambert | Self::Chandrasekhar(_))
    }

    /// Its numbers, as the shaders take them.
    pub(crate) const fn shape(self) -> [f64; 3] {
        match self {
            // The sign of the second says whether cosines are refracted.
            Self::LommelSeeliger { refracted } => [0.0, if refracted { -1.0 } else { 1.0 }, 0.0],
            Self::Hapke { opposition, opposition_width, anisotropy, refracted } => {
                [opposition, if refracted { -opposition_width } else { opposition_width }, anisotropy]
            }
            Self::HanrahanKrueger { anisotropy } => [0.0, -1.0, anisotropy],
            Self::OrenNayar { sigma } => [sigma, 0.0, 0.0],
            Self::Disney { subsurface } => [subsurface, 0.0, 0.0],
            Self::Lambert | Self::Chandrasekhar(_) | Self::Shirley => [0.0; 3],
        }
    }

    /// What a material with this model has if it does not say.
    pub(crate) fn of_model(model: &Model) -> Self {
        model.entry().map_or(Self::Lambert, Self::Chandrasekhar)
    }

    /// The number in the parameter table.
    pub(crate) const fn number(self) -> u32 {
        match self {
            Self::Lambert => DIFFUSE_LAMBERT,
            Self::Chandrasekhar(Entry::Searchlight) => DIFFUSE_SEARCHLIGHT,
            Self::Chandrasekhar(Entry::Diffuse) => DIFFUSE_EVERYWHERE,
            Self::Shirley => DIFFUSE_SHIRLEY,
            Self::LommelSeeliger { .. } => DIFFUSE_LOMMEL_SEELIGER,
            Self::Hapke { .. } => DIFFUSE_HAPKE,
            Self::HanrahanKrueger { .. } => DIFFUSE_HANRAHAN_KRUEGER,
            Self::OrenNayar { .. } => DIFFUSE_OREN_NAYAR,
            Self::Disney { .. } => DIFFUSE_DISNEY,
        }
    }
}

/// How much light comes through a thickness of a material.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Transmittance {
    /// As much as through a slab: [`Slab`](subsurface_profile::Slab).
    Slab,
    /// The share of the profile's light beyond that radius, times the surface albedo: A·(1 − cdf(t)), which is what
    /// Jimenez et al. 2010 and those after them take. Two to seven times darker than a slab some mean free paths thick.
    Profile,
}

impl Transmittance {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Slab, Self::Profile];

    /// The word in RON.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Slab => "Slab",
            Self::Profile => "Profile",
        }
    }

    /// The one of this name.
    pub(crate) fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|law| law.name() == name)
    }

    /// What a material with this model has if it does not say: a slab, where the model's lengths are those of the
    /// medium.
    pub(crate) fn of_model(model: &Model) -> Self {
        if model.dependence().on_length() { Self::Slab } else { Self::Profile }
    }
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
    /// The clear materials, sorted by name: they do not scatter, and are no part of the kernel.
    pub clear: Vec<ClearMaterial>,
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
