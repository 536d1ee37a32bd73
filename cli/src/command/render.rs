//! `subsurface render`.

use super::kernel::KernelArguments;
use super::material_set;
use super::view::{MeshArguments, ViewArguments, load_scene};
use crate::draw::device::Device;
use crate::draw::{Drawn, Frame, Needs, Shown, Studio};
use crate::failure::{Failure, warning};
use crate::picture::{exr, file, write_png};
use crate::progress::Spinner;
use crate::say;
use crate::scene::camera::Size;
use crate::scene::light_warning;
use clap::builder::{PossibleValuesParser, TypedValueParser as _};
use clap::{Args, value_parser};
use std::path::{Path, PathBuf};
use subsurface_runtime::DebugView;

/// The material when none is given.
pub(super) const DEFAULT_MATERIAL: &str = "skin";

/// Arguments of `subsurface render`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  subsurface render --out bust.png
  subsurface render --material marble --size 1920x1080 --kernel interleaved:8 --out bust.exr --aov buffers
  subsurface render --kernel importance-sampled --taps 33 --path fragment --out bust.png
  subsurface render --debug filter-radius --out radii.png
  subsurface render --timings --out bust.png
  subsurface render --mesh head.glb --camera 0.3,0.1,0.9 --target 0,0.05,0 --light 0.7,-0.5,-0.5,2.5 --out head.png
  subsurface render --mesh head.glb --environment studio.hdr --light 0,-1,0,0 --out head.png
  subsurface render --point 0.3,0.2,0.4,0.3,20 --ambient 0.1 --out lamp.png
  subsurface render --mesh head.glb --no-subsurface --out plain.png")]
pub struct RenderArguments {
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
    #[arg(long, value_name = "WxH", default_value = "1280x720")]
    pub size: Size,
    /// Which kernel diffuses.
    #[command(flatten)]
    pub kernel: KernelArguments,
    /// Camera and lights.
    #[command(flatten)]
    pub view: ViewArguments,
    /// Leave the subsurface pass out: what a plain diffuse surface looks like.
    #[arg(long)]
    pub no_subsurface: bool,
    /// Draw what the subsurface pass does, in place of what comes of it.
    #[arg(long, value_name = "VIEW", value_parser = debug_view(), conflicts_with = "no_subsurface")]
    pub debug: Option<DebugView>,
    /// Pixels drawn per pixel of the picture, along each side: 2 or more smooth the silhouettes.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = value_parser!(u32).range(1..=8))]
    pub supersample: u32,
    /// Texels per side of each light's shadow map, 64 to 16384; by default 2048.
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(64..=16384))]
    pub shadow_map_size: Option<u32>,
    /// Print how long each pass took on the device; the frame is then drawn twice, since the first time compiles shaders.
    ///
    /// An adapter without timestamps is timed from submission until it is done.
    #[arg(long)]
    pub timings: bool,
    /// The picture: .png (tone-mapped, 8-bit sRGB) or .exr (linear, 32-bit float).
    #[arg(long, value_name = "FILE.png|FILE.exr", value_parser = PictureFile::parse)]
    pub out: PictureFile,
    /// Also write the intermediate targets as EXR files to this directory; created if missing.
    #[arg(long, value_name = "DIR")]
    pub aov: Option<PathBuf>,
}

/// The debug views by their names.
fn debug_view() -> impl clap::builder::TypedValueParser<Value = DebugView> {
    PossibleValuesParser::new(DebugView::ALL.iter().map(|view| view.name())).try_map(|name| {
        let known = DebugView::ALL.iter().find(|view| view.name() == name);
        known.copied().ok_or("no such view")
    })
}

/// A path whose ending says in which format a picture is written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PictureFile {
    /// 8-bit sRGB.
    Png(PathBuf),
    /// 32-bit linear.
    Exr(PathBuf),
}

impl PictureFile {
    /// By the ending of the file's name.
    pub fn parse(text: &str) -> Result<Self, String> {
        let path = PathBuf::from(text);
        let extension = path.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase());
        match extension.as_deref() {
            Some("png") => Ok(Self::Png(path)),
            Some("exr") => Ok(Self::Exr(path)),
            _ => Err("the name must end in .png or .exr".into()),
        }
    }

    /// The path.
    pub fn path(&self) -> &Path {
        match self {
            Self::Png(path) | Self::Exr(path) => path,
        }
    }
}

/// Runs the command.
pub fn run(arguments: &RenderArguments) -> Result<(), Failure> {
    // Everything that can fail at once comes before what takes long.
    file::folder_of(arguments.out.path())?;
    let compiler = material_set::compiler(&arguments.materials)?;
    let compiler = if arguments.debug.is_some() { compiler.with_debug_views() } else { compiler };
    let materials = arguments.kernel.compile(&compiler)?;
    let fallback = material_set::chosen(&materials, &arguments.material)?;
    // Without an adapter, there is no point in reading a mesh.
    let device = Device::open()?;
    let mut scene = load_scene(&arguments.mesh)?;
    let material_of_object = material_set::assign(&mut scene, &materials, fallback);
    let needs = Needs { shadow_map_size: arguments.shadow_map_size, ..Needs::of(&scene) };
    let mut studio = Studio::on(device, &materials, arguments.kernel.route.chosen(), needs)?;
    let environment = arguments.view.environment()?;
    let lights = arguments.view.lights();
    for suspect in light_warning::warnings(&lights, &scene.bounds) {
        eprintln!("{}\n", warning(&suspect));
    }
    let drawn = {
        let _spinner = Spinner::new("drawing");
        studio.draw(&Frame {
            scene: &scene,
            material_of_object: &material_of_object,
            camera: arguments.view.camera(&scene, arguments.size)?,
            lights: &lights,
            ambient_intensity: arguments.view.ambient,
            environment: environment.as_ref(),
            size: arguments.size,
            shown: match arguments.debug {
                Some(view) => Shown::Debug(view),
                None if arguments.no_subsurface => Shown::Surface,
                None => Shown::Subsurface,
            },
            wants_aovs: arguments.aov.is_some(),
            wants_timings: arguments.timings,
            supersampling: arguments.supersample,
        })?
    };
    save(arguments, &drawn)?;
    if let Some(timings) = &drawn.timings {
        say!("{}: {timings}", studio.description());
        if !timings.by_device {
            say!("the adapter has no timestamps: these times go from submission until it was done");
        }
    }
    Ok(())
}

fn save(arguments: &RenderArguments, drawn: &Drawn) -> Result<(), Failure> {
    match &arguments.out {
        PictureFile::Png(path) => write_png(path, &drawn.display)?,
        PictureFile::Exr(path) => exr::write_exr(path, &drawn.linear)?,
    }
    say!("{}", arguments.out.path().display());
    if let Some(folder) = &arguments.aov {
        std::fs::create_dir_all(folder).map_err(|reason| {
            let message = format!("cannot create {}: {reason}", folder.display());
            Failure::new(message, "name a folder that may be written to with --aov DIR")
        })?;
        for (name, picture) in &drawn.aovs {
            let path = folder.join(name).with_extension("exr");
            exr::write_exr(&path, picture)?;
            say!("{}", path.display());
        }
    }
    Ok(())
}
