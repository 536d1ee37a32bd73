//! The sun, and whatever else is far away.

use glam::Vec3;

use super::unit;

/// A light at infinity.
///
/// ```
/// use subsurface_runtime::DirectionalLight;
///
/// let from_the_left = DirectionalLight { direction: [1.0, 0.0, 0.0], ..Default::default() };
/// assert_eq!(from_the_left.irradiance, [std::f32::consts::PI; 3]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectionalLight {
    /// Direction in which the light travels, world space; any length but 0. By default (0, −1, 0), from above.
    pub direction: [f32; 3],
    /// Irradiance on a surface that faces the light, linear red, green, blue. π, the default, makes a white diffuse
    /// surface white.
    pub irradiance: [f32; 3],
    /// Angle that the light spans in the sky, in radians, 0 to 3: its shadows are as soft. 0, the default, is a point;
    /// the sun has 0.0093.
    pub angular_diameter_radians: f32,
}

impl Default for DirectionalLight {
    fn default() -> Self {
        Self {
            direction: [0.0, -1.0, 0.0],
            irradiance: [std::f32::consts::PI; 3],
            angular_diameter_radians: 0.0,
        }
    }
}

impl DirectionalLight {
    pub(super) fn direction(&self) -> Vec3 {
        unit(self.direction, Vec3::NEG_Y)
    }
}
