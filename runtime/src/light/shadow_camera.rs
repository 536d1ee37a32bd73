//! What a shadow map sees.

use glam::{Mat4, Vec3};

use crate::camera::{Bounds, upright};

/// Largest angle between the axis of a map in perspective and its edges, in radians: beyond, its texels in the corners
/// grow without end.
const LARGEST_HALF_ANGLE: f32 = 75.0 * std::f32::consts::PI / 180.0;

/// How much larger than what is drawn a map is: nothing lies on its border, where a filter would reach beyond.
const MARGIN: f32 = 1.02;

/// The camera of a shadow map: square, orthographic or in perspective, depth 0 nearest the light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ShadowCamera {
    pub(crate) eye: Vec3,
    pub(crate) right: Vec3,
    pub(crate) up: Vec3,
    pub(crate) forward: Vec3,
    /// Half of the width at the eye, world units: 0 in perspective.
    pub(crate) half_width: f32,
    /// Growth of half the width per world unit of distance: 0 where it is orthographic.
    pub(crate) spread: f32,
    pub(crate) near: f32,
    pub(crate) far: f32,
}

impl ShadowCamera {
    /// A box around `bounds`, for parallel rays.
    pub(super) fn parallel(direction: Vec3, bounds: &Bounds) -> Self {
        let depth = MARGIN * bounds.reach(direction).max(1e-3 * bounds.radius);
        let camera = Self::at(Vec3::from(bounds.centre) - direction * depth, direction);
        let width = bounds.reach(camera.right).max(bounds.reach(camera.up));
        Self { half_width: MARGIN * width.max(1e-3 * bounds.radius), far: 2.0 * depth, ..camera }
    }

    /// A pyramid around `bounds`, or as much of them as there is in one where the eye is within.
    pub(super) fn around(eye: Vec3, bounds: &Bounds) -> Self {
        let offset = Vec3::from(bounds.centre) - eye;
        let half_angle = (bounds.radius / offset.length()).min(1.0).asin();
        let camera = Self::along(eye, offset.try_normalize().unwrap_or(Vec3::NEG_Y), half_angle, bounds);
        let spread = camera.spread_of(bounds);
        Self { spread: camera.spread.min(MARGIN * spread), ..camera }
    }

    /// Largest slope to a corner of the box; infinite where one is not before the camera.
    fn spread_of(&self, bounds: &Bounds) -> f32 {
        let slope = |corner: Vec3| {
            let offset = corner - self.eye;
            let across = offset.dot(self.right).abs().max(offset.dot(self.up).abs());
            let before = offset.dot(self.forward);
            if before > 0.0 { across / before } else { f32::INFINITY }
        };
        bounds.corners().map(slope).into_iter().fold(0.01, f32::max)
    }

    /// A pyramid about an axis.
    pub(super) fn along(eye: Vec3, axis: Vec3, half_angle: f32, bounds: &Bounds) -> Self {
        let half_angle = half_angle.clamp(0.01, LARGEST_HALF_ANGLE);
        let distance = eye.distance(Vec3::from(bounds.centre));
        let far = distance + bounds.radius;
        // What is at the edge is nearer along the axis than it is.
        let near = ((distance - bounds.radius) * 0.99 * half_angle.cos()).max(1e-3 * far);
        // A texel more than the bounds, for filters.
        Self { spread: 1.01 * half_angle.tan(), near, far, ..Self::at(eye, axis) }
    }

    fn at(eye: Vec3, forward: Vec3) -> Self {
        let right = forward.cross(upright(forward)).normalize();
        let up = right.cross(forward);
        Self { eye, right, up, forward, half_width: 0.0, spread: 0.0, near: 0.0, far: 0.0 }
    }

