//! Lights and their shadow maps' geometry.

use glam::{Mat4, Vec3};

use crate::bindings::kernel;
use crate::camera::{Bounds, upright};
use crate::frame_error::FrameError;

/// Directional lights that one frame can hold.
pub const LIGHT_CAPACITY: usize = subsurface_kernel::constants::LIGHT_CAPACITY as usize;

/// Radius of the shadow filter, mm: the penumbra of a large lamp behind a nose.
const SHADOW_RADIUS_MM: f32 = 1.0;

/// Radius over which what comes through is averaged, mm: a third of a mean free path of skin, so that the facets of a
/// mesh blur and a fingertip stays as thick as it is.
const THICKNESS_RADIUS_MM: f32 = 0.3;

/// The shaders hold as many lights.
const _: fn(&kernel::GBufferFrame) -> &[kernel::Light; LIGHT_CAPACITY] = |frame| &frame.lights;

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
}

impl Default for DirectionalLight {
    fn default() -> Self {
        Self { direction: [0.0, -1.0, 0.0], irradiance: [std::f32::consts::PI; 3] }
    }
}

/// Whether a frame can hold the lights.
pub(crate) fn check_count(lights: &[DirectionalLight]) -> Result<(), FrameError> {
    let (found, capacity) = (lights.len(), LIGHT_CAPACITY);
    if found > capacity { Err(FrameError::Lights { found, capacity }) } else { Ok(()) }
}

impl DirectionalLight {
    fn towards(&self) -> Vec3 {
        // A direction of length 0 has no meaning; light from above is defined, NaN would spread.
        -Vec3::from(self.direction).try_normalize().unwrap_or(Vec3::NEG_Y)
    }

    /// Clip space of the shadow map from world space: an orthographic box around `bounds`, depth 0 nearest the light.
    pub(crate) fn light_from_world(&self, bounds: &Bounds) -> Mat4 {
        let towards = self.towards();
        let radius = bounds.radius;
        let eye = Vec3::from(bounds.centre) + towards * radius;
        let view = glam::camera::rh::view::look_to_mat4(eye, -towards, upright(towards));
        glam::camera::rh::proj::directx::orthographic(-radius, radius, -radius, radius, 0.0, 2.0 * radius)
            * view
    }

    pub(crate) fn uniform(
        &self,
        bounds: &Bounds,
        shadow_map_size: u32,
        millimetres_per_world_unit: f32,
    ) -> kernel::Light {
        // Texture coordinates run down, clip space up.
        let texture_from_clip =
            Mat4::from_translation(Vec3::new(0.5, 0.5, 0.0)) * Mat4::from_scale(Vec3::new(0.5, -0.5, 1.0));
        let diameter = 2.0 * bounds.radius;
        let texel = diameter / shadow_map_size as f32;
        let thickness_radius = THICKNESS_RADIUS_MM / millimetres_per_world_unit;
        // A filter narrower than a texel and a half would show the map's steps.
        let filter_radius = (SHADOW_RADIUS_MM / millimetres_per_world_unit).max(1.5 * texel);
        kernel::Light {
            shadow_from_world: (texture_from_clip * self.light_from_world(bounds)).to_cols_array_2d(),
            towards_light: self.towards().into(),
            shadow_range_mm: diameter * millimetres_per_world_unit,
            irradiance: self.irradiance,
            shadow_filter_radius: filter_radius / diameter,
            // The filter reaches past a texel's centre by its own radius on a surface seen at a slant.
            shadow_normal_offset: 2.0 * texel + filter_radius,
            thickness_filter_radius: thickness_radius,
            // A texel's neighbours, and half the disc: a rim as round as that stays outside.
            thickness_normal_offset: 1.5 * texel + 0.5 * thickness_radius,
            millimetres_per_world_unit,
        }
    }
}
