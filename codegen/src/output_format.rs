//! Formats that the compute path can write.

/// Format of the texture that the compute path writes: WGSL names it, so it belongs to the kernel module. The fragment
/// path writes to any target.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum OutputFormat {
    /// 8 bytes per pixel, 11 bits of precision: enough for radiance.
    #[default]
    Rgba16Float,
    /// 16 bytes per pixel, for measurements.
    Rgba32Float,
}

impl OutputFormat {
    /// Name in WGSL: `rgba16float` or `rgba32float`.
    #[must_use]
    pub fn wgsl(self) -> &'static str {
        match self {
            Self::Rgba16Float => "rgba16float",
            Self::Rgba32Float => "rgba32float",
        }
    }
}
