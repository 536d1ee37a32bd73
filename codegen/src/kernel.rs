//! The kernels: how a pixel gathers the light that arrives around it.

use std::fmt;

/// How a pixel gathers the light that arrives around it. Each is generated for whatever profiles a set uses.
///
/// A material set names one in RON (`kernel: Interleaved(taps: 8)`), [`Compiler::kernel`](crate::Compiler::kernel)
/// overrides it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Kernel {
    /// Radii drawn from the profile by low-discrepancy points, every tap weighted per channel (Liang et al. 2023,
    /// eq. 22). Noise falls with the taps.
    ImportanceSampled {
        /// Taps per pixel, 1 to 4096.
        taps: u32,
    },
    /// Two passes of one dimension, weights from the profile's line spread (Jimenez et al. 2015, "Separable Subsurface
    /// Scattering"). Without noise, and wrong in two dimensions.
    Separable {
        /// Taps per pass, an odd number from 3 to 65.
        taps: u32,
        /// Whether each pixel turns its pair of axes: stars become noise.
        rotated: bool,
    },
    /// The energy within the pixel's own footprint stays there; what lies beyond comes from a lattice of taps that
    /// neighbouring pixels share.
    Interleaved {
        /// Taps per pixel, 1 to 64.
        taps: u32,
    },
    /// Every pixel in the filter radius: slow, exact, what the others are measured against.
    Dense,
}

impl Default for Kernel {
    fn default() -> Self {
        Self::Interleaved { taps: Self::DEFAULT_INTERLEAVED_TAPS }
    }
}

impl Kernel {
    /// Taps where RON gives none. Neighbours share interleaved taps, so that few do; 17 is what the literature uses for
    /// the other two.
    pub(crate) const DEFAULT_INTERLEAVED_TAPS: u32 = 4;
    pub(crate) const DEFAULT_TAPS: u32 = 17;

    /// Name as in RON: `ImportanceSampled`, `Separable`, `Interleaved` or `Dense`.
    #[must_use]
    pub fn kind_name(self) -> &'static str {
        match self {
            Self::ImportanceSampled { .. } => "ImportanceSampled",
            Self::Separable { .. } => "Separable",
            Self::Interleaved { .. } => "Interleaved",
            Self::Dense => "Dense",
        }
    }

    /// Taps per pixel (of [`Separable`](Self::Separable): per pass). [`Dense`](Self::Dense) reads every pixel in reach
    /// and says 1, since 0 turns a kernel off.
    #[must_use]
    pub fn taps(self) -> u32 {
        match self {
            Self::ImportanceSampled { taps } | Self::Separable { taps, .. } | Self::Interleaved { taps } => {
                taps
            }
            Self::Dense => 1,
        }
    }

    /// Stem of its shader modules: `passes/STEM` and, of a kernel with two stages, `passes/STEM_compute`.
    pub(crate) fn stem(self) -> &'static str {
        match self {
            Self::ImportanceSampled { .. } => "importance_sampled",
            Self::Separable { .. } => "separable",
            Self::Interleaved { .. } => "interleaved",
            Self::Dense => "dense",
        }
    }

    /// Whether a stage comes before the last: the far field of blocks, or the blur along the first axis.
    pub(crate) fn has_two_stages(self) -> bool {
        matches!(self, Self::Separable { .. } | Self::Interleaved { .. })
    }

    /// Whether its stages read pixels that an earlier one packed.
    pub(crate) fn packs_pixels(self) -> bool {
        matches!(self, Self::Interleaved { .. })
    }

    /// Whether the passes turn the axes of the kernel per pixel.
    pub(crate) fn is_rotated(self) -> bool {
        matches!(self, Self::Separable { rotated: true, .. })
    }

    /// The numbers of taps that this kind of kernel may have; `None` for one that has no choice.
    pub(crate) fn tap_counts(self) -> Option<TapCounts> {
        match self {
            Self::ImportanceSampled { .. } => Some(TapCounts { least: 1, most: 4096, odd: false }),
            Self::Separable { .. } => Some(TapCounts { least: 3, most: 65, odd: true }),
            Self::Interleaved { .. } => Some(TapCounts { least: 1, most: 64, odd: false }),
            Self::Dense => None,
        }
    }

    /// The numbers that were expected, if the kernel's is none of them.
    pub(crate) fn refused_taps(self) -> Option<TapCounts> {
        self.tap_counts().filter(|counts| !counts.contains(self.taps()))
    }
}

/// As the header of the generated text has it: `Separable, 17 taps, rotated`.
impl fmt::Display for Kernel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.kind_name())?;
        if self.tap_counts().is_some() {
            let taps = self.taps();
            write!(f, ", {taps} tap{}", if taps == 1 { "" } else { "s" })?;
        }
        if self.is_rotated() {
            f.write_str(", rotated")?;
        }
        Ok(())
    }
}

/// Numbers of taps that a kernel may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct TapCounts {
    least: u32,
    most: u32,
    /// A kernel that is symmetric about a centre tap has an odd number.
    odd: bool,
}

impl TapCounts {
    pub(crate) fn contains(self, taps: u32) -> bool {
        (self.least..=self.most).contains(&taps) && !(self.odd && taps.is_multiple_of(2))
    }
}

/// In words that complete "expected …".
impl fmt::Display for TapCounts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kind = if self.odd { "an odd" } else { "a whole" };
        write!(f, "{kind} number from {} to {}", self.least, self.most)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn taps_end_where_their_range_does() {
        type WithTaps = fn(u32) -> Kernel;
        let kernels: [(WithTaps, &[u32], &[u32]); 3] = [
            (|taps| Kernel::ImportanceSampled { taps }, &[1, 2, 4096], &[0, 4097, u32::MAX]),
            (|taps| Kernel::Separable { taps, rotated: false }, &[3, 17, 65], &[0, 1, 2, 4, 64, 66, 67]),
            (|taps| Kernel::Interleaved { taps }, &[1, 4, 64], &[0, 65]),
        ];
        for (kernel, legal, illegal) in kernels {
            for &taps in legal {
                assert_eq!(kernel(taps).refused_taps(), None, "{}", kernel(taps));
            }
            for &taps in illegal {
                assert!(kernel(taps).refused_taps().is_some(), "{}", kernel(taps));
            }
        }
        assert_eq!(Kernel::Dense.refused_taps(), None);
        assert_eq!(Kernel::default().refused_taps(), None);
    }

    #[test]
    fn kernels_in_words() {
        assert_eq!(Kernel::default().to_string(), "Interleaved, 4 taps");
        assert_eq!(Kernel::ImportanceSampled { taps: 1 }.to_string(), "ImportanceSampled, 1 tap");
        assert_eq!(Kernel::Separable { taps: 17, rotated: true }.to_string(), "Separable, 17 taps, rotated");
        assert_eq!(Kernel::Dense.to_string(), "Dense");
    }
}
