//! What the subsurface pass can show in place of its result.

/// What the pass can show in place of the diffused irradiance.
///
/// The numbers go from 0 to 1 and are linear: nothing encodes them as sRGB. Most views draw one number `v` as heat, from
/// black (0) over red (1/3) and yellow (2/3) to white (1): red is `3v`, green `3v − 1`, blue `3v − 2`, each clamped. Alpha
/// is 1 on pixels that scatter and 0 on all others, which are black in every view but [`Tiles`](Self::Tiles).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum DebugView {
    /// Taps per pixel as heat, `log₂(1 + taps) / log₂ 129`: black is none, white 128 and more, of every estimator. One tap
    /// is dark red (0.14), four are red (0.33), 17 orange (0.59). Separable estimators count both passes; `Dense`, which reads
    /// all pixels in reach, is soon white.
    Taps,
    /// Radius that holds 99.7 % of the widest channel's light, pixels, as heat, `log₂(1 + radius) / log₂ 129`: black is 0,
    /// white 128 and more.
    FilterRadius,
    /// Share of the widest channel's light that material, distance or normal keep away, as heat: black is none, white all.
    /// 64 taps estimate it.
    RejectedEnergy,
    /// Share of the light that comes from the pixel and its eight neighbours, 0 to 1: red, green and blue are the three
    /// channels'.
    NearShare,
    /// Standard deviation of single taps over their mean, in the widest channel, as heat: where noise would come from. Black
    /// is 0, white 1 and more. 64 taps estimate it.
    Variance,
    /// Tiles of 16×16 pixels: green (0.1, 0.4, 0.15) where the compute path visits them, dark blue (0.05, 0.05, 0.1) where
    /// it does not, 0.4 brighter where the pixel scatters, black along their upper and left borders. This view keeps its
    /// colours where alpha is 0.
    Tiles,
}

impl DebugView {
    /// Entry point of the debug views in a module.
    pub const ENTRY_POINT: &'static str = "debug_fragment";

    /// Every view, in the order of its number.
    pub const ALL: [Self; 6] =
        [Self::Taps, Self::FilterRadius, Self::RejectedEnergy, Self::NearShare, Self::Variance, Self::Tiles];

    /// The view's name on command lines.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Taps => "taps",
            Self::FilterRadius => "filter-radius",
            Self::RejectedEnergy => "rejected-energy",
            Self::NearShare => "near-share",
            Self::Variance => "variance",
            Self::Tiles => "tiles",
        }
    }

    /// The constant of the shaders that holds its number.
    #[must_use]
    pub const fn constant(self) -> &'static str {
        match self {
            Self::Taps => "DEBUG_TAPS",
            Self::FilterRadius => "DEBUG_FILTER_RADIUS",
            Self::RejectedEnergy => "DEBUG_REJECTED_ENERGY",
            Self::NearShare => "DEBUG_NEAR_SHARE",
            Self::Variance => "DEBUG_VARIANCE",
            Self::Tiles => "DEBUG_TILES",
        }
    }

    /// Its number in the shaders, from 1: 0 is no debug view.
    #[must_use]
    pub const fn number(self) -> u32 {
        self as u32 + 1
    }
}
