//! `subsurface bench pictures`.

use super::output;
use super::view::load_scene;
use crate::failure::Failure;
use crate::picture::comparison::{Comparison, map};
use crate::picture::contact_sheet::{Tile, compose};
use crate::picture::{DisplayPicture, LinearPicture, file, write_small_png};
use crate::picture_bench::{Bench, TruthCase, Variant, read};
use crate::progress::bar;
use crate::say;
use crate::scene::Scene;
use crate::scene::camera::Size;
use crate::table::{Align, Table};
use clap::Args;
use std::fmt::Write as _;
use std::path::PathBuf;

/// Arguments of `subsurface bench pictures`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  subsurface bench pictures
  subsurface bench pictures --truth ellipsoid --truth slab_45
  subsurface bench pictures --truth bust --sheet bust.png")]
pub struct PicturesArguments {
    /// Folder of the truths: truths.txt, an EXR file for each of its lines, and their materials in DIR/materials.
    #[arg(long, value_name = "DIR", default_value = "reference/pictures")]
    pub truths: PathBuf,
    /// A truth to measure against. May be given several times; by default all of them.
    #[arg(long = "truth", value_name = "NAME")]
    pub names: Vec<String>,
    /// Also draw a sheet: of each truth what there is without subsurface scattering, the picture, the truth, and the error.
    #[arg(long, value_name = "FILE.png", value_parser = super::contact_sheet::png)]
    pub sheet: Option<PathBuf>,
}

/// Runs the command.
pub fn run(arguments: &PicturesArguments) -> Result<(), Failure> {
    if let Some(sheet) = &arguments.sheet {
        file::folder_of(sheet)?;
    }
    let cases = read(&arguments.truths, &arguments.names)?;
    let mut materials: Vec<String> = cases.iter().map(|case| case.material.clone()).collect();
    materials.sort();
    materials.dedup();
    let causes = Variant::causes();
    let models = Variant::models();
    let variants: Vec<Variant> = causes.iter().chain(&models).cloned().collect();
    let mut bench = Bench::new(&arguments.truths.join("materials"), &materials, &variants)?;
    let progress = bar((cases.len() * variants.len()) as u64, "drawing");
    let mut measured = Vec::new();
    let mut tiles = Vec::new();
    for case in &cases {
        let scene = load_scene(&case.scene.mesh)?;
        let mut found = Vec::new();
        for variant in &variants {
            found.push(bench.measure(case, &scene, variant)?);
            progress.inc(1);
        }
        if arguments.sheet.is_some() {
            tiles.extend(row(&mut bench, case, &scene)?);
        }
        measured.push(found);
    }
    progress.finish_and_clear();
    let mut text = String::from("The material as it is, by channel (red green blue):\n\n");
    let _ = writeln!(text, "{}", own(&cases, &measured));
    let _ = writeln!(text, "Relative RMSE beyond the truth's noise, mean of the channels, by cause:\n");
    let _ = writeln!(text, "{}", errors(&cases, &causes, &measured, 0));
    let _ = writeln!(text, "The same by profile model:\n");
    let _ = write!(text, "{}", errors(&cases, &models, &measured, causes.len()));
    output::print(&text)?;
    if let Some(path) = &arguments.sheet
        && let Some(sheet) = compose("no subsurface / picture / truth / error", &tiles, 4)
    {
        write_small_png(path, &sheet)?;
        say!("{}", path.display());
    }
    Ok(())
}

/// A row per truth of what the material gives as it is.
fn own(cases: &[TruthCase], measured: &[Vec<Comparison>]) -> Table {
    let heads = [
        ("truth", Align::Left),
        ("relative RMSE (%)", Align::Right),
        ("noise (%)", Align::Right),
        ("mean ratio", Align::Right),
        ("PSNR (dB)", Align::Right),
        ("FLIP", Align::Right),
    ];
    let mut table = Table::new(heads);
    for (case, found) in cases.iter().zip(measured) {
        let own = &found[0];
        let channels = |value: &dyn Fn(usize) -> String| [0, 1, 2].map(value).join(" ");
        let level = |channel: usize| mean(&case.truth.picture, &case.truth.counts, channel);
        table.row([
            case.name.clone(),
            channels(&|channel| format!("{:.1}", 100.0 * own.channels[channel].relative)),
            channels(&|channel| format!("{:.1}", 100.0 * own.channels[channel].noise / level(channel))),
            channels(&|channel| format!("{:.3}", own.channels[channel].mean_ratio)),
            channels(&|channel| format!("{:.1}", own.channels[channel].psnr)),
            format!("{:.3}", own.flip),
        ]);
    }
    table
}

/// A row per variant of the mean relative error of each truth, in percent.
fn errors(cases: &[TruthCase], variants: &[Variant], measured: &[Vec<Comparison>], first: usize) -> Table {
    let names = cases.iter().map(|case| (case.name.as_str(), Align::Right));
    let mut table = Table::new(std::iter::once(("", Align::Left)).chain(names));
    for (index, variant) in variants.iter().enumerate() {
        let error = |found: &Vec<Comparison>| {
            let channels = found[first + index].channels.map(|channel| channel.relative);
            format!("{:.1}", 100.0 * channels.iter().sum::<f64>() / 3.0)
        };
        table.row(std::iter::once(variant.label.clone()).chain(measured.iter().map(error)));
    }
    table
}

fn mean(picture: &LinearPicture, counts: &[bool], channel: usize) -> f64 {
    let counted = || picture.pixels.iter().zip(counts).filter(|(_, counts)| **counts);
    counted().map(|(pixel, _)| f64::from(pixel[channel])).sum::<f64>() / counted().count().max(1) as f64
}

/// Four tiles of a truth.
fn row(bench: &mut Bench, case: &TruthCase, scene: &Scene) -> Result<Vec<Tile>, Failure> {
    let plain = bench.draw(case, scene, &Variant::surface())?;
    let picture = bench.draw(case, scene, &Variant::own())?;
    let error = map(&picture, &case.truth);
    let shown = [plain.to_display(), picture.to_display(), case.truth.picture.to_display(), error];
    let captions = [case.name.as_str(), "picture", "truth", "error"];
    let tile = |(picture, caption): (DisplayPicture, &str)| Tile {
        picture: enlarged(&picture),
        caption: caption.into(),
    };
    Ok(shown.into_iter().zip(captions).map(tile).collect())
}

/// Width and height of a tile.
const TILE: Size = Size { width: 192, height: 256 };

/// The picture in the middle of a tile, each pixel twice as wide and as high.
fn enlarged(picture: &DisplayPicture) -> DisplayPicture {
    let Size { width, height } = picture.size;
    let large = Size { width: 2 * width, height: 2 * height };
    let pixel = |index: u32| {
        let (x, y) = (index % large.width / 2, index / large.width / 2);
        picture.pixels[(y * width + x) as usize]
    };
    let large = DisplayPicture { size: large, pixels: (0..large.width * large.height).map(pixel).collect() };
    let mut tile = DisplayPicture::filled(TILE, [0; 3]);
    let middle = |outer: u32, inner: u32| outer.saturating_sub(inner) / 2;
    tile.paste(&large, middle(TILE.width, large.size.width), middle(TILE.height, large.size.height));
    tile
}
