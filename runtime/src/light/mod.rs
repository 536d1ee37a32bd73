//! Lights: where they are, how much each of them matters, and what their shadow maps see.

mod buffer;
mod directional;
mod lamp;
mod ranks;
mod shadow_camera;

pub(crate) use buffer::LightBuffer;
pub use directional::DirectionalLight;
pub use lamp::{PointLight, SpotLight};
pub use ranks::{LightRanks, SHADOW_MAPS};
pub(crate) use shadow_camera::ShadowCamera;

use glam::Vec3;

use crate::bindings::kernel;
use crate::camera::Bounds;

/// Radius over which what comes through is averaged, mm: a third of a mean free path of skin, so that the facets of a
/// mesh blur and a fingertip stays as thick as it is.
const THICKNESS_RADIUS_MM: f32 = 0.3;

/// Least distance at which a lamp's light is reckoned, mm: a surface that touches it has no direction to it.
const LEAST_DISTANCE_MM: f32 = 0.1;

/// A light of a frame.
///
/// ```
/// use subsurface_runtime::{DirectionalLight, Light, PointLight};
///
/// let lights: [Light; 2] = [DirectionalLight::default().into(), PointLight::default().into()];
/// assert!(matches!(lights[1], Light::Point(lamp) if lamp.radius_mm == 0.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Light {
    /// So far away that its rays are parallel.
    Directional(DirectionalLight),
    /// A lamp that shines everywhere.
    Point(PointLight),
    /// A lamp that shines into a cone.
    Spot(SpotLight),
}

impl From<DirectionalLight> for Light {
    fn from(light: DirectionalLight) -> Self {
        Self::Directional(light)
    }
}

impl From<PointLight> for Light {
    fn from(light: PointLight) -> Self {
        Self::Point(light)
    }
}

impl From<SpotLight> for Light {
    fn from(light: SpotLight) -> Self {
        Self::Spot(light)
    }
}

impl Light {
    /// What its shadow map sees: all that `bounds` hold, or as much of it as a map can.
    pub(crate) fn shadow_camera(&self, bounds: &Bounds) -> ShadowCamera {
        match self {
            Self::Directional(light) => ShadowCamera::parallel(light.direction(), bounds),
            Self::Point(lamp) => ShadowCamera::around(lamp.position.into(), bounds),
            Self::Spot(lamp) => {
                ShadowCamera::along(lamp.position.into(), lamp.direction(), lamp.outer_angle_radians, bounds)
            }
        }
    }

    /// How much the light matters, 0 or more: the luminance of the irradiance that it has, without shadows, where
    /// `bounds` are nearest to it; 0 where its cone does not reach them.
    pub fn importance(&self, bounds: &Bounds) -> f32 {
        let (light, reached) = match self {
            Self::Directional(light) => (light.irradiance, 1.0),
            Self::Point(lamp) => (lamp.intensity, falloff(lamp.position, bounds)),
            Self::Spot(lamp) => {
                let reached = if lamp.reaches(bounds) { falloff(lamp.position, bounds) } else { 0.0 };
                (lamp.intensity, reached)
            }
        };
        let [red, green, blue] = light;
        let importance = reached * (0.2126 * red + 0.7152 * green + 0.0722 * blue);
        if importance.is_finite() { importance.max(0.0) } else { 0.0 }
    }

    /// The light as the shaders take it, with the layer of its shadow map, if it has one.
    pub(crate) fn uniform(
        &self,
        layer: Option<u32>,
        bounds: &Bounds,
        millimetres_per_world_unit: f32,
    ) -> kernel::Light {
        let camera = self.shadow_camera(bounds);
        let (irradiance, is_lamp, source) = match self {
            Self::Directional(light) => {
                (light.irradiance, 0, (0.5 * light.angular_diameter_radians.clamp(0.0, 3.0)).tan())
            }
            Self::Point(lamp) => (lamp.intensity, 1, lamp.radius_mm.max(0.0) / millimetres_per_world_unit),
            Self::Spot(lamp) => (lamp.intensity, 1, lamp.radius_mm.max(0.0) / millimetres_per_world_unit),
        };
        let [cone_scale, cone_offset] = match self {
            Self::Spot(lamp) => lamp.cone(),
            Self::Directional(_) | Self::Point(_) => [0.0, 1.0],
        };
        kernel::Light {
            eye: camera.eye.to_array(),
            layer: layer.unwrap_or(subsurface_kernel::constants::NO_SHADOW_MAP),
            right: camera.right.to_array(),
            half_width: camera.half_width,
            up: camera.up.to_array(),
            spread: camera.spread,
            forward: camera.forward.to_array(),
            near: camera.near,
            irradiance,
            far: camera.far,
            cone_scale,
            cone_offset,
            source,
            is_lamp,
            least_distance: LEAST_DISTANCE_MM / millimetres_per_world_unit,
            thickness_filter_radius: THICKNESS_RADIUS_MM / millimetres_per_world_unit,
            millimetres_per_world_unit,
            padding_108: [0; 4],
        }
    }
}

/// Irradiance of a lamp of intensity 1 where `bounds` are nearest to it; within them, at a hundredth of their radius.
fn falloff(position: [f32; 3], bounds: &Bounds) -> f32 {
    let distance = Vec3::from(position).distance(Vec3::from(bounds.centre)) - bounds.radius;
    distance.max(0.01 * bounds.radius).powi(-2)
}

/// A direction of length 1; one of length 0 has no meaning, and is taken for `otherwise`.
fn unit(direction: [f32; 3], otherwise: Vec3) -> Vec3 {
    Vec3::from(direction).try_normalize().unwrap_or(otherwise)
}
