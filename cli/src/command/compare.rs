//! `subsurface compare`.

use super::number;
use super::output;
use crate::failure::Failure;
use crate::picture::comparison::{self, Comparison, Truth};
use crate::picture::exr::Channels;
use crate::picture::{file, write_png};
use crate::say;
use crate::table::{Align, Table};
use clap::Args;
use std::path::PathBuf;

/// Arguments of `subsurface compare`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  subsurface compare picture.exr truth.exr
  subsurface compare picture.exr truth.exr --mask face.exr --map error.png

The picture's size must be the truth's: draw it with --size, and smooth with --supersample.")]
pub struct CompareArguments {
    /// The picture: channels R, G, B, linear.
    #[arg(value_name = "PICTURE.exr")]
    pub picture: PathBuf,
    /// The truth: R, G, B; where it has them, its standard errors stderr.R, stderr.G, stderr.B, whose noise does not
    /// count as the picture's error, and its coverage A.
    #[arg(value_name = "TRUTH.exr")]
    pub truth: PathBuf,
    /// Pixels that count: those where Y, or R, is above 0.5. By default all that are covered and have a hundredth of the
    /// brightest one's light.
    #[arg(long, value_name = "MASK.exr")]
    pub mask: Option<PathBuf>,
    /// Factor on both pictures before FLIP sees them.
    #[arg(long, value_name = "X", default_value_t = 1.0, value_parser = number::exposure, allow_hyphen_values = true)]
    pub exposure: f32,
    /// Also write the error as a picture: red where there is too much light, blue where there is too little, in full
    /// colour from a quarter of the truth's mean on.
    #[arg(long, value_name = "ERROR.png", value_parser = super::contact_sheet::png)]
    pub map: Option<PathBuf>,
}

/// Runs the command.
pub fn run(arguments: &CompareArguments) -> Result<(), Failure> {
    if let Some(map) = &arguments.map {
        file::folder_of(map)?;
    }
    let channels = Channels::read(&arguments.picture)?;
    let picture = comparison::read_picture(&arguments.picture, &channels)?;
    let mut truth = Truth::read(&arguments.truth)?;
    if picture.size != truth.picture.size {
        let message = format!(
            "{} is {} pixels, and {} is {}",
            arguments.picture.display(),
            picture.size,
            arguments.truth.display(),
            truth.picture.size
        );
        let remedy = format!("draw it with --size {}", truth.picture.size);
        return Err(Failure::new(message, remedy));
    }
    if let Some(mask) = &arguments.mask {
        truth.mask(mask)?;
    }
    let Some(found) = comparison::compare(&picture, &truth, arguments.exposure) else {
        return Err(Failure::new("no pixel counts", "give another --mask, or a truth that is not black"));
    };
    output::print(&text(&found, &truth))?;
    if let Some(path) = &arguments.map {
        write_png(path, &comparison::map(&picture, &truth))?;
        say!("{}", path.display());
    }
    Ok(())
}

fn text(found: &Comparison, truth: &Truth) -> String {
    let heads = ["", "red", "green", "blue"].into_iter();
    let mut table = Table::new(heads.zip([Align::Left, Align::Right, Align::Right, Align::Right]));
    let mut row = |name: &str, values: [String; 3]| table.row([name.to_owned()].into_iter().chain(values));
    let figures = &found.channels;
    row("RMSE", figures.map(|channel| format!("{:.5}", channel.rmse)));
    if truth.standard_error.is_some() {
        row("noise of the truth", figures.map(|channel| format!("{:.5}", channel.noise)));
        row("relative RMSE beyond noise", figures.map(|channel| format!("{:.4}", channel.relative)));
    } else {
        row("relative RMSE", figures.map(|channel| format!("{:.4}", channel.relative)));
    }
    row("PSNR (dB)", figures.map(|channel| format!("{:.2}", channel.psnr)));
    row("mean ratio", figures.map(|channel| format!("{:.4}", channel.mean_ratio)));
    format!("{table}FLIP {:.4}\n{} of {} pixels count\n", found.flip, found.pixels, truth.counts.len())
}
