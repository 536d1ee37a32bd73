//! `subsurface profile coefficients`.

use super::curve::diffuse_mean_free_path;
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
use subsurface_profile::single_scattering_albedo::{Entry, from_surface_albedo};
use subsurface_profile::{Length, Model, RadialData};

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

/// What a model makes of the surface albedo.
struct Functions {
    names: &'static [&'static str],
    /// Their axes.
    labels: &'static [&'static str],
    /// The functions' argument: α for the polynomial, A for the others.
    argument: fn(f64) -> f64,
    argument_label: &'static str,
    values: fn(&Model, f64) -> Vec<f64>,
}

/// Runs the command.
pub(super) fn run(arguments: &CoefficientsArguments) -> Result<(), Failure> {
    if let Some(out) = &arguments.out {
        file::folder_of(out.path())?;
    }
    let model = model::load(&arguments.model, &arguments.materials)?;
    let functions = functions(&model).ok_or_else(|| {
        Failure::new(
            format!("`{}` has no functions of the surface albedo", arguments.model),
            "choose a Burley, polynomial or exponential + dipole profile",
        )
    })?;
    let own = || TruthName::Stored(Setting::of_model(&arguments.model));
    let truth = Truth::load(&arguments.truth.clone().unwrap_or_else(own))?;
    let data = chosen(&truth, &arguments.surface_albedos, arguments.how)?;
    let mut best = Vec::new();
    for table in &data {
        best.push(best_values(&model, table, &truth, &functions, arguments.how)?);
    }
    output::print(&csv(&functions, &model, &truth, &data, &best))?;
    if let Some(out) = &arguments.out {
        out.write(&figure(arguments, &truth, &functions, &model, &data, &best))?;
    }
    Ok(())
}

fn functions(model: &Model) -> Option<Functions> {
    let same = |surface_albedo| surface_albedo;
    Some(match model {
        Model::Burley(_) => Functions {
            names: &["s"],
            labels: &["s"],
            argument: same,
            argument_label: "surface albedo A",
            values: |model, surface_albedo| match model {
                Model::Burley(model) => vec![model.shape.at(surface_albedo)],
                _ => Vec::new(),
            },
        },
        Model::Polynomial(_) => Functions {
            names: &["a", "b", "c"],
            labels: &["a (1/mean free path)", "b", "c (mean free paths)"],
            argument: |surface_albedo| from_surface_albedo(Entry::Searchlight, surface_albedo),
            argument_label: "single-scattering albedo α",
            values: |model, surface_albedo| {
                let alpha = from_surface_albedo(Entry::Searchlight, surface_albedo);
                match model {
                    Model::Polynomial(model) => {
                        vec![model.a.at(alpha), model.b.at(alpha), model.c.at(alpha)]
                    }
                    _ => Vec::new(),
                }
            },
        },
        Model::ExponentialDipole(_) => Functions {
            names: &["w", "d", "z", "s/(1 − A)"],
            labels: &["w", "d (mean free paths)", "z (mean free paths)", "s/(1 − A) (1/mean free path)"],
            argument: same,
            argument_label: "surface albedo A",
            values: |model, surface_albedo| {
                let Model::ExponentialDipole(model) = model else { return Vec::new() };
                let lists = [
                    model.exponential_weight,
                    model.exponential_length,
                    model.dipole_depth,
                    model.dipole_attenuation,
                ];
                lists
                    .map(|list| list.iter().rev().fold(0.0, |sum, term| sum * surface_albedo + term))
                    .to_vec()
            },
        },
        _ => return None,
    })
}

/// The values that fit one table best.
fn best_values(
    model: &Model,
    table: &RadialData,
    truth: &Truth,
    functions: &Functions,
    how: HowToFit,
) -> Result<Vec<f64>, Failure> {
    let surface_albedo = table.surface_albedo();
    let fitted =
        fit(model, std::slice::from_ref(table), &how.options()).map_err(|error| failure(&error, truth))?;
    let mut values = (functions.values)(&fitted.model, surface_albedo);
    if let Model::Polynomial(polynomial) = &fitted.model {
        // The profile is divided by its integral, so that a factor of a and b is free. Here it is chosen so that
        // Liang et al.'s eq. (17) gives 1 at r_max.
        let energy = polynomial.energy_before_normalization(surface_albedo).map_err(|error| {
            Failure::new(
                format!("no polynomial fits at surface albedo {surface_albedo}: {error}"),
                "leave it out",
            )
        })?;
        values[..2].iter_mut().for_each(|value| *value /= energy);
    }
    if model.length() == Length::DiffuseMeanFreePath {
        // The fit counts the table's mean free paths; Burley's s is the length over d.
        let length = diffuse_mean_free_path(truth.medium_at(surface_albedo));
        values.iter_mut().for_each(|value| *value *= length);
    }
    Ok(values)
}

fn csv(
    functions: &Functions,
    model: &Model,
    truth: &Truth,
    data: &[RadialData],
    best: &[Vec<f64>],
) -> String {
    let mut text = String::from("surface_albedo,single_scattering_albedo");
    for name in functions.names {
        let name = name.split('/').next().unwrap_or(name);
        let _ = write!(text, ",{name}_best,{name}_model");
    }
    text.push('\n');
    for (table, best) in data.iter().zip(best) {
        let surface_albedo = table.surface_albedo();
        let _ = write!(text, "{surface_albedo},{:.6}", truth.medium_at(surface_albedo));
        for (best, model) in best.iter().zip((functions.values)(model, surface_albedo)) {
            let _ = write!(text, ",{best:.6},{model:.6}");
        }
        text.push('\n');
    }
    text
}

fn figure(
    arguments: &CoefficientsArguments,
    truth: &Truth,
    functions: &Functions,
    model: &Model,
    data: &[RadialData],
    best: &[Vec<f64>],
) -> Figure {
    /// Points of a line, from A = 0.005 on: some functions have no value at 0.
    const STEPS: u32 = 200;
    let surface_albedos: Vec<f64> =
        (1..=STEPS).map(|step| f64::from(step) / f64::from(STEPS)).filter(|a| *a < 1.0).collect();
    let panel = |(index, name): (usize, &&str)| {
        let line =
            surface_albedos.iter().map(|a| ((functions.argument)(*a), (functions.values)(model, *a)[index]));
        let dots = data
            .iter()
            .zip(best)
            .map(|(table, best)| ((functions.argument)(table.surface_albedo()), best[index]));
        let (line, dots): (Vec<_>, Vec<_>) = (line.collect(), dots.collect());
        let values = || line.iter().chain(&dots).map(|point: &(f64, f64)| point.1);
        let (low, high) = (values().fold(0.0, f64::min), values().fold(0.0, f64::max));
        let y = Axis::linear(functions.labels[index], 0.0, high - low).with_round_end();
        let y = Axis {
            low: if low < 0.0 { -y.high } else { 0.0 },
            high: if high > 0.0 { y.high } else { 0.0 },
            ..y
        };
        Panel {
            title: if functions.names.len() > 1 { (*name).to_owned() } else { String::new() },
            x: Axis::linear(functions.argument_label, 0.0, 1.0),
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
        panels: functions.names.iter().enumerate().map(panel).collect(),
    }
}
