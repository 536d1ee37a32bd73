//! Light on its way to a pixel: the twin of `shaders/gather/gathered.wgsl`.

use subsurface_kernel::constants::SMALLEST_ENERGY;

/// One number per channel: red, green, blue.
pub(crate) type Rgb = [f64; 3];

/// Light that was gathered, and the energy that was found for it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Gathered {
    /// Σ wᵢ Eᵢ
    pub(crate) irradiance: Rgb,
    /// Σ wᵢ
    pub(crate) weight: Rgb,
}

impl Gathered {
    /// Adds white or grey light.
    pub(crate) fn add(&mut self, weight: Rgb, irradiance: Rgb) {
        for channel in 0..3 {
            self.irradiance[channel] += weight[channel] * irradiance[channel];
            self.weight[channel] += weight[channel];
        }
    }

    /// Adds another light, `share` of it.
    pub(crate) fn add_share(&mut self, other: &Self, share: f64) {
        for channel in 0..3 {
            self.irradiance[channel] += share * other.irradiance[channel];
            self.weight[channel] += share * other.weight[channel];
        }
    }

    /// What a pixel of irradiance `own` makes of it; `returned` gives missing energy to the pixel.
    pub(crate) fn diffused(&self, own: Rgb, returned: bool) -> Rgb {
        let least = if returned { 1.0 } else { SMALLEST_ENERGY };
        std::array::from_fn(|channel| {
            let weight = self.weight[channel];
            let missing = (least - weight).max(0.0);
            (self.irradiance[channel] + missing * own[channel]) / (weight + missing)
        })
    }
}

/// Between `own` and `diffused`.
pub(crate) fn mixed(own: Rgb, diffused: Rgb, share: f64) -> Rgb {
    std::array::from_fn(|channel| own[channel] + share * (diffused[channel] - own[channel]))
}
