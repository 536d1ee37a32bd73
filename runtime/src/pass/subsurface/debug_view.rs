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
    /// Every view.
    pub const ALL: [Self; 6] =
        [Self::Taps, Self::FilterRadius, Self::RejectedEnergy, Self::NearShare, Self::Variance, Self::Tiles];

    /// The view's name on command lines.
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

    /// The shader's `DEBUG_…` number.
    pub(super) const fn number(self) -> u32 {
        match self {
            Self::Taps => 1,
            Self::FilterRadius => 2,
            Self::RejectedEnergy => 3,
            Self::NearShare => 4,
            Self::Variance => 5,
            Self::Tiles => 6,
        }
    }
}
