//! Layers, and the stack that they form.

use super::endless::expected_scatterings;
use super::layer_error::LayerError;

/// Beyond any known medium; keeps squares of index ratios far from overflow.
const REFRACTIVE_INDICES: std::ops::RangeInclusive<f64> = 0.01..=100.0;
/// Keeps every product of a coefficient and a length finite.
const LARGEST: f64 = 1e12;
/// The largest count that MCML's 16-bit integers can hold.
pub(super) const LARGEST_COUNT: usize = 32_767;

/// One homogeneous layer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layer {
    refractive_index: f64,
    absorption_coefficient: f64,
    scattering_coefficient: f64,
    anisotropy: f64,
    thickness: f64,
}

impl Layer {
    /// A layer in the order of MCML's input line: `n`, μa and μs in cm⁻¹, g, thickness in cm.
    ///
    /// A thickness of 10⁸ cm is MCML's way to write a semi-infinite layer. A layer with μa = μs = 0 is clear, like glass.
    ///
    /// # Errors
    ///
    /// [`LayerError`] names the first value outside its range: n in [0.01, 100], μa and μs in [0, 10¹²], g in [−1, 1],
    /// thickness in (0, 10¹²].
    pub fn new(
        refractive_index: f64,
        absorption_coefficient: f64,
        scattering_coefficient: f64,
        anisotropy: f64,
        thickness: f64,
    ) -> Result<Self, LayerError> {
        check_refractive_index(refractive_index)?;
        if !(0.0..=LARGEST).contains(&absorption_coefficient) {
            return Err(LayerError::AbsorptionCoefficient { value: absorption_coefficient });
        }
        if !(0.0..=LARGEST).contains(&scattering_coefficient) {
            return Err(LayerError::ScatteringCoefficient { value: scattering_coefficient });
        }
        if !(-1.0..=1.0).contains(&anisotropy) {
            return Err(LayerError::Anisotropy { value: anisotropy });
        }
        if !(thickness > 0.0 && thickness <= LARGEST) {
            return Err(LayerError::Thickness { value: thickness });
        }
        Ok(Self { refractive_index, absorption_coefficient, scattering_coefficient, anisotropy, thickness })
    }

    /// Refractive index n.
    pub fn refractive_index(&self) -> f64 {
        self.refractive_index
    }

    /// Absorption coefficient μa, cm⁻¹.
    pub fn absorption_coefficient(&self) -> f64 {
        self.absorption_coefficient
    }

    /// Scattering coefficient μs, cm⁻¹.
    pub fn scattering_coefficient(&self) -> f64 {
        self.scattering_coefficient
    }

    /// Mean cosine g of the Henyey–Greenstein phase function.
    pub fn anisotropy(&self) -> f64 {
        self.anisotropy
    }

    /// Thickness, cm.
    pub fn thickness(&self) -> f64 {
        self.thickness
    }

    /// Extinction coefficient μa + μs, cm⁻¹.
    pub fn extinction_coefficient(&self) -> f64 {
        self.absorption_coefficient + self.scattering_coefficient
    }

    /// How long a packet wanders in it, see `endless`.
    fn expected_scatterings(&self, trap: f64) -> f64 {
        expected_scatterings(self.scattering_coefficient, self.absorption_coefficient, self.thickness, trap)
    }

    /// Whether light passes unchanged, as through glass.
    pub fn is_clear(&self) -> bool {
        self.extinction_coefficient() == 0.0
    }
}

/// Layers from the top down, and the refractive indices of the half-spaces above and below.
#[derive(Debug, Clone, PartialEq)]
pub struct LayerStack {
    above: f64,
    layers: Vec<Layer>,
    below: f64,
}

impl LayerStack {
    /// A stack of 1 to 32 767 layers.
    ///
    /// # Errors
    ///
    /// [`LayerError`] when an index is outside [0.01, 100], when there is no layer, and when a layer absorbs so
    /// little and is so thick, or of so large an index, that its packets would not come to an end (above 10⁴ expected scattering events).
    pub fn new(above: f64, layers: Vec<Layer>, below: f64) -> Result<Self, LayerError> {
        check_refractive_index(above)?;
        check_refractive_index(below)?;
        if layers.is_empty() || layers.len() > LARGEST_COUNT {
            return Err(LayerError::LayerCount { count: layers.len() });
        }
        // Light leaves on the side where the smallest index on its way is larger.
        let mut lowest_below = vec![below; layers.len()];
        for index in (1..layers.len()).rev() {
            lowest_below[index - 1] = lowest_below[index].min(layers[index].refractive_index());
        }
        let mut lowest_above = above;
        for (index, layer) in layers.iter().enumerate() {
            let outside = lowest_above.max(lowest_below[index]);
            lowest_above = lowest_above.min(layer.refractive_index());
            let scatterings = layer.expected_scatterings(layer.refractive_index() / outside);
            if scatterings > 1e4 {
                return Err(LayerError::Endless { layer: index + 1, scatterings });
            }
        }
        Ok(Self { above, layers, below })
    }

    /// Refractive index of the half-space from which the beam comes.
    pub fn refractive_index_above(&self) -> f64 {
        self.above
    }

    /// The layers, from the top down.
    pub fn layers(&self) -> &[Layer] {
        &self.layers
    }

    /// Refractive index of the half-space below.
    pub fn refractive_index_below(&self) -> f64 {
        self.below
    }
}

pub(super) fn check_refractive_index(value: f64) -> Result<(), LayerError> {
    if REFRACTIVE_INDICES.contains(&value) { Ok(()) } else { Err(LayerError::RefractiveIndex { value }) }
}
