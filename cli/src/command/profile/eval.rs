//! `subsurface profile eval` and `subsurface profile sample`.

use super::model;
use crate::command::{material_set, number};
use crate::failure::Failure;
use clap::{Args, ValueEnum};
use std::fmt::Write as _;
use std::path::PathBuf;
use subsurface_profile::{Channel, Length, Medium, Model, RadialProfile};

/// Which profile.
#[derive(Debug, Args)]
pub struct ProfileOf {
    /// Stem of a file in DIR/profiles, the name of a built-in profile, or a profile file (.ron).
    #[arg(long, value_name = "STEM|FILE.ron")]
    pub model: String,
    /// Surface albedo A, the total diffuse reflectance, in [0, 1].
    #[arg(long, value_name = "A", value_parser = number::surface_albedo, allow_hyphen_values = true)]
    pub surface_albedo: f64,
    /// Mean free path 1/σt in mm, above 0; the diffuse mean free path 1/σtr for models parametrized by it. Models
    /// with lengths of their own, such as Gaussian sums, do not use it.
    #[arg(long, value_name = "L", value_parser = number::mean_free_path_mm, allow_hyphen_values = true)]
    pub mean_free_path_mm: f64,
    /// Colour channel; only models with coefficients per channel, such as Gaussian sums, differ.
    #[arg(long, value_enum, default_value_t)]
    pub channel: ChannelName,
    /// Directory of materials whose profiles STEM may name.
    #[arg(long, value_name = "DIR", default_value = material_set::DEFAULT_DIRECTORY)]
    pub materials: PathBuf,
}

/// A colour channel.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub enum ChannelName {
    /// Red.
    #[default]
    Red,
    /// Green.
    Green,
    /// Blue.
    Blue,
}

/// Arguments of `profile eval`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  subsurface profile eval --model exponential_dipole_searchlight --surface-albedo 0.83 \\
      --mean-free-path-mm 1.3 --radii 0,0.1,1,10
  subsurface profile eval --model my_profile.ron --surface-albedo 0.5 --mean-free-path-mm 2 --radii 1")]
pub struct EvalArguments {
    /// Which profile.
    #[command(flatten)]
    pub profile: ProfileOf,
    /// Radii in mm, 0 or more.
    #[arg(long, value_name = "r,r,…", required = true, value_delimiter = ',', value_parser = number::radius_mm, allow_hyphen_values = true)]
    pub radii: Vec<f64>,
    /// The fraction of the energy that filter_radius_mm gathers, in [0, 1).
    #[arg(long, value_name = "Q", default_value = "0.997", value_parser = number::fraction, allow_hyphen_values = true)]
    pub quantile: f64,
}

/// Arguments of `profile sample`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  subsurface profile sample --model burley_searchlight --surface-albedo 0.83 --mean-free-path-mm 1.3 --u 0,0.5,0.997")]
pub struct SampleArguments {
    /// Which profile.
    #[command(flatten)]
    pub profile: ProfileOf,
    /// Uniform random numbers, in [0, 1).
    #[arg(long, value_name = "u,u,…", required = true, value_delimiter = ',', value_parser = number::fraction, allow_hyphen_values = true)]
    pub u: Vec<f64>,
}

/// The table of `profile eval`.
pub(super) fn evaluate(arguments: &EvalArguments) -> Result<String, Failure> {
    let of = &arguments.profile;
    let model = of.model()?;
    let profile = of.profile(&model)?;
    let (length_name, note) = match model.length() {
        Length::MeanFreePath => ("mean_free_path_mm", None),
        Length::DiffuseMeanFreePath => (
            "diffuse_mean_free_path_mm",
            Some(
                "this model is parametrized by the diffuse mean free path: the length is read as 1/sigma_tr",
            ),
        ),
    };
    let mut lines = vec![
        format!("model = {}", of.model),
        format!("channel = {}", of.channel.name()),
        format!("surface_albedo = {:?}", of.surface_albedo),
        format!("{length_name} = {:?}", of.mean_free_path_mm),
    ];
    lines.extend(note.map(str::to_owned));
    lines.push(format!("quantile = {:?}", arguments.quantile));
    lines.push(format!("filter_radius_mm = {:?}", profile.filter_radius(arguments.quantile)));
    lines.extend(profile.max_radius().map(|radius| format!("r_max_mm = {radius:?}")));
    let mut table: String = lines.iter().map(|line| format!("# {line}\n")).collect();
    table.push_str("radius_mm,area_pdf,radial_pdf,radial_cdf\n");
    for radius in &arguments.radii {
        let row =
            [*radius, profile.area_pdf(*radius), profile.radial_pdf(*radius), profile.radial_cdf(*radius)];
        push_row(&mut table, &row);
    }
    Ok(table)
}

/// The table of `profile sample`.
pub(super) fn sample(arguments: &SampleArguments) -> Result<String, Failure> {
    let model = arguments.profile.model()?;
    let profile = arguments.profile.profile(&model)?;
    let mut table = String::from("u,radius_mm\n");
    for u in &arguments.u {
        push_row(&mut table, &[*u, profile.sample_radius(*u)]);
    }
    Ok(table)
}

/// `{:?}` of an `f64` is the shortest text that reads back as the same number.
fn push_row(table: &mut String, row: &[f64]) {
    for (column, value) in row.iter().enumerate() {
        let separator = if column == 0 { "" } else { "," };
        // Writing to a string cannot fail.
        let _ = write!(table, "{separator}{value:?}");
    }
    table.push('\n');
}

impl ChannelName {
    fn channel(self) -> Channel {
        match self {
            Self::Red => Channel::Red,
            Self::Green => Channel::Green,
            Self::Blue => Channel::Blue,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Red => "red",
            Self::Green => "green",
            Self::Blue => "blue",
        }
    }
}

impl ProfileOf {
    fn model(&self) -> Result<Model, Failure> {
        model::load(&self.model, &self.materials)
    }

    fn profile(&self, model: &Model) -> Result<Box<dyn RadialProfile>, Failure> {
        let refused = |reason: String| {
            Failure::new(
                format!("the profile `{}` does not exist here: {reason}", self.model),
                "choose another surface albedo, or correct the model's coefficients",
            )
        };
        let medium = Medium::new(self.surface_albedo, self.mean_free_path_mm)
            .map_err(|reason| refused(reason.to_string()))?;
        model.profile(medium, self.channel.channel()).map_err(|reason| refused(reason.to_string()))
    }
}
