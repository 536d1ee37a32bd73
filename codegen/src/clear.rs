//! Materials that absorb light and do not scatter it.

/// A material that is clear: light is absorbed on its way through, and refracted where it enters.
#[derive(Clone, Debug, PartialEq)]
pub struct ClearMaterial {
    /// Name, as of a [`Material`](crate::Material).
    pub name: String,
    /// The `///` lines above the material, without the slashes and one following space.
    pub docs: Vec<String>,
    /// Absorption coefficient σ per channel (red, green, blue), per mm, ≥ 0.
    pub absorption_per_mm: [f64; 3],
    /// Refractive index over that of what is outside, in [1, 2]; 1 has no boundary.
    pub refractive_index: f64,
    /// Perceptual roughness of its boundary, in [0, 1].
    pub roughness: f64,
    /// Thickness of the walls of what is hollow, in mm, > 0; `None` for what is filled.
    pub shell_thickness_mm: Option<f64>,
}

impl ClearMaterial {
    /// Least colour that has a finite absorption.
    pub const LEAST_COLOUR: f64 = 1e-6;

    /// Largest absorption coefficient of a file, per mm.
    pub const MOST_ABSORPTION: f64 = 1e12;

    /// σ = −ln(max(c, 10⁻⁶))/d per mm of what lets through a colour `c` at a distance of `d` mm (Akenine-Möller et al.
    /// 2018, "Real-Time Rendering", eq. 14.23).
    #[must_use]
    pub fn absorption_of(colour: f64, at_distance_mm: f64) -> f64 {
        // Not −0 for a colour of 1.
        -colour.max(Self::LEAST_COLOUR).ln() / at_distance_mm + 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_at_a_distance_are_absorptions() {
        // Water and a wine's numbers as Real-Time Rendering prints them, per metre.
        for (colour, per_metre) in [(0.3, 1.2), (0.73, 0.31), (0.63, 0.46)] {
            assert!((1e3 * ClearMaterial::absorption_of(colour, 1e3) - per_metre).abs() < 6e-3, "{colour}");
        }
        for (colour, per_metre) in [(0.7, 0.0892), (0.1, 0.5756)] {
            assert!((1e3 * ClearMaterial::absorption_of(colour, 4e3) - per_metre).abs() < 6e-5, "{colour}");
        }
        assert_eq!(ClearMaterial::absorption_of(1.0, 2.0).to_bits(), 0.0_f64.to_bits());
        assert!((ClearMaterial::absorption_of(0.0, 1.0) - 1e6_f64.ln()).abs() < 1e-12);
    }
}
