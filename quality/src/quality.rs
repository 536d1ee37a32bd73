//! How good a kernel has to be.

/// How good a kernel has to be: the error that is allowed.
///
/// It is a root mean square over a fixed family of tests, as a fraction of the white level;
/// [`QualityReport::error`](crate::QualityReport::error) says which.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Quality {
    /// At most this error, more than 0 and less than 1.
    MaxError(f64),
    /// At most the error of a tier.
    Tier(Tier),
}

impl Quality {
    /// The largest error allowed.
    #[must_use]
    pub fn target(self) -> f64 {
        match self {
            Self::MaxError(error) => error,
            Self::Tier(tier) => tier.target(),
        }
    }
}

/// Steps of quality: each of half the error of the one before, the last of what the kernels for frames reach with the
/// ready-made materials.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Tier {
    /// An error of 0.04.
    Low,
    /// An error of 0.02.
    Medium,
    /// An error of 0.01.
    High,
    /// An error of 0.009.
    Ultra,
}

impl Tier {
    /// All of them, the worst first.
    pub const ALL: [Self; 4] = [Self::Low, Self::Medium, Self::High, Self::Ultra];

    /// The error that it allows.
    #[must_use]
    pub fn target(self) -> f64 {
        match self {
            Self::Low => 0.04,
            Self::Medium => 0.02,
            Self::High => 0.01,
            Self::Ultra => 0.009,
        }
    }

    /// Its name, as in RON and in the generated enum.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Low => "Low",
            Self::Medium => "Medium",
            Self::High => "High",
            Self::Ultra => "Ultra",
        }
    }
}
