//! `subsurface export`.

use super::material_set;
use super::render::DEFAULT_MATERIAL;
use super::view::{MeshArguments, ViewArguments, load_scene};
use crate::failure::{Explain, Failure, warning};
use crate::mitsuba::{Boundary, CHANNELS, Exported, Medium, flaws, ply, xml};
use crate::picture::LinearPicture;
use crate::picture::exr::write_exr;
use crate::picture::file::write_atomically;
use crate::progress::Spinner;
use crate::say;
use crate::scene::camera::Size;
use crate::scene::environment::Environment;
use crate::scene::light::Light;
use crate::scene::{Object, Surface};
use clap::{Args, ValueEnum};
use std::fmt;
use std::path::PathBuf;
use subsurface_codegen::Material;
use subsurface_runtime::ClearMaterial;

/// Arguments of `subsurface export`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  subsurface export --to mitsuba --scene ellipsoid --light=-0.5,-0.3,-0.8 --ambient 0 --size 96x96 --out truth
  subsurface export --to mitsuba --mesh head.glb --boundary rough --light 0,-1,0,0 --ambient 1 --out truth
  python3 reference/pictures/render.py truth --samples 64 --seeds 8 --out truth.exr")]
pub struct ExportArguments {
    /// Which path tracer.
    #[arg(long, value_enum, value_name = "PROGRAM")]
    pub to: Program,
    /// Directory of materials: one .ron file each, profiles in DIR/profiles.
    #[arg(long, value_name = "DIR", default_value = material_set::DEFAULT_DIRECTORY)]
    pub materials: PathBuf,
    /// What is drawn.
    #[command(flatten)]
    pub mesh: MeshArguments,
    /// Material of the set.
    #[arg(long, value_name = "NAME", default_value = DEFAULT_MATERIAL)]
    pub material: String,
    /// Size of the picture in pixels.
    #[arg(long, value_name = "WxH", default_value = "128x128")]
    pub size: Size,
    /// Camera and lights.
    #[command(flatten)]
    pub view: ViewArguments,
    /// What lies between the medium and the air.
    #[arg(long, value_enum, value_name = "KIND", default_value_t = BoundaryKind::Auto)]
    pub boundary: BoundaryKind,
    /// Folder for the scene, created if missing: red.xml, green.xml, blue.xml and a PLY file per object.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
}

/// Path tracers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Program {
    /// Mitsuba 3, <https://mitsuba-renderer.org>.
    Mitsuba,
}

/// What lies between a medium and the air.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum BoundaryKind {
    /// `matched` where a light has no size, else `rough`: such a light cannot be sampled through a rough boundary.
    #[default]
    Auto,
    /// Nothing: no highlights, and no refraction.
    Matched,
    /// A smooth dielectric, of the index that the material's reflectance at normal incidence says: light that is scattered
    /// comes out nearly as through a rough one, and a path tracer of single scattering loses none of it.
    Smooth,
    /// A rough dielectric with the material's roughness, and the index that its reflectance at normal incidence says.
    Rough,
}

/// What a path tracer's scene has otherwise than the picture.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Difference {
    NoHighlights,
    Black,
    MeanAlbedo { object: String },
    MeanScale { object: String },
    Shell { object: String },
    AlbedoMix { material: String },
    SmoothHighlights,
    NormalMap { object: String },
    Thin { material: String },
    GuessedEntry { material: String },
    SecondLobe { material: String },
    Strength { material: String },
    Spot,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoHighlights => {
                write!(f, "the exported boundary is matched: without highlights, and without refraction")
            }
            Self::Black => {
                write!(
                    f,
                    "lights without a size cannot be sampled through a boundary that refracts: their light will be missing"
                )
            }
            Self::MeanAlbedo { object } => {
                write!(f, "`{object}` has a texture of its surface albedo: its mean is exported")
            }
            Self::Shell { object } => {
                write!(f, "`{object}` is a shell: what its mesh bounds is exported as filled")
            }
            Self::MeanScale { object } => {
                write!(f, "`{object}` has a texture of its mean free path: its mean is exported")
            }
            Self::AlbedoMix { material } => {
                write!(f, "`{material}` has a `surface_albedo_mix`, which a medium cannot have")
            }
            Self::SmoothHighlights => {
                write!(f, "the exported boundary is smooth: its highlights are mirrored")
            }
            Self::NormalMap { object } => write!(f, "the normal map of `{object}` is not exported"),
            Self::Thin { material } => {
                write!(f, "`{material}` is a thin sheet: what its mesh bounds is exported as filled")
            }
            Self::SecondLobe { material } => {
                write!(f, "the second specular lobe of `{material}` is not exported")
            }
            Self::Strength { material } => {
                write!(f, "`{material}` has a transmission strength, which a medium cannot have")
            }
            Self::Spot => write!(
                f,
                "the edge of a spot's cone falls off by the angle, not by the cosine's square, and the lamp is a point"
            ),
            Self::GuessedEntry { material } => write!(
                f,
                "the profile of `{material}` does not say how light enters: perpendicular entry is taken"
            ),
        }
    }
}

