//! Which estimator a kernel module holds.

/// How light is gathered: what the compiler was told to generate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum KernelKind {
    /// One tap per stratum of the profile's radii, turned per pixel (Liang et al. 2023, eq. 22).
    ImportanceSampled,
    /// Two passes along one axis each (Jimenez et al. 2015).
    Separable,
    /// Near field per pixel, far field sampled once per 2×2 pixels and interleaved between them.
    Interleaved,
    /// Every pixel within the filter radius: the reference.
    Dense,
}

impl KernelKind {
    /// Every kind.
    pub const ALL: [Self; 4] = [Self::ImportanceSampled, Self::Separable, Self::Interleaved, Self::Dense];

    /// The kind's name in material files and messages.
    pub const fn name(self) -> &'static str {
        match self {
            Self::ImportanceSampled => "ImportanceSampled",
            Self::Separable => "Separable",
            Self::Interleaved => "Interleaved",
            Self::Dense => "Dense",
        }
    }

    /// Whether a first stage leaves something for a second one.
    pub(crate) const fn has_two_stages(self) -> bool {
        matches!(self, Self::Separable | Self::Interleaved)
    }

    /// Whether the stages read pixels that were packed before: `PACKS_PIXELS` of the shaders.
    pub(crate) const fn packs_pixels(self) -> bool {
        matches!(self, Self::Interleaved)
    }
}
