//! Lights that stand somewhere.

use glam::Vec3;

use super::unit;
use crate::camera::Bounds;

/// Least part of a cone in which it falls off, by cosines: an edge without one would not be smooth.
const LEAST_FALLOFF: f32 = 1e-3;

/// A lamp that shines alike into all directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointLight {
    /// Position, world space; by default the origin.
    pub position: [f32; 3],
    /// Irradiance at the distance of one world unit on a surface that faces the lamp, linear red, green, blue; it falls
    /// by the square of the distance. By default π.
    pub intensity: [f32; 3],
    /// Radius of the lamp in mm: its shadows are as soft. 0, the default, is a point.
    pub radius_mm: f32,
}

impl Default for PointLight {
    fn default() -> Self {
        Self { position: [0.0; 3], intensity: [std::f32::consts::PI; 3], radius_mm: 0.0 }
    }
}

/// A lamp that shines into a cone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpotLight {
    /// Position, world space; by default the origin.
    pub position: [f32; 3],
    /// Axis of the cone, away from the lamp, world space; any length but 0. By default (0, −1, 0), downwards.
    pub direction: [f32; 3],
    /// Irradiance at the distance of one world unit, as of a [`PointLight`].
    pub intensity: [f32; 3],
    /// Radius of the lamp in mm; by default 0.
    pub radius_mm: f32,
    /// Angle between the axis and the edge of what is lit in full, in radians; by default 0.
    pub inner_angle_radians: f32,
    /// Angle between the axis and the edge of what is lit at all, in radians, from the inner one to π/2; at 0 nothing is
    /// lit. By default π/4. Shadows reach 75° off the axis.
    pub outer_angle_radians: f32,
}

impl Default for SpotLight {
    fn default() -> Self {
        Self {
            position: [0.0; 3],
            direction: [0.0, -1.0, 0.0],
            intensity: [std::f32::consts::PI; 3],
            radius_mm: 0.0,
            inner_angle_radians: 0.0,
            outer_angle_radians: std::f32::consts::FRAC_PI_4,
        }
    }
}

impl SpotLight {
    pub(super) fn direction(&self) -> Vec3 {
        unit(self.direction, Vec3::NEG_Y)
    }

    /// Scale and offset of the cosine to the axis whose square, within 0 and 1, is the share of the light: that of
    /// KHR_lights_punctual.
    pub(super) fn cone(&self) -> [f32; 2] {
        let half_turn = std::f32::consts::PI;
        let outer = self.outer_angle_radians.clamp(0.0, half_turn);
        if outer == 0.0 {
            return [0.0, 0.0];
        }
        let (outer, inner) = (outer.cos(), self.inner_angle_radians.clamp(0.0, outer).cos());
        let scale = 1.0 / (inner - outer).max(LEAST_FALLOFF * (1.0 - outer));
        [scale, -outer * scale]
    }

    /// Whether some of `bounds` may be in the cone.
    pub(super) fn reaches(&self, bounds: &Bounds) -> bool {
        let offset = Vec3::from(bounds.centre) - Vec3::from(self.position);
        let distance = offset.length();
        if distance <= bounds.radius {
            return self.outer_angle_radians > 0.0;
        }
        let half_angle = (bounds.radius / distance).asin();
        let off_axis = (offset.dot(self.direction()) / distance).clamp(-1.0, 1.0).acos();
        self.outer_angle_radians > 0.0 && off_axis < self.outer_angle_radians + half_angle
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn share(lamp: &SpotLight, degrees: f32) -> f32 {
        let [scale, offset] = lamp.cone();
        (degrees.to_radians().cos() * scale + offset).clamp(0.0, 1.0).powi(2)
    }

    #[test]
    fn a_cone_is_whole_within_and_nothing_beyond() {
        let cone = |inner: f32, outer: f32| SpotLight {
            inner_angle_radians: inner.to_radians(),
            outer_angle_radians: outer.to_radians(),
            ..Default::default()
        };
        let lamp = cone(20.0, 40.0);
        assert_eq!(
            [share(&lamp, 0.0), share(&lamp, 19.9), share(&lamp, 40.1), share(&lamp, 90.0)],
            [1.0, 1.0, 0.0, 0.0]
        );
        assert!((0.01..0.99).contains(&share(&lamp, 30.0)));
        assert!((1..10).all(|degrees| share(&cone(0.9 * degrees as f32, degrees as f32), 0.0) == 1.0));
        // No cone lights nothing, and an inner angle beyond the outer one is that.
        assert_eq!(share(&cone(0.0, 0.0), 0.0), 0.0);
        assert_eq!(share(&cone(60.0, 30.0), 29.0), 1.0);
        // A whole turn lights what a point does.
        assert!((0..=180).all(|degrees| share(&cone(180.0, 180.0), degrees as f32) > 0.0 || degrees == 180));
    }

    #[test]
    fn a_cone_that_points_away_reaches_nothing() {
        let lamp = SpotLight { position: [0.0, 2.0, 0.0], ..Default::default() };
        assert!(lamp.reaches(&Bounds::new([0.0; 3], 0.1)));
        assert!(!lamp.reaches(&Bounds::new([0.0, 4.0, 0.0], 0.1)));
        assert!(!lamp.reaches(&Bounds::new([5.0, 1.0, 0.0], 0.1)));
        assert!(lamp.reaches(&Bounds::new([5.0, 1.0, 0.0], 6.0)), "the lamp stands within");
    }
}
