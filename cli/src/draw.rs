//! Where scenes and buffers meet the GPU.
//!
//! The commands prepare a [`Frame`] or a [`Buffers`] and save what comes back; these two functions know the runtime.

use crate::failure::Failure;
use crate::picture::{DisplayPicture, LinearPicture};
use crate::scene::Scene;
use crate::scene::camera::{Camera, Light, Size};
use std::time::Duration;
use subsurface_codegen::Compilation;

/// The number of taps when none is asked for.
pub const DEFAULT_TAPS: u32 = 17;
/// The most taps that may be asked for.
pub const LARGEST_TAPS: u32 = 1024;

/// One picture to draw.
#[derive(Clone, Copy, Debug)]
pub struct Frame<'a> {
    /// What is drawn.
    pub scene: &'a Scene,
    /// The compiled materials.
    pub materials: &'a Compilation,
    /// Number of the material of each object, in the order of `scene.objects`.
    pub material_of_object: &'a [u32],
    /// Where one looks from.
    pub camera: Camera,
    /// Where the light comes from; the first one is the most important.
    pub lights: &'a [Light],
    /// Size of the picture.
    pub size: Size,
    /// Samples per pixel of the subsurface pass, in 1..=[`LARGEST_TAPS`].
    pub taps: u32,
    /// Whether light goes below the surface at all.
    pub subsurface: bool,
    /// Whether the intermediate targets are wanted.
    pub wants_aovs: bool,
}

/// What came of a [`Frame`].
#[derive(Clone, Debug)]
pub struct Drawn {
    /// Tone-mapped, sRGB: for PNG.
    pub display: DisplayPicture,
    /// Before tone mapping, linear: for EXR.
    pub linear: LinearPicture,
    /// Intermediate targets by name, if they were wanted: `irradiance`, `specular`, `surface_albedo`, `depth_mm`, ….
    pub aovs: Vec<(String, LinearPicture)>,
    /// How long each pass took, in the order of the frame; empty where the device cannot tell.
    pub timings: Vec<(String, Duration)>,
}

/// Draws a frame.
pub fn draw(_frame: &Frame<'_>) -> Result<Drawn, Failure> {
    Err(not_connected())
}

/// How many millimetres a pixel covers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PixelScale {
    /// The same everywhere: an orthographic view (mm per pixel, > 0).
    MillimetresPerPixel(f32),
    /// In proportion to `Z`: a perspective view of this vertical field of view (degrees, in (0, 180)).
    FovYDegrees(f32),
}

/// Somebody's own buffers for the subsurface pass, rows from the top.
#[derive(Clone, Debug)]
pub struct Buffers {
    /// Size of every buffer.
    pub size: Size,
    /// Diffuse irradiance, linear.
    pub irradiance: Vec<[f32; 3]>,
    /// Distance along the view axis (mm); 0 is background.
    pub depth_mm: Vec<f32>,
    /// Surface albedo, in [0, 1]; `None`: that of the material.
    pub surface_albedo: Option<Vec<[f32; 3]>>,
    /// Number of the material, checked against the set.
    pub material: Vec<u32>,
}

/// Runs the subsurface pass alone: the diffused irradiance, background passed through.
pub fn diffuse(
    _buffers: &Buffers,
    _materials: &Compilation,
    _scale: PixelScale,
    _taps: u32,
    _seed: u32,
) -> Result<LinearPicture, Failure> {
    Err(not_connected())
}

fn not_connected() -> Failure {
    Failure::new("this build has no GPU passes yet", "check, build and profile work without")
}
