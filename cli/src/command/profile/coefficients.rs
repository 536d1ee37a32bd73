//! `subsurface profile coefficients`.

use super::fit::{HowToFit, chosen, failure};
use super::model;
use super::truth::{Setting, Truth, TruthName};
use crate::command::{material_set, number, output};
use crate::failure::Failure;
use crate::picture::file;
use crate::plot::{Axis, Colour, Dash, Figure, FigureFile, Mark, Panel, Series};
use clap::Args;
use std::fmt::Write as _;
use std::path::PathBuf;
use subsurface_profile::fit::fit;
use subsurface_profile::single_scattering_albedo::diffuse_per_mean_free_path;
use subsurface_profile::{FunctionOfAlbedo, Length, Model, ModelKind, RadialData};

/// Arguments of `profile coefficients`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  subsurface profile coefficients --model burley_searchlight --criterion relative-error
  subsurface profile coefficients --model liang_2023 --criterion r-reflectance --crop --out coefficients.svg")]
pub struct CoefficientsArguments {
    /// The model: the stem of a file in DIR/profiles, the name of a built-in profile, or a profile file (.ron).
    #[arg(long, value_name = "STEM|FILE.ron")]
    pub model: String,
    /// The truth: searchlight, diffuse, searchlight-eta-1.4, diffuse-eta-1.4 or a CSV file; by default that of the
    /// model's own setting.
    #[arg(long, value_name = "NAME|FILE.csv")]
    pub truth: Option<TruthName>,
    #[command(flatten)]
    pub how: HowToFit,
    /// Surface albedos A of the truth; by default all.
    #[arg(long = "surface-albedo", value_name = "A,A,…", value_delimiter = ',', value_parser = number::surface_albedo, allow_hyphen_values = true)]
    pub surface_albedos: Vec<f64>,
    /// Directory of materials whose profiles STEM may name.
    #[arg(long, value_name = "DIR", default_value = material_set::DEFAULT_DIRECTORY)]
    pub materials: PathBuf,
    /// Draw a figure, .svg or .png: lines are the model's functions, dots the best values. The numbers are printed in
    /// any case.
    #[arg(long, value_name = "FILE.svg|.png", value_parser = FigureFile::parse)]
    pub out: Option<FigureFile>,
}

/// Runs the command.
pub(super) fn run(arguments: &CoefficientsArguments) -> Result<(), Failure> {
    if let Some(out) = &arguments.out {
        file::folder_of(out.path())?;
    }
    let model = model::load(&arguments.model, &arguments.materials)?;
    if model.kind().functions().is_empty() {
        let with = ModelKind::ALL.iter().filter(|kind| !kind.functions().is_empty());
        let captions: Vec<&str> = with.map(|kind| kind.description().caption).collect();
        return Err(Failure::new(
            format!("`{}` has no functions of the surface albedo", arguments.model),
            format!("choose a profile of one of these models: {}", captions.join(", ")),
        ));
    }
    let own = || TruthName::Stored(Setting::of_model(&arguments.model));
    let truth = Truth::load(&arguments.truth.clone().unwrap_or_else(own))?;
    let data = chosen(&truth, &arguments.surface_albedos, arguments.how)?;
    let mut best = Vec::new();
    for table in &data {
        best.push(best_values(&model, table, &truth, arguments.how)?);
    }
    output::print(&csv(&model, &truth, &data, &best))?;
    if let Some(out) = &arguments.out {
        out.write(&figure(arguments, &truth, &model, &data, &best))?;
    }
    Ok(())
}