impl Explain for Difference {
    fn help(&self) -> Option<String> {
        Some(
            match self {
                Self::NoHighlights => {
                    "compare with a picture whose material has `reflectance_at_normal: 0`, or export with \
                     --boundary rough and lights that have a size"
                }
                Self::Black => {
                    "give the lights a size, --light dx,dy,dz,intensity,degrees; or, for what scatters, use --boundary matched"
                }
                Self::AlbedoMix { .. } => {
                    "compare with a picture of one colour, where the mix changes nothing"
                }
                Self::SmoothHighlights => {
                    "compare in light from everywhere, whose mirror image is as even as a rough one's"
                }
                Self::MeanAlbedo { .. } | Self::MeanScale { .. } | Self::NormalMap { .. } => {
                    "compare with a picture of the same mesh without it"
                }
                Self::SecondLobe { .. } => "compare with a picture of a material without it",
                Self::Strength { .. } => "compare with a picture of a material whose strength is 1",
                Self::Spot => "compare within the cone's inner nine tenths",
                Self::Shell { .. } => "give the mesh an inner side, and the material no `shell_thickness_mm`",
                Self::Thin { .. } => "give the mesh the sheet's thickness, and the material no `thin`",
                Self::GuessedEntry { .. } => {
                    "name a published profile, or `diffuse: Chandrasekhar(entry: …)`"
                }
            }
            .into(),
        )
    }
}

/// Runs the command.
pub fn run(arguments: &ExportArguments) -> Result<(), Failure> {
    let materials = material_set::compile(&arguments.materials)?;
    let fallback = material_set::chosen(&materials, &arguments.material)?;
    let mut scene = load_scene(&arguments.mesh)?;
    let numbers = material_set::assign(&mut scene, &materials, fallback);
    let camera = arguments.view.camera(&scene, arguments.size)?;
    let lights: Vec<Light> =
        arguments.view.lights().into_iter().filter(|light| light.intensity() > 0.0).collect();
    std::fs::create_dir_all(&arguments.out).map_err(|reason| {
        let message = format!("cannot create {}: {reason}", arguments.out.display());
        Failure::new(message, "name a folder that may be written to with --out DIR")
    })?;
    for flaw in flaws(&scene) {
        eprintln!("{}\n", warning(&flaw));
    }
    let mut differences = Vec::new();
    let mut exported = Vec::new();
    let spinner = Spinner::new("writing meshes");
    for (index, (object, number)) in scene.objects.iter().zip(numbers).enumerate() {
        let file = format!("object_{index}.ply");
        write_atomically(&arguments.out.join(&file), &ply(&object.mesh))?;
        let material = &materials.set.materials[number as usize];
        let medium = match &object.surface.clear {
            _ if object.surface.is_black => None,
            Some(clear) => Some(clear_medium(object, clear, &lights, &mut differences)),
            None => Some(medium(object, material, arguments.boundary, &lights, &mut differences)),
        };
        exported.push(Exported { file, medium });
    }
    drop(spinner);
    if lights.iter().any(|light| matches!(light, Light::Spot(_))) {
        differences.push(Difference::Spot);
    }
    for (index, difference) in differences.iter().enumerate() {
        if !differences[..index].contains(difference) {
            eprintln!("{}\n", warning(difference));
        }
    }
    let environment = arguments.view.environment()?;
    for (channel, name) in CHANNELS.into_iter().enumerate() {
        let path = arguments.out.join(name).with_extension("xml");
        let sky = match &environment {
            Some(environment) => {
                let file = format!("environment_{name}.exr");
                let image = of_channel(environment, channel, arguments.view.ambient);
                write_exr(&arguments.out.join(&file), &image)?;
                Some((file, environment.turn_radians))
            }
            None => None,
        };
        let text = xml(channel, &exported, &camera, &lights, arguments.view.ambient, sky, arguments.size);
        write_atomically(&path, text.as_bytes())?;
        say!("{}", path.display());
    }
    Ok(())
}

