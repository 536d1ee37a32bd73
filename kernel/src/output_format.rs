//! Formats that the compute path can write.

/// Format of the texture that the compute path writes. WGSL names it, so a module is written for one; the passes put
/// another into the place that [`KernelModule::output_format_place`](crate::KernelModule::output_format_place) names.
/// The fragment path writes to any colour target.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum OutputFormat {
    /// 4 bytes per pixel, from 0 to 1: irradiance above 1 is cut off.
    Rgba8Unorm,
    /// 8 bytes per pixel, 11 bits of precision: enough for radiance.
    #[default]
    Rgba16Float,
    /// 16 bytes per pixel, for measurements.
    Rgba32Float,
    /// 4 bytes per pixel, 6 bits of precision (blue 5), no alpha; devices need a feature to store it.
    Rg11b10Ufloat,
    /// 4 bytes per pixel, 10 bits from 0 to 1; devices need a feature to store it.
    Rgb10a2Unorm,
    /// 8 bytes per pixel, 16 bits from 0 to 1; devices need a feature to store it.
    Rgba16Unorm,
    /// `Rgba8Unorm` with blue first, as many screens have it; devices need a feature to store it.
    Bgra8Unorm,
}

impl OutputFormat {
    /// Every format.
    pub const ALL: [Self; 7] = [
        Self::Rgba8Unorm,
        Self::Rgba16Float,
        Self::Rgba32Float,
        Self::Rg11b10Ufloat,
        Self::Rgb10a2Unorm,
        Self::Rgba16Unorm,
        Self::Bgra8Unorm,
    ];

    /// Name in WGSL, such as `rgba16float`.
    #[must_use]
    pub const fn wgsl(self) -> &'static str {
        match self {
            Self::Rgba8Unorm => "rgba8unorm",
            Self::Rgba16Float => "rgba16float",
            Self::Rgba32Float => "rgba32float",
            Self::Rg11b10Ufloat => "rg11b10ufloat",
            Self::Rgb10a2Unorm => "rgb10a2unorm",
            Self::Rgba16Unorm => "rgba16unorm",
            Self::Bgra8Unorm => "bgra8unorm",
        }
    }
}
