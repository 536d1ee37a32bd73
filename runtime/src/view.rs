//! How the subsurface pass turns pixels and depth values into millimetres.

use crate::bindings::kernel;
use crate::viewport::Viewport;

/// Geometry of the picture that the subsurface pass works on, and its quality.
///
/// Unless they are set, the number of taps is the kernel's own, and the frame index is 0.
///
/// ```
/// use subsurface_runtime::SubsurfaceView;
///
/// // A projection as glam, glTF and Bevy make it, 720 pixels high, world units of a metre.
/// let projection = [[1.3, 0.0, 0.0, 0.0], [0.0, 2.4, 0.0, 0.0], [0.0, 0.0, 0.0, -1.0], [0.0, 0.0, 0.1, 0.0]];
/// let view = SubsurfaceView::from_projection(projection, 720, 1000.0).with_taps(24);
/// assert_eq!(view.taps(), Some(24));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SubsurfaceView {
    distance_from_depth: [f32; 4],
    millimetres_per_pixel: [f32; 2],
    taps: Option<u32>,
    frame_index: u32,
}

impl SubsurfaceView {
    /// A view through `projection` (columns; clip space from view space, y up, depth 0 to 1), `height_pixels` high: the
    /// height of the viewport, if the inputs have one.
    ///
    /// Any perspective or orthographic projection will do: left- or right-handed, reversed, infinite. An orthographic
    /// one does not tell its handedness and is taken to look along −z. Pixels are square.
    pub fn from_projection(
        projection: [[f32; 4]; 4],
        height_pixels: u32,
        millimetres_per_world_unit: f32,
    ) -> Self {
        let [_, [_, scale_y, ..], [_, _, z_from_z, w_from_z], [_, _, z_offset, w_offset]] = projection;
        // depth = (z_from_z·z + z_offset) / (w_from_z·z + w_offset), distance = sign·z: solved for the distance.
        let sign = if w_from_z > 0.0 { 1.0 } else { -1.0 };
        let to_millimetres = sign * millimetres_per_world_unit;
        // A pixel is 2/h of w, which is w_offset or grows with the distance by |w_from_z|.
        let per_pixel = 2.0 / (scale_y.abs() * height_pixels as f32);
        let millimetres_per_pixel = if w_from_z == 0.0 {
            [per_pixel * w_offset.abs() * millimetres_per_world_unit, 0.0]
        } else {
            [0.0, per_pixel * w_from_z.abs()]
        };
        Self {
            distance_from_depth: [-to_millimetres * w_offset, to_millimetres * z_offset, w_from_z, -z_from_z],
            millimetres_per_pixel,
            taps: None,
            frame_index: 0,
        }
    }

    /// Depth values that are distances along the view axis in mm already; every pixel spans `millimetres_per_pixel`.
    pub fn orthographic_distances(millimetres_per_pixel: f32) -> Self {
        Self {
            distance_from_depth: [1.0, 0.0, 0.0, 1.0],
            millimetres_per_pixel: [millimetres_per_pixel, 0.0],
            taps: None,
            frame_index: 0,
        }
    }

    /// Depth values that are distances along the view axis in mm already, seen in perspective.
    pub fn perspective_distances(fov_y_radians: f32, height_pixels: u32) -> Self {
        let per_distance = 2.0 * (0.5 * fov_y_radians).tan() / height_pixels as f32;
        Self { millimetres_per_pixel: [0.0, per_distance], ..Self::orthographic_distances(0.0) }
    }

    /// Taps per pixel, in place of the kernel's own number; 0 turns scattering off. A kernel that sums every pixel knows
    /// only off and on.
    #[must_use]
    pub fn with_taps(mut self, taps: u32) -> Self {
        self.taps = Some(taps);
        self
    }

    /// Moves the pattern of taps, for programs that accumulate frames. Each number has its own pattern, and gives the same
    /// picture every time.
    #[must_use]
    pub fn with_frame_index(mut self, frame_index: u32) -> Self {
        self.frame_index = frame_index;
        self
    }

    /// Taps per pixel, if they are not the kernel's own number.
    pub fn taps(&self) -> Option<u32> {
        self.taps
    }

    /// Distance along the view axis, mm, of a depth value.
    pub fn distance_mm(&self, depth: f32) -> f32 {
        let [x, y, z, w] = self.distance_from_depth;
        (x * depth + y) / (z * depth + w)
    }

