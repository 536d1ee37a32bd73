//! What kernels are fast on.

/// A class of devices: on each of them the kernels' times are in other ratios.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Device {
    /// GPUs of AMD's RDNA architectures, measured on Navi 21 and GFX1100; the nearest to other GPUs of today.
    #[default]
    Rdna,
    /// GPUs of AMD's GCN architectures, measured on Polaris 10 and Vega 10.
    Gcn,
    /// A driver that runs shaders on a CPU, measured on Mesa's llvmpipe.
    Software,
}

impl Device {
    /// All of them, the default first.
    pub const ALL: [Self; 3] = [Self::Rdna, Self::Gcn, Self::Software];

    /// Its name, as in RON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Rdna => "Rdna",
            Self::Gcn => "Gcn",
            Self::Software => "Software",
        }
    }
}
