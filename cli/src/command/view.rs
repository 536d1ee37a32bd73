//! Scenes and views as several commands take them.

use super::details::DetailArguments;
use super::lights::LightArguments;
use super::number;
use crate::failure::{Failure, warning};
use crate::progress::Spinner;
use crate::scene::camera::{Camera, DEFAULT_FOV_Y_DEGREES, Size, Triple};
use crate::scene::environment::Environment;
use crate::scene::light::{DEFAULT_AMBIENT_INTENSITY, Light};
use crate::scene::{Scene, bust, gltf, shapes, texture_orientation};
use clap::{Args, ValueEnum};
use glam::Vec3;
use std::path::PathBuf;

/// What is drawn.
#[derive(Debug, Args)]
pub struct MeshArguments {
    /// glTF file, binary or text, in metres; by default the procedural bust.
    #[arg(long, value_name = "FILE.glb")]
    pub mesh: Option<PathBuf>,
    /// A procedural scene.
    #[arg(long, value_enum, value_name = "NAME", conflicts_with = "mesh", default_value_t = Procedural::Bust)]
    pub scene: Procedural,
    /// Whether to turn the file's textures upside down; --flip-v alone means always.
    ///
    /// glTF has texture coordinate (0, 0) at the image's upper left; some converters put it at the lower left.
    #[arg(
        long,
        requires = "mesh",
        value_enum,
        value_name = "WHEN",
        num_args = 0..=1,
        require_equals = true,
        default_value_t = FlipV::Auto,
        default_missing_value = "always"
    )]
    pub flip_v: FlipV,
    /// What its surfaces have beside colours and normals.
    #[command(flatten)]
    pub details: DetailArguments,
}

/// Scenes that need no file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Procedural {
    /// A bust with thin ears.
    #[default]
    Bust,
    /// A sphere of 40 mm radius.
    Sphere,
    /// An ellipsoid with half axes of 60, 81 and 48 mm.
    Ellipsoid,
    /// The same, half in the shadow of a plate: for light along -0.8,0,-0.6.
    ShadowedEllipsoid,
    /// A rounded slab of 60, 60 and 6 mm, thin along z.
    Slab,
    /// A shell of 36, 56 and 3 mm, bent like an ear.
    Shell,
}

impl Procedural {
    fn scene(self) -> Scene {
        match self {
            Self::Bust => bust::scene(bust::CELL_MM),
            Self::Sphere => shapes::sphere(),
            Self::Ellipsoid => shapes::ellipsoid(),
            Self::ShadowedEllipsoid => shapes::shadowed_ellipsoid(),
            Self::Slab => shapes::slab(),
            Self::Shell => shapes::shell(),
        }
    }
}

/// When a file's textures are turned upside down.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum FlipV {
    /// Where the surface shows it: v rises with height, and the colours on both sides of seams match better. Says so.
    #[default]
    Auto,
    /// All textures.
    Always,
    /// None.
    Never,
}

/// The scene in the file, or a procedural one; prints warnings.
pub(super) fn load_scene(arguments: &MeshArguments) -> Result<Scene, Failure> {
    let Some(path) = &arguments.mesh else {
        let _spinner = Spinner::new("sculpting the scene");
        let mut scene = arguments.scene.scene();
        arguments.details.apply(&mut scene)?;
        return Ok(scene);
    };
    let spinner = Spinner::new(format!("reading {}", path.display()));
    let loaded = gltf::load(path, |what| spinner.say(format!("reading {}: {what}", path.display())));
    drop(spinner);
    let mut loaded = loaded?;
    for suspect in &loaded.warnings {
        eprintln!("{}\n", warning(suspect));
    }
    match arguments.flip_v {
        FlipV::Auto => {
            for turned in texture_orientation::turn_over(&mut loaded.scene, path) {
                eprintln!("{}\n", warning(&turned));
            }
        }
        FlipV::Always => loaded.scene.flip_texture_v(),
        FlipV::Never => (),
    }
    arguments.details.apply(&mut loaded.scene)?;
    Ok(loaded.scene)
}

