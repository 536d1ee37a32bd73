//! Where one looks from.

use super::Scene;
use glam::Vec3;
use std::str::FromStr;

/// Vertical field of view when none is asked for (degrees): about that of an 85 mm lens, the portrait's.
pub const DEFAULT_FOV_Y_DEGREES: f32 = 24.0;

/// A perspective camera in world space; up is +y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where the camera stands (m).
    pub position: [f32; 3],
    /// The point that appears in the middle of the picture (m).
    pub target: [f32; 3],
    /// Vertical field of view (degrees), in (0, 180).
    pub fov_y_degrees: f32,
}

impl Camera {
    /// The whole of `scene` in the middle of a picture of `aspect` = width / height, from 35° to the right of +z and a
    /// little above.
    pub fn framing(scene: &Scene, aspect: f32, fov_y_degrees: f32) -> Self {
        let direction = Vec3::new(35f32.to_radians().sin(), 0.08, 35f32.to_radians().cos()).normalize();
        let half_y = 0.5 * fov_y_degrees.to_radians();
        let half_x = (half_y.tan() * aspect).atan();
        let right = Vec3::Y.cross(direction).normalize();
        let up = direction.cross(right);
        let points =
            || scene.objects.iter().flat_map(|object| &object.mesh.positions).map(|p| Vec3::from(*p));
        let middle = |axis: Vec3| {
            let extent =
                |(low, high): (f32, f32), point: Vec3| (low.min(point.dot(axis)), high.max(point.dot(axis)));
            let (low, high) = points().fold((f32::INFINITY, f32::NEG_INFINITY), extent);
            0.5 * (low + high)
        };
        let centre = if points().next().is_some() {
            middle(right) * right + middle(up) * up + middle(direction) * direction
        } else {
            Vec3::ZERO
        };
        // The nearest distance from which every vertex is inside all four planes, and 6 % of air; a lone point needs some.
        let distance = points().fold(1e-3f32, |distance, point| {
            let offset = point - centre;
            let (x, y, z) = (offset.dot(right).abs(), offset.dot(up).abs(), offset.dot(direction));
            distance.max(z + x / half_x.tan()).max(z + y / half_y.tan())
        });
        let position = centre + direction * distance * 1.06;
        Self { position: position.to_array(), target: centre.to_array(), fov_y_degrees }
    }
}

/// Three numbers with commas between: a point (m) or a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triple(pub [f32; 3]);

impl FromStr for Triple {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match numbers(text)?[..] {
            [x, y, z] => Ok(Self([x, y, z])),
            ref other => Err(format!("expected three numbers `x,y,z`, found {}", other.len())),
        }
    }
}

/// Finite numbers with commas between.
pub(super) fn numbers(text: &str) -> Result<Vec<f32>, String> {
    text.split(',')
        .map(|part| {
            let part = part.trim();
            let number: f32 = part.parse().map_err(|_| format!("`{part}` is not a number"))?;
            if number.is_finite() { Ok(number) } else { Err(format!("`{part}` is not finite")) }
        })
        .collect()
}

/// A picture's size in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Width in pixels, > 0.
    pub width: u32,
    /// Height in pixels, > 0.
    pub height: u32,
}

impl Size {
    /// Largest edge that is accepted at all (pixels); the device has its own limit below.
    pub const LARGEST: u32 = 32_768;

    /// Width over height.
    pub fn aspect(self) -> f32 {
        self.width as f32 / self.height as f32
    }

    /// Width times height.
    pub fn pixels(self) -> usize {
        self.width as usize * self.height as usize
    }
}

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let expected = || format!("expected WIDTHxHEIGHT in pixels, for example 1280x720, found `{text}`");
        let (width, height) = text.split_once(['x', 'X']).ok_or_else(expected)?;
        let edge = |part: &str| part.trim().parse::<u32>().map_err(|_| expected());
        let size = Self { width: edge(width)?, height: edge(height)? };
        if size.width == 0 || size.height == 0 {
            return Err("a picture needs at least 1x1 pixels, for example 1280x720".into());
        }
        if size.width.max(size.height) > Self::LARGEST {
            return Err(format!(
                "an edge of more than {} pixels fits no device; ask for less",
                Self::LARGEST
            ));
        }
        Ok(size)
    }
}

impl std::fmt::Display for Size {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}x{}", self.width, self.height)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a panic is how a test fails")]
mod tests {
    use super::*;
    use crate::scene::{Mesh, Object};

    #[test]
    fn a_size_has_two_edges_above_zero() {
        assert_eq!("1280x720".parse(), Ok(Size { width: 1280, height: 720 }));
        for wrong in ["0x0", "0x1", "1x0", "1280", "x", "-1x1", "1x1x1", "99999x1", "1.5x2"] {
            assert!(wrong.parse::<Size>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn framing_holds_every_corner_in_the_picture() {
        let (minimum, maximum) = ([-0.2, -0.1, -0.3], [0.1, 0.4, 0.2]);
        let corner = |index: usize| [0, 1, 2].map(|axis| [minimum, maximum][index >> axis & 1][axis]);
        let positions: Vec<[f32; 3]> = (0..8).map(corner).collect();
        let mesh = Mesh { positions: positions.clone(), ..Mesh::default() };
        let scene = Scene::new(vec![Object { mesh, ..Object::default() }]);
        for aspect in [0.3, 1.0, 2.5] {
            let camera = Camera::framing(&scene, aspect, 30.0);
            let to_target = (Vec3::from(camera.target) - Vec3::from(camera.position)).normalize();
            let right = to_target.cross(Vec3::Y).normalize();
            let up = right.cross(to_target);
            for position in &positions {
                let offset = Vec3::from(*position) - Vec3::from(camera.position);
                let depth = offset.dot(to_target);
                let edge = depth * 15f32.to_radians().tan();
                assert!(offset.dot(up).abs() < edge);
                assert!(offset.dot(right).abs() < edge * aspect);
            }
        }
    }
}
