//! What the subsurface pass can show in place of its result.

/// What the pass can show in place of the diffused irradiance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum DebugView {
    /// Taps per pixel, on a logarithmic scale that ends at their largest number.
    Taps,
    /// Radius that holds 99.7 % of the widest channel's light, on a logarithmic scale that ends at 128 pixels.
    FilterRadius,
    /// Share of the light that material, distance or normal keep away.
    RejectedEnergy,
    /// Share of the light, per channel, that comes from the pixel and its eight neighbours.
    NearShare,
    /// Standard deviation of single taps over their mean: where noise would come from.
    Variance,
    /// Tiles that the compute path visits, in green, and the pixels that scatter, brighter.
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