/// The values that fit one table best.
fn best_values(model: &Model, table: &RadialData, truth: &Truth, how: HowToFit) -> Result<Vec<f64>, Failure> {
    let surface_albedo = table.surface_albedo();
    let fitted =
        fit(model, std::slice::from_ref(table), &how.options()).map_err(|error| failure(&error, truth))?;
    // A profile that is divided by its own integral leaves a factor free. Here it is chosen so that the integral is 1.
    let energy =
        fitted.model.energy_before_normalization(surface_albedo).unwrap_or(Ok(1.0)).map_err(|error| {
            Failure::new(
                format!("no such model fits at surface albedo {surface_albedo}: {error}"),
                "leave it out",
            )
        })?;
    // The fit counts the table's mean free paths.
    let length = match model.length() {
        Length::MeanFreePath => 1.0,
        Length::DiffuseMeanFreePath => diffuse_per_mean_free_path(truth.medium_at(surface_albedo)),
    };
    let values = fitted.model.functions_at(surface_albedo).into_iter().zip(model.kind().functions());
    let value = |(value, function): (f64, FunctionOfAlbedo)| {
        let value = if function.is_scaled_by_energy { value / energy } else { value };
        value * length.powi(function.length_power)
    };
    Ok(values.map(value).collect())
}

fn csv(model: &Model, truth: &Truth, data: &[RadialData], best: &[Vec<f64>]) -> String {
    let mut text = String::from("surface_albedo,single_scattering_albedo");
    for FunctionOfAlbedo { symbol: name, .. } in model.kind().functions() {
        let name = name.split('/').next().unwrap_or(name);
        let _ = write!(text, ",{name}_best,{name}_model");
    }
    text.push('\n');
    for (table, best) in data.iter().zip(best) {
        let surface_albedo = table.surface_albedo();
        let _ = write!(text, "{surface_albedo},{:.6}", truth.medium_at(surface_albedo));
        for (best, model) in best.iter().zip(model.functions_at(surface_albedo)) {
            let _ = write!(text, ",{best:.6},{model:.6}");
        }
        text.push('\n');
    }
    text
}

fn figure(
    arguments: &CoefficientsArguments,
    truth: &Truth,
    model: &Model,
    data: &[RadialData],
    best: &[Vec<f64>],
) -> Figure {
    /// Points of a line, from A = 0.005 on: some functions have no value at 0.
    const STEPS: u32 = 200;
    let surface_albedos: Vec<f64> =
        (1..=STEPS).map(|step| f64::from(step) / f64::from(STEPS)).filter(|a| *a < 1.0).collect();
    let functions = model.kind().functions();
    let argument = model.kind().argument();
    let panel = |(index, function): (usize, &FunctionOfAlbedo)| {
        let line = surface_albedos.iter().map(|a| ((argument.at)(*a), model.functions_at(*a)[index]));
        let dots =
            data.iter().zip(best).map(|(table, best)| ((argument.at)(table.surface_albedo()), best[index]));
        let (line, dots): (Vec<_>, Vec<_>) = (line.collect(), dots.collect());
        let values = || line.iter().chain(&dots).map(|point: &(f64, f64)| point.1);
        let (low, high) = (values().fold(0.0, f64::min), values().fold(0.0, f64::max));
        let y = Axis::linear(function.label, 0.0, high - low).with_round_end();
        let y = Axis {
            low: if low < 0.0 { -y.high } else { 0.0 },
            high: if high > 0.0 { y.high } else { 0.0 },
            ..y
        };
        Panel {
            title: if functions.len() > 1 { function.symbol.to_owned() } else { String::new() },
            x: Axis::linear(argument.label, 0.0, 1.0),
            y,
            series: vec![
                Series {
                    label: arguments.model.clone(),
                    colour: Colour::unordered(0),
                    mark: Mark::Line(Dash::SOLID),
                    points: line,
                },
                Series {
                    label: "fitted to Monte Carlo, each albedo alone".into(),
                    colour: Colour::BLACK,
                    mark: Mark::Dots,
                    points: dots,
                },
            ],
        }
    };
    Figure {
        title: format!("Coefficients of {}, {}", arguments.model, truth.describe()),
        panels: functions.iter().enumerate().map(panel).collect(),
    }
}