fn medium(
    object: &Object,
    material: &Material,
    boundary: BoundaryKind,
    lights: &[Light],
    differences: &mut Vec<Difference>,
) -> (Medium, Boundary) {
    let name = || material.name.clone();
    if material.thin_thickness_mm.is_some() {
        differences.push(Difference::Thin { material: name() });
    }
    if material.profile.model.entry().is_none() {
        differences.push(Difference::GuessedEntry { material: name() });
    }
    if material.transmission_strength != 1.0 {
        differences.push(Difference::Strength { material: name() });
    }
    if material.second_lobe.is_some() {
        differences.push(Difference::SecondLobe { material: name() });
    }
    if object.surface.normal_map.is_some() {
        differences.push(Difference::NormalMap { object: object.name.clone() });
    }
    if object.surface.base_colour.is_some() {
        differences.push(Difference::MeanAlbedo { object: object.name.clone() });
    }
    if object.surface.mean_free_path_scale.is_some() {
        differences.push(Difference::MeanScale { object: object.name.clone() });
    }
    if material.surface_albedo_mix > 0.0 && object.surface.base_colour.is_some() {
        differences.push(Difference::AlbedoMix { material: name() });
    }
    let own = Boundary::of(material);
    let has_points = lights.iter().any(is_point);
    let boundary = match boundary {
        BoundaryKind::Matched => Boundary::Matched,
        BoundaryKind::Auto if has_points => Boundary::Matched,
        BoundaryKind::Smooth => own.smooth(),
        BoundaryKind::Auto | BoundaryKind::Rough => own,
    };
    match boundary {
        Boundary::Matched if own != Boundary::Matched => differences.push(Difference::NoHighlights),
        Boundary::Smooth { .. } | Boundary::Rough { .. } if has_points => differences.push(Difference::Black),
        Boundary::Smooth { .. } => differences.push(Difference::SmoothHighlights),
        Boundary::Matched | Boundary::Rough { .. } => (),
    }
    let albedo = surface_albedo(&object.surface, material);
    (Medium::of(material, albedo, mean_free_path_scale(&object.surface), boundary), boundary)
}

/// What is clear: a medium that scatters nothing.
fn clear_medium(
    object: &Object,
    clear: &ClearMaterial,
    lights: &[Light],
    differences: &mut Vec<Difference>,
) -> (Medium, Boundary) {
    if clear.shell_thickness_mm.is_some() {
        differences.push(Difference::Shell { object: object.name.clone() });
    }
    let boundary = Boundary::of_index(f64::from(clear.refractive_index), f64::from(clear.roughness));
    if boundary != Boundary::Matched && lights.iter().any(is_point) {
        differences.push(Difference::Black);
    }
    let medium = Medium {
        mean_free_path_mm: clear.absorption_per_mm.map(|absorption| 1.0 / f64::from(absorption)),
        single_scattering_albedo: [0.0; 3],
    };
    (medium, boundary)
}

/// One channel of an environment as grey, with its intensity, and light from everywhere alike: a scene of Mitsuba's has
/// one emitter around it.
fn of_channel(environment: &Environment, channel: usize, ambient: f32) -> LinearPicture {
    let grey = |pixel: &[f32; 3]| [environment.intensity * pixel[channel] + ambient; 3];
    let LinearPicture { size, pixels } = &environment.radiance;
    LinearPicture { size: *size, pixels: pixels.iter().map(grey).collect() }
}

/// Whether a light has no size.
fn is_point(light: &Light) -> bool {
    match light {
        Light::Directional(light) => light.angular_diameter_degrees == 0.0,
        Light::Point(lamp) => lamp.radius_mm == 0.0,
        Light::Spot(_) => true,
    }
}

/// The factor on the mean free path that a picture has in the mean.
fn mean_free_path_scale(surface: &Surface) -> f64 {
    let mean = surface.mean_free_path_scale.as_ref().map_or(1.0, |image| image.mean_linear_code(0));
    // As the shaders keep it.
    (mean * f64::from(surface.mean_free_path_scale_factor)).clamp(1e-3, 1e3)
}

/// The surface albedo that a picture has in the mean.
fn surface_albedo(surface: &Surface, material: &Material) -> [f64; 3] {
    let [red, green, blue, _] = surface.base_colour_factor;
    let factor = [red, green, blue];
    let texture = surface.base_colour.as_ref().map(crate::scene::Image::mean_linear);
    match texture {
        None if factor == [1.0; 3] => material.surface_albedo,
        texture => {
            let texture = texture.unwrap_or([1.0; 3]);
            [0, 1, 2].map(|channel: usize| (texture[channel] * f64::from(factor[channel])).clamp(0.0, 1.0))
        }
    }
}