/// Camera and lights.
#[derive(Debug, Args)]
pub struct ViewArguments {
    /// Where the camera stands, in metres; by default where the whole scene is in view, 35° to the right of its front.
    #[arg(long, value_name = "x,y,z", allow_hyphen_values = true)]
    pub camera: Option<Triple>,
    /// The point in the middle of the picture, in metres; by default the middle of the scene. Up is +y.
    #[arg(long, value_name = "x,y,z", allow_hyphen_values = true)]
    pub target: Option<Triple>,
    /// Vertical field of view in degrees.
    #[arg(long, value_name = "D", default_value_t = DEFAULT_FOV_Y_DEGREES, value_parser = number::fov_y_degrees, allow_hyphen_values = true)]
    pub fov_y_degrees: f32,
    /// Where the light comes from.
    #[command(flatten)]
    pub lights: LightArguments,
    /// Irradiance that comes from everywhere alike, as a light's intensity: 0 for none.
    #[arg(long, value_name = "INTENSITY", default_value_t = DEFAULT_AMBIENT_INTENSITY, value_parser = number::intensity, allow_hyphen_values = true)]
    pub ambient: f32,
    /// Light from all around: an equirectangular image, .exr or .hdr, twice as wide as it is high. Its middle lies towards
    /// -z, its right half towards +x.
    #[arg(long, value_name = "SKY.exr|SKY.hdr")]
    pub environment: Option<PathBuf>,
    /// Factor on the environment.
    #[arg(long, value_name = "X", default_value_t = 1.0, requires = "environment", value_parser = number::intensity, allow_hyphen_values = true)]
    pub environment_intensity: f32,
    /// Turn of the environment about the vertical, in degrees: 90 brings its middle from -z to +x.
    #[arg(long, value_name = "D", default_value_t = 0.0, requires = "environment", value_parser = number::turn_degrees, allow_hyphen_values = true)]
    pub environment_turn_degrees: f32,
}

impl ViewArguments {
    /// The camera for a scene; what is not given frames the scene.
    pub fn camera(&self, scene: &Scene, size: Size) -> Result<Camera, Failure> {
        let mut camera = Camera::framing(scene, size.aspect(), self.fov_y_degrees);
        if let Some(Triple(target)) = self.target {
            // Keep the direction and the distance.
            let offset = Vec3::from(camera.position) - Vec3::from(camera.target);
            camera.position = (Vec3::from(target) + offset).to_array();
            camera.target = target;
        }
        if let Some(Triple(position)) = self.camera {
            camera.position = position;
        }
        let direction = Vec3::from(camera.target) - Vec3::from(camera.position);
        match direction.try_normalize() {
            None => Err(Failure::new(
                "the camera stands on its target",
                "give --camera and --target different points, in metres",
            )),
            // Closer to the vertical than this, the renderer takes another direction for up.
            Some(direction) if direction.y.abs() > 0.999 => Err(Failure::new(
                "the camera looks straight up or down, so its horizon is not defined",
                "move --camera a little to the side",
            )),
            Some(_) => Ok(camera),
        }
    }

    /// The lights, or the default ones.
    pub fn lights(&self) -> Vec<Light> {
        self.lights.lights()
    }

    /// The environment, if there is one; prints warnings.
    pub fn environment(&self) -> Result<Option<Environment>, Failure> {
        let Some(path) = &self.environment else { return Ok(None) };
        let _spinner = Spinner::new(format!("reading {}", path.display()));
        let (environment, clamped) = Environment::read(path)?;
        if let Some(clamped) = clamped {
            eprintln!("{}\n", warning(&clamped));
        }
        let turn_radians = self.environment_turn_degrees.to_radians();
        Ok(Some(Environment { intensity: self.environment_intensity, turn_radians, ..environment }))
    }
}