    /// Clip space from world space.
    pub(crate) fn clip_from_world(&self) -> Mat4 {
        let view = glam::camera::rh::view::look_to_mat4(self.eye, self.forward, self.up);
        let Self { half_width, spread, near, far, .. } = *self;
        let projection = if spread > 0.0 {
            glam::camera::rh::proj::directx::perspective(2.0 * spread.atan(), 1.0, near, far)
        } else {
            let (low, high) = (-half_width, half_width);
            glam::camera::rh::proj::directx::orthographic(low, high, low, high, near, far)
        };
        projection * view
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Texture coordinate and depth as the shaders have them: `shaders/light/light.wgsl`.
    fn place(camera: &ShadowCamera, point: Vec3) -> Vec3 {
        let offset = point - camera.eye;
        let distance = offset.dot(camera.forward);
        let half = camera.half_width + camera.spread * distance;
        let part = (distance - camera.near) / (camera.far - camera.near);
        let depth = if camera.spread > 0.0 { part * camera.far / distance } else { part };
        Vec3::new(
            0.5 + 0.5 * offset.dot(camera.right) / half,
            0.5 - 0.5 * offset.dot(camera.up) / half,
            depth,
        )
    }

    #[test]
    fn the_matrix_and_the_axes_are_one_camera() {
        let bounds = Bounds::new([0.3, -0.1, 0.2], 0.5);
        let cameras = [
            ShadowCamera::parallel(Vec3::new(0.6, -0.8, 0.0), &bounds),
            ShadowCamera::parallel(Vec3::NEG_Y, &bounds),
            ShadowCamera::around(Vec3::new(2.0, 1.0, -1.0), &bounds),
            ShadowCamera::around(Vec3::from(bounds.centre), &bounds),
            ShadowCamera::along(
                Vec3::new(0.0, 2.0, 0.0),
                Vec3::new(0.0, -1.0, 0.1).normalize(),
                0.4,
                &bounds,
            ),
        ];
        for camera in cameras {
            for point in [Vec3::new(0.4, -0.3, 0.1), Vec3::new(0.3, -0.5, 0.2)] {
                let clip = camera.clip_from_world().project_point3(point);
                let expected = Vec3::new(0.5 + 0.5 * clip.x, 0.5 - 0.5 * clip.y, clip.z);
                // f32, some of it near the far plane.
                assert!(place(&camera, point).abs_diff_eq(expected, 1e-4), "{camera:?} at {point}");
            }
        }
    }

    #[test]
    fn a_map_holds_the_bounds() {
        let sphere = Bounds::new([1.0, 2.0, 3.0], 0.7);
        let flat = Bounds::of_box([0.5, 1.0, 2.9], [1.5, 3.0, 3.1]);
        let directions = [Vec3::X, Vec3::Y, Vec3::NEG_Z, Vec3::ONE.normalize()];
        for bounds in [sphere, flat] {
            for camera in [
                ShadowCamera::parallel(Vec3::new(0.0, -0.6, 0.8), &bounds),
                ShadowCamera::parallel(Vec3::NEG_Y, &bounds),
                ShadowCamera::around(Vec3::new(1.0, 6.0, 2.0), &bounds),
            ] {
                let on_sphere =
                    directions.map(|direction| Vec3::from(bounds.centre) + bounds.radius * direction);
                let points = if bounds == sphere { on_sphere.to_vec() } else { bounds.corners().to_vec() };
                for point in points {
                    let place = place(&camera, point);
                    assert!(place.min_element() > 0.0 && place.max_element() < 1.0, "{camera:?}: {place}");
                }
            }
        }
    }

    #[test]
    fn a_box_has_finer_texels_than_the_sphere_around_it() {
        let [minimum, maximum] = [[-0.1, -0.3, -0.1], [0.1, 0.3, 0.1]];
        let tall = Bounds::of_box(minimum, maximum);
        let sphere = Bounds::new(tall.centre, tall.radius);
        let width = |bounds: &Bounds, direction| ShadowCamera::parallel(direction, bounds).half_width;
        assert!(width(&tall, Vec3::NEG_Y) < 0.35 * width(&sphere, Vec3::NEG_Y));
        assert!(width(&tall, Vec3::X) < 0.95 * width(&sphere, Vec3::X));
        // A tilted one is no larger than the sphere's.
        let tilted = Vec3::new(0.5, -0.6, 0.3).normalize();
        assert!(width(&tall, tilted) <= width(&sphere, tilted));
    }
}
