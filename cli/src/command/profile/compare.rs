//! `subsurface profile compare`.

use super::curve::profile;
use super::model;
use super::truth::{Setting, Truth, TruthName};
use crate::command::{material_set, number, output};
use crate::failure::Failure;
use crate::table::{Align, Table};
use clap::Args;
use std::fmt::Write as _;
use std::path::PathBuf;
use subsurface_profile::{Deviation, Model};

/// Arguments of `profile compare`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  subsurface profile compare
  subsurface profile compare --model burley_searchlight --model my_profile.ron --surface-albedo 0.2,0.5,0.8
  subsurface profile compare --truth my_measurement.csv --csv errors.csv
  subsurface profile compare --summary")]
pub struct CompareArguments {
    /// A model: the stem of a file in DIR/profiles, the name of a built-in profile, or a profile file (.ron). May be
    /// given several times; by default all of DIR/profiles and all built-in ones, but those whose
    /// lengths are those of one material, such as Gaussian sums.
    #[arg(long = "model", value_name = "STEM|FILE.ron")]
    pub models: Vec<String>,
    /// Surface albedos A of the truth; by default all.
    #[arg(long = "surface-albedo", value_name = "A,A,…", value_delimiter = ',', value_parser = number::surface_albedo, allow_hyphen_values = true)]
    pub surface_albedos: Vec<f64>,
    /// The truth for all models: searchlight, diffuse, searchlight-eta-1.4, diffuse-eta-1.4 or a CSV file; by default
    /// each model's own setting.
    #[arg(long, value_name = "NAME|FILE.csv")]
    pub truth: Option<TruthName>,
    /// Surface albedos that the models were fitted to: they are marked, and the summary tells the others apart. By
    /// default those of this project's own fits, and none for other models.
    #[arg(long = "fitted", value_name = "A,A,…", value_delimiter = ',', value_parser = number::surface_albedo, allow_hyphen_values = true)]
    pub fitted: Vec<f64>,
    /// Print the means and the worst cases alone.
    #[arg(long)]
    pub summary: bool,
    /// Also write all numbers as CSV, unrounded; `-` prints that in place of the table.
    #[arg(long, value_name = "FILE.csv")]
    pub csv: Option<PathBuf>,
    /// Directory of materials whose profiles STEM may name.
    #[arg(long, value_name = "DIR", default_value = material_set::DEFAULT_DIRECTORY)]
    pub materials: PathBuf,
}

/// A model at one surface albedo.
#[derive(Clone, Debug)]
struct Score {
    surface_albedo: f64,
    is_fitted: bool,
    deviation: Deviation,
    r_max: Option<f64>,
    /// Liang et al. 2023, eq. (17) at r_max: the energy before the profile is divided by it, over A.
    cdf_at_r_max: Option<f64>,
}

/// A model at all surface albedos.
#[derive(Clone, Debug)]
struct Scores {
    name: String,
    truth: TruthName,
    scores: Vec<Score>,
}

/// Runs the command.
pub(super) fn run(arguments: &CompareArguments) -> Result<(), Failure> {
    if let Some(path) = &arguments.csv {
        output::check(path)?;
    }
    let mut all = Vec::new();
    for (name, model) in models(arguments)? {
        all.push(scores(arguments, name, &model)?);
    }
    if let Some(path) = &arguments.csv {
        output::write(path, &csv(&all))?;
        if path.as_os_str() == "-" {
            return Ok(());
        }
    }
    if !arguments.summary {
        for scores in &all {
            output::print(&format!("{}\n", details(scores)))?;
        }
    }
    output::print(&summary(&all))
}

fn models(arguments: &CompareArguments) -> Result<Vec<(String, Model)>, Failure> {
    let given = &arguments.models;
    let names = if given.is_empty() { model::known(&arguments.materials) } else { given.clone() };
    let mut models = Vec::new();
    for name in names {
        let model = model::load(&name, &arguments.materials)?;
        if !given.is_empty() || model.dependence().on_length() {
            models.push((name, model));
        }
    }
    Ok(models)
}

fn scores(arguments: &CompareArguments, name: String, model: &Model) -> Result<Scores, Failure> {
    let own = || TruthName::Stored(Setting::of_model(&name));
    let truth = Truth::load(&arguments.truth.clone().unwrap_or_else(own))?;
    let surface_albedos = match &arguments.surface_albedos[..] {
        [] => truth.surface_albedos(),
        given => given.to_vec(),
    };
    let set = Model::published_set(&name).filter(|set| set.model == *model);
    let fitted = match (&arguments.fitted[..], &set) {
        ([], Some(set)) => set.fitted_surface_albedos,
        (given, _) => given,
    };
    let mut scores = Vec::new();
    for surface_albedo in surface_albedos {
        let profile = profile(&name, model, surface_albedo, &truth)?;
        scores.push(Score {
            surface_albedo,
            is_fitted: fitted.iter().any(|fitted| (fitted - surface_albedo).abs() < 1e-9),
            deviation: Deviation::of(&*profile, truth.table(surface_albedo)?),
            r_max: profile.max_radius(),
            cdf_at_r_max: model.energy_before_normalization(surface_albedo).and_then(Result::ok),
        });
    }
    Ok(Scores { name, truth: truth.name, scores })
}

