//! `subsurface contact-sheet`.

use super::kernel::KernelArguments;
use super::material_set;
use super::render::{DEFAULT_MATERIAL, PictureFile};
use super::view::{MeshArguments, load_scene};
use crate::draw::device::Device;
use crate::draw::{Frame, Needs, Shown, Studio};
use crate::failure::Failure;
use crate::picture::contact_sheet::{Tile, compose};
use crate::picture::{file, write_png};
use crate::progress::bar;
use crate::say;
use crate::scene::camera::{Camera, DEFAULT_FOV_Y_DEGREES, Size};
use crate::scene::light::{DEFAULT_AMBIENT_INTENSITY, Light};
use clap::{Args, value_parser};
use std::path::{Path, PathBuf};
use subsurface_codegen::Compiler;
use subsurface_profile::ModelKind;

/// Arguments of `subsurface contact-sheet`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  subsurface contact-sheet --out sheet.png
  subsurface contact-sheet --model burley_searchlight --model burley_diffuse --out two.png
  subsurface contact-sheet --mesh head.glb --material skin --size 640x800 --kernel interleaved:8 --out sheet.png")]
pub struct ContactSheetArguments {
    /// Directory of materials: one .ron file each, profiles in DIR/profiles.
    #[arg(long, value_name = "DIR", default_value = material_set::DEFAULT_DIRECTORY)]
    pub materials: PathBuf,
    /// What is drawn.
    #[command(flatten)]
    pub mesh: MeshArguments,
    /// Material of the set; it must give its mean free path.
    #[arg(long, value_name = "NAME", default_value = DEFAULT_MATERIAL)]
    pub material: String,
    /// A profile to show: the stem of a file in DIR/profiles, or the name of a built-in profile. May be given several
    /// times; by default one of each model.
    #[arg(long = "model", value_name = "STEM")]
    pub models: Vec<String>,
    /// Size of each tile in pixels.
    #[arg(long, value_name = "WxH", default_value = "480x600")]
    pub size: Size,
    /// Which kernel diffuses.
    #[command(flatten)]
    pub kernel: KernelArguments,
    /// Pixels drawn per pixel of the sheet, along each side: 2 or more smooth the silhouettes.
    #[arg(long, value_name = "N", default_value_t = 2, value_parser = value_parser!(u32).range(1..=8))]
    pub supersample: u32,
    /// The sheet: .png.
    #[arg(long, value_name = "FILE.png", value_parser = png)]
    pub out: PathBuf,
}

/// A file's name, which must end in .png.
pub(super) fn png(text: &str) -> Result<PathBuf, String> {
    match PictureFile::parse(text) {
        Ok(PictureFile::Png(path)) => Ok(path),
        _ => Err("the name must end in .png".into()),
    }
}

/// A tile: its caption, and the stem of its profile; without one, there is no subsurface pass.
type TileOf = (String, Option<String>);

/// The surface alone, then the models given; for none, each model that has a published set, with its first.
fn tiles(models: &[String]) -> Vec<TileOf> {
    let given = models.iter().map(|stem| (stem.clone(), Some(stem.clone())));
    let all = ModelKind::ALL.iter().filter_map(|kind| {
        let first = kind.published().into_iter().next()?;
        Some((kind.description().caption.to_owned(), Some(first.stem.to_owned())))
    });
    let surface = std::iter::once(("no subsurface".to_owned(), None));
    if models.is_empty() { surface.chain(all).collect() } else { surface.chain(given).collect() }
}

/// Tiles in a row.
const COLUMNS: u32 = 4;

/// Runs the command.
pub fn run(arguments: &ContactSheetArguments) -> Result<(), Failure> {
    file::folder_of(&arguments.out)?;
    let original = material_set::compile(&arguments.materials)?;
    material_set::number(&original, &arguments.material)?;
    // One set, hence one kernel module, holds all variants.
    let shown = tiles(&arguments.models);
    let files = with_variants(&original.files_read, &shown, arguments)?;
    let materials = arguments.kernel.compile(&Compiler::from_memory(files))?;
    // Without an adapter, there is no point in sculpting.
    let device = Device::open()?;
    let scene = load_scene(&arguments.mesh)?;
    let mut studio = Studio::on(device, &materials, arguments.kernel.route.chosen(), Needs::of(&scene))?;
    say!("{}", studio.description());
    let camera = Camera::framing(&scene, arguments.size.aspect(), DEFAULT_FOV_Y_DEGREES);
    let progress = bar(shown.len() as u64, "drawing");
    let mut tiles = Vec::new();
    for (caption, profile) in &shown {
        let name = profile.as_deref().map_or_else(|| arguments.material.clone(), variant_name);
        let material = material_set::number(&materials, &name)?;
        let drawn = studio.draw(&Frame {
            scene: &scene,
            material_of_object: &vec![material; scene.objects.len()],
            camera,
            lights: &Light::DEFAULT,
            ambient_intensity: DEFAULT_AMBIENT_INTENSITY,
            environment: None,
            size: arguments.size,
            shown: if profile.is_some() { Shown::Subsurface } else { Shown::Surface },
            wants_aovs: false,
            wants_timings: true,
            supersampling: arguments.supersample,
        })?;
        tiles.push(Tile { picture: drawn.display, caption: caption.clone() });
        if let Some(timings) = &drawn.timings {
            progress.suspend(|| say!("{caption}: {timings}"));
        }
        progress.inc(1);
    }
    progress.finish_and_clear();
    let title = format!("{} / {}", arguments.material, materials.estimator());
    if let Some(sheet) = compose(&title, &tiles, COLUMNS) {
        write_png(&arguments.out, &sheet)?;
        say!("{}", arguments.out.display());
    }
    Ok(())
}

/// Name of the variant with the profile `stem`; unlikely to be taken.
fn variant_name(stem: &str) -> String {
    format!("contact_sheet_{stem}")
}

/// The files of the set, and for each tile a material that inherits everything but the profile.
fn with_variants(
    files: &[PathBuf],
    shown: &[TileOf],
    arguments: &ContactSheetArguments,
) -> Result<Vec<(PathBuf, Vec<u8>)>, Failure> {
    let mut all = Vec::new();
    for path in files {
        let bytes = std::fs::read(path).map_err(|reason| {
            Failure::new(
                format!("cannot read {}: {reason}", path.display()),
                "the file changed meanwhile: try again",
            )
        })?;
        all.push((path.strip_prefix(&arguments.materials).unwrap_or(path).to_owned(), bytes));
    }
    for stem in shown.iter().filter_map(|(_, stem)| stem.as_deref()) {
        all.push(variant(stem, &arguments.material));
    }
    Ok(all)
}

fn variant(stem: &str, base: &str) -> (PathBuf, Vec<u8>) {
    let text = format!("Material(base: \"{base}\", profile: \"{stem}\")\n");
    (Path::new(&variant_name(stem)).with_extension("ron"), text.into_bytes())
}
