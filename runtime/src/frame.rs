//! What one frame of a [`Renderer`](crate::Renderer) shows.

use crate::camera::{Bounds, Camera};
use crate::extent::Extent;
use crate::light::{Light, LightRanks};
use crate::pass::composite::CompositeSettings;
use crate::view::SubsurfaceView;

/// What one frame shows.
///
/// ```
/// use subsurface_runtime::{Bounds, Camera, DirectionalLight, Frame};
///
/// let lights = [DirectionalLight::default().into()];
/// let frame = Frame { lights: &lights, ..Frame::new(Camera::default(), Bounds::new([0.0; 3], 0.2), 1000.0) };
/// assert_eq!((frame.taps, frame.frame_index, frame.transmission), (None, 0, 1.0));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Frame<'a> {
    /// The camera.
    pub camera: Camera,
    /// Lights, any number; by default none. The [`SHADOW_MAPS`](crate::SHADOW_MAPS) most important ones cast shadows and
    /// shine through what is thin.
    pub lights: &'a [Light],
    /// Irradiance that comes from everywhere alike, linear red, green, blue; by default 0.
    pub ambient_irradiance: [f32; 3],
    /// Factor on the environment that the renderer was given; by default 1.
    pub environment_intensity: f32,
    /// Turn of the environment about the y axis, in radians; by default 0.
    pub environment_turn_radians: f32,
    /// Factor on every material's transmission: 1, the default, or 0 for none.
    pub transmission: f32,
    /// A sphere around all objects.
    pub bounds: Bounds,
    /// Millimetres that a world unit has: 1000 for metres. There is no default, because a wrong scale often looks
    /// plausible.
    pub millimetres_per_world_unit: f32,
    /// Taps per pixel of the subsurface pass in place of the kernel's own number, which `None`, the default, takes; 0
    /// turns scattering off.
    pub taps: Option<u32>,
    /// Moves the pattern of the subsurface pass's taps on; 0, the default, for a still picture.
    pub frame_index: u32,
    /// Exposure, tone mapping and background.
    pub composite: CompositeSettings,
}

impl Frame<'_> {
    /// A frame without light: set [`lights`](Self::lights) or [`ambient_irradiance`](Self::ambient_irradiance), or give
    /// the renderer an environment.
    pub fn new(camera: Camera, bounds: Bounds, millimetres_per_world_unit: f32) -> Self {
        Self {
            camera,
            lights: &[],
            ambient_irradiance: [0.0; 3],
            environment_intensity: 1.0,
            environment_turn_radians: 0.0,
            transmission: 1.0,
            bounds,
            millimetres_per_world_unit,
            taps: None,
            frame_index: 0,
            composite: CompositeSettings::default(),
        }
    }

    /// Indices of the lights, the most important first; without what earlier frames decided.
    pub fn light_ranks(&self) -> Vec<usize> {
        let mut ranks = LightRanks::default();
        ranks.update(self.lights, &self.bounds);
        ranks.order().to_vec()
    }

    /// How the subsurface pass sees this frame at a size of `size`.
    pub fn subsurface_view(&self, size: Extent) -> SubsurfaceView {
        let projection = self.camera.projection(size.aspect(), &self.bounds);
        let view = SubsurfaceView::from_projection(projection, size.height, self.millimetres_per_world_unit)
            .with_frame_index(self.frame_index);
        self.taps.map_or(view, |taps| view.with_taps(taps))
    }
}