fn percent(share: f64) -> String {
    format!("{:.3}", 100.0 * share)
}

/// Share of the energy that one of the two profiles has where the other has none.
fn outside(score: &Score) -> f64 {
    score.deviation.data_outside + score.deviation.profile_outside
}

/// One line per surface albedo.
fn details(scores: &Scores) -> String {
    let heads =
        ["A", "", "L1 %", "relative %", "MSE of r·R", "R² of r·R", "r_max", "cdf(r_max)", "outside %"];
    let mut table =
        Table::new(heads.map(|head| (head, if head.is_empty() { Align::Left } else { Align::Right })));
    for score in &scores.scores {
        let Deviation { l1, mean_relative_error, whole, .. } = score.deviation;
        table.row([
            score.surface_albedo.to_string(),
            if score.is_fitted { "fit".into() } else { String::new() },
            percent(l1),
            percent(mean_relative_error),
            format!("{:.2e}", whole.mean),
            format!("{:.5}", whole.r_squared),
            score.r_max.map_or("–".into(), |r| format!("{r:.3}")),
            score.cdf_at_r_max.map_or("–".into(), |cdf| format!("{cdf:.4}")),
            percent(outside(score)),
        ]);
    }
    format!("{}, truth: {}\n{table}", scores.name, scores.truth)
}

/// Means and worst cases, one line per model.
fn summary(all: &[Scores]) -> String {
    let mut table = Table::new([
        ("model", Align::Left),
        ("truth", Align::Left),
        ("L1 %: mean", Align::Right),
        ("worst", Align::Right),
        ("at A", Align::Right),
        ("not fitted: mean", Align::Right),
        ("worst", Align::Right),
        ("relative %: mean", Align::Right),
        ("worst", Align::Right),
        ("at A", Align::Right),
    ]);
    for Scores { name, truth, scores } in all {
        let l1 = Spread::of(scores, |score| score.deviation.l1);
        let relative = Spread::of(scores, |score| score.deviation.mean_relative_error);
        let rest: Vec<Score> = scores.iter().filter(|score| !score.is_fitted).cloned().collect();
        // Where nothing is known to be fitted, the rest says nothing new.
        let rest = match rest.len() {
            0 => ["–".into(), "–".into()],
            count if count == scores.len() => ["–".into(), "–".into()],
            _ => {
                let rest = Spread::of(&rest, |score| score.deviation.l1);
                [percent(rest.mean), percent(rest.worst)]
            }
        };
        let spread = |spread: Spread| [percent(spread.mean), percent(spread.worst), spread.at.to_string()];
        let names = [name.clone(), truth.to_string()];
        table.row(names.into_iter().chain(spread(l1)).chain(rest).chain(spread(relative)));
    }
    table.to_string()
}

/// Mean and worst of a measure over surface albedos; NaN over none.
struct Spread {
    mean: f64,
    worst: f64,
    at: f64,
}

impl Spread {
    fn of(scores: &[Score], measure: impl Fn(&Score) -> f64) -> Spread {
        let mean = scores.iter().map(&measure).sum::<f64>() / scores.len() as f64;
        let worst = scores.iter().max_by(|a, b| measure(a).total_cmp(&measure(b)));
        let (worst, at) = worst.map_or((f64::NAN, f64::NAN), |score| (measure(score), score.surface_albedo));
        Spread { mean, worst, at }
    }
}

/// Every number, unrounded.
fn csv(all: &[Scores]) -> String {
    let mut text = String::from(
        "model,truth,surface_albedo,is_fitted,l1,mean_relative_error,mean_squared_error,r_squared,r_max,\
         cdf_at_r_max,energy_outside,end_radius\n",
    );
    for Scores { name, truth, scores } in all {
        for score in scores {
            let Deviation { l1, mean_relative_error, whole, end_radius, .. } = score.deviation;
            let r_max = score.r_max.map_or(String::new(), |r| r.to_string());
            let cdf = score.cdf_at_r_max.map_or(String::new(), |cdf| cdf.to_string());
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "{name},{truth},{},{},{l1},{mean_relative_error},{},{},{r_max},{cdf},{},{end_radius}",
                score.surface_albedo,
                score.is_fitted,
                whole.mean,
                whole.r_squared,
                outside(score)
            );
        }
    }
    text
}