    /// Millimetres that a pixel spans at a distance of `distance_mm`.
    pub fn millimetres_per_pixel(&self, distance_mm: f32) -> f32 {
        self.millimetres_per_pixel[0] + self.millimetres_per_pixel[1] * distance_mm
    }

    pub(crate) fn distance_from_depth(&self) -> [f32; 4] {
        self.distance_from_depth
    }

    /// The view as the shaders take it, for a kernel of `taps` taps.
    pub(crate) fn uniform(&self, taps: u32, debug_view: u32, viewport: Viewport) -> kernel::SubsurfaceView {
        kernel::SubsurfaceView {
            distance_from_depth: self.distance_from_depth,
            millimetres_per_pixel: self.millimetres_per_pixel,
            taps: self.taps.unwrap_or(taps),
            frame_index: self.frame_index,
            // No side of a texture comes near 2³¹ pixels.
            viewport_origin: [viewport.x as i32, viewport.y as i32],
            viewport_extent: [viewport.width as i32, viewport.height as i32],
            debug_view,
            padding_52: [0; 12],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Mat4, Vec3};

    /// f32 depth of a perspective projection resolves 1e-4 of the distance at these planes.
    const TOLERANCE: f32 = 1e-3;

    fn distance_survives(projection: Mat4, forward: f32) {
        let view = SubsurfaceView::from_projection(projection.to_cols_array_2d(), 100, 1000.0);
        for distance in [0.2_f32, 0.5, 1.0, 3.0] {
            let clip = projection.project_point3(Vec3::new(0.1, 0.2, forward * distance));
            let back = view.distance_mm(clip.z);
            assert!(
                (back / (1000.0 * distance) - 1.0).abs() < TOLERANCE,
                "{distance} m came back as {back} mm"
            );
        }
    }

    #[test]
    fn distance_comes_back_through_every_kind_of_projection() {
        let fov = 0.5;
        distance_survives(glam::camera::rh::proj::directx::perspective(fov, 1.5, 0.1, 10.0), -1.0);
        distance_survives(glam::camera::lh::proj::directx::perspective(fov, 1.5, 0.1, 10.0), 1.0);
        distance_survives(glam::camera::rh::proj::directx::perspective_infinite_reverse(fov, 1.5, 0.1), -1.0);
        distance_survives(
            glam::camera::rh::proj::directx::orthographic(-1.0, 1.0, -1.0, 1.0, 0.1, 10.0),
            -1.0,
        );
    }

    #[test]
    fn pixels_span_what_the_field_of_view_says() {
        let fov = 0.5_f32;
        let projection = glam::camera::rh::proj::directx::perspective(fov, 1.5, 0.1, 10.0);
        let view = SubsurfaceView::from_projection(projection.to_cols_array_2d(), 100, 1000.0);
        let direct = SubsurfaceView::perspective_distances(fov, 100);
        let expected = 2.0 * (fov / 2.0).tan() * 700.0 / 100.0;
        assert!((view.millimetres_per_pixel(700.0) / expected - 1.0).abs() < 1e-6);
        assert!((direct.millimetres_per_pixel(700.0) / expected - 1.0).abs() < 1e-6);
        let flat = glam::camera::rh::proj::directx::orthographic(-1.0, 1.0, -0.5, 0.5, 0.1, 10.0);
        let view = SubsurfaceView::from_projection(flat.to_cols_array_2d(), 100, 1000.0);
        assert!((view.millimetres_per_pixel(700.0) - 10.0).abs() < 1e-5);
        // A factor on clip space changes nothing that is seen.
        for (projection, pixel_mm) in [(projection, expected), (flat, 10.0)] {
            let view = SubsurfaceView::from_projection((3.0 * projection).to_cols_array_2d(), 100, 1000.0);
            assert!((view.millimetres_per_pixel(700.0) / pixel_mm - 1.0).abs() < 1e-6);
            assert!(
                (view.distance_mm(0.9)
                    / SubsurfaceView::from_projection(projection.to_cols_array_2d(), 100, 1000.0)
                        .distance_mm(0.9)
                    - 1.0)
                    .abs()
                    < 1e-5
            );
        }
    }
}
