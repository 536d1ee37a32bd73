//! `subsurface profile plot`.

use super::curve::{Curve, Integrated, profile};
use super::fit::FamilyName;
use super::model;
use super::quantity::Quantity;
use super::theory::Theory;
use super::truth::{Setting, Truth, TruthName};
use crate::command::{material_set, number};
use crate::failure::Failure;
use crate::picture::file;
use crate::plot::{Axis, Colour, Dash, Figure, FigureFile, Mark, Panel, Series};
use crate::say;
use clap::Args;
use std::path::PathBuf;
use subsurface_profile::fit::{Options, fit};
use subsurface_profile::{Model, RadialData};

/// Arguments of `profile plot`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  subsurface profile plot --model burley_searchlight --model exponential_dipole_searchlight \\
      --surface-albedo 0.8 --out models.svg
  subsurface profile plot --model liang_2023 --surface-albedo 0.2,0.5,0.8 --quantity reflectance --out liang.png
  subsurface profile plot --theory better-dipole --theory beam-diffusion --fit gaussian-sum:2 \\
      --surface-albedo 0.2,0.5,0.8 --quantity reflectance --out theories.svg
  subsurface profile plot --truth diffuse --surface-albedo 0.1,0.5,0.9 --out truth.svg")]
pub struct PlotArguments {
    /// A model: the stem of a file in DIR/profiles, the name of a built-in profile, or a profile file (.ron). May be
    /// given several times.
    #[arg(long = "model", value_name = "STEM|FILE.ron")]
    pub models: Vec<String>,
    /// A diffusion theory. May be given several times.
    #[arg(long = "theory", value_enum, value_name = "THEORY")]
    pub theories: Vec<Theory>,
    /// A family of models, fitted to the truth of each surface albedo alone. May be given several times.
    #[arg(long = "fit", value_name = "FAMILY")]
    pub fits: Vec<FamilyName>,
    /// Surface albedos A of the truth.
    #[arg(long = "surface-albedo", value_name = "A,A,…", required = true, value_delimiter = ',', value_parser = number::surface_albedo, allow_hyphen_values = true)]
    pub surface_albedos: Vec<f64>,
    /// What is drawn.
    #[arg(long, value_enum, default_value_t)]
    pub quantity: Quantity,
    /// The truth: searchlight, diffuse, searchlight-eta-1.4, diffuse-eta-1.4 or a CSV file; by default that of the
    /// models' own setting.
    #[arg(long, value_name = "NAME|FILE.csv")]
    pub truth: Option<TruthName>,
    /// Largest radius in mean free paths; by default, what holds nearly all of the energy.
    #[arg(long, value_name = "R", value_parser = number::radius_above_0, allow_hyphen_values = true)]
    pub radius_max: Option<f64>,
    /// Spread the radii logarithmically.
    #[arg(long)]
    pub log_radius: bool,
    /// Text above the figure; by default it says what is drawn.
    #[arg(long)]
    pub title: Option<String>,
    /// Directory of materials whose profiles STEM may name.
    #[arg(long, value_name = "DIR", default_value = material_set::DEFAULT_DIRECTORY)]
    pub materials: PathBuf,
    /// The figure: .svg or .png.
    #[arg(long, value_name = "FILE.svg|.png", value_parser = FigureFile::parse)]
    pub out: FigureFile,
}

/// Panels that are readable side by side.
const MOST_PANELS: usize = 4;

/// Something that has a curve at each surface albedo.
enum Kind {
    Model(String, Model),
    Fit(FamilyName),
    Theory(Theory),
}

/// Runs the command.
pub(super) fn run(arguments: &PlotArguments) -> Result<(), Failure> {
    file::folder_of(arguments.out.path())?;
    let figure = figure(arguments)?;
    arguments.out.write(&figure)?;
    say!("{}", arguments.out.path().display());
    Ok(())
}

fn figure(arguments: &PlotArguments) -> Result<Figure, Failure> {
    let truth = Truth::load(&truth_name(arguments)?)?;
    let kinds = kinds(arguments)?;
    let surface_albedos = sorted(&arguments.surface_albedos);
    let tables = surface_albedos.iter().map(|a| truth.table(*a)).collect::<Result<Vec<_>, _>>()?;
    if arguments.quantity == Quantity::Residual && kinds.is_empty() {
        return Err(Failure::new("nothing has a residual", "name a --model, a --theory or a --fit"));
    }
    let draw = |tables: &[&RadialData]| {
        let ends = tables.iter().map(|table| table.quantile(arguments.quantity.quantile()));
        let end = arguments.radius_max.unwrap_or_else(|| round_up(ends.fold(0.0, f64::max)));
        let low = arguments.log_radius.then(|| end / 1000.0);
        let x = arguments.quantity.x_axis(end, low);
        Drawing { quantity: arguments.quantity, truth: &truth, kinds: &kinds, end, x }
    };
    let panels = if kinds.len() > 1 {
        if tables.len() > MOST_PANELS {
            return Err(Failure::new(
                format!("{} surface albedos would make as many panels, side by side", tables.len()),
                format!("give at most {MOST_PANELS}, or a single model, which needs one panel"),
            ));
        }
        let panel = |table: &&RadialData| draw(&[table]).panel_of_one(table, tables.len() > 1);
        tables.iter().map(panel).collect::<Result<_, _>>()?
    } else {
        vec![draw(&tables).panel_of_all(&tables)?]
    };
    let title = arguments.title.clone().unwrap_or_else(|| title(arguments, &truth, &kinds, &surface_albedos));
    Ok(Figure { title, panels })
}

/// The truth to draw, and why there is none.
fn truth_name(arguments: &PlotArguments) -> Result<TruthName, Failure> {
    if let Some(name) = &arguments.truth {
        return Ok(name.clone());
    }
    let mut settings: Vec<Setting> = arguments.models.iter().map(|name| Setting::of_model(name)).collect();
    settings.dedup();
    match settings[..] {
        // Theories are of perpendicular entry.
        [] => Ok(TruthName::Stored(Setting::Searchlight)),
        [only] => Ok(TruthName::Stored(only)),
        _ => Err(Failure::new(
            "the models were made for different settings",
            format!("choose the truth: --truth {}", Setting::ALL.map(Setting::name).join("|")),
        )),
    }
}

fn kinds(arguments: &PlotArguments) -> Result<Vec<Kind>, Failure> {
    let mut kinds = Vec::new();
    for name in &arguments.models {
        kinds.push(Kind::Model(name.clone(), model::load(name, &arguments.materials)?));
    }
    kinds.extend(arguments.fits.iter().map(|family| Kind::Fit(*family)));
    kinds.extend(arguments.theories.iter().map(|theory| Kind::Theory(*theory)));
    Ok(kinds)
}

fn sorted(numbers: &[f64]) -> Vec<f64> {
    let mut sorted = numbers.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.dedup();
    sorted
}

/// The next of 1, 1.5, 2, 3, 4, 5, 6, 8 times a power of ten.
fn round_up(radius: f64) -> f64 {
    let decade = 10f64.powf(radius.log10().floor());
    let steps = [1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
    steps.into_iter().map(|step| step * decade).find(|step| *step >= radius).unwrap_or(radius)
}

fn title(arguments: &PlotArguments, truth: &Truth, kinds: &[Kind], surface_albedos: &[f64]) -> String {
    let mut title = format!("{}, {}", arguments.quantity.title(), truth.describe());
    if let [kind] = kinds {
        title = format!("{title}: {}", kind.label());
    }
    if let [only] = surface_albedos {
        title = format!("{title}, A = {only}");
    }
    title
}

impl Kind {
    fn label(&self) -> String {
        match self {
            Self::Model(name, _) => std::path::Path::new(name)
                .file_stem()
                .map_or_else(|| name.clone(), |stem| stem.to_string_lossy().into_owned()),
            Self::Fit(family) => format!("{}, fitted per albedo", family.label()),
            Self::Theory(theory) => theory.label().into(),
        }
    }

    fn curve(&self, truth: &Truth, table: &RadialData, end: f64) -> Result<Curve, Failure> {
        let surface_albedo = table.surface_albedo();
        Ok(match self {
            Self::Model(name, model) => Curve::Model(profile(name, model, surface_albedo, truth)?),
            Self::Theory(theory) => {
                let reflectance = theory.reflectance(truth, surface_albedo)?;
                Curve::Theory(Integrated::new(reflectance, surface_albedo, end.max(table.end_radius())))
            }
            Self::Fit(family) => {
                let data = std::slice::from_ref(table);
                let fitted = fit(&family.family().start(data), data, &Options::default())
                    .map_err(|error| super::fit::failure(&error, truth))?;
                Curve::Model(profile(&self.label(), &fitted.model, surface_albedo, truth)?)
            }
        })
    }
}

/// What all panels of a figure have in common.
struct Drawing<'a> {
    quantity: Quantity,
    truth: &'a Truth,
    kinds: &'a [Kind],
    end: f64,
    x: Axis,
}

impl Drawing<'_> {
    /// One surface albedo; colours and dashes tell the models apart.
    fn panel_of_one(&self, table: &RadialData, has_title: bool) -> Result<Panel, Failure> {
        let mut series = Vec::new();
        for (index, kind) in self.kinds.iter().enumerate() {
            let curve = kind.curve(self.truth, table, self.end)?;
            series.push(Series {
                label: kind.label(),
                colour: Colour::unordered(index),
                mark: Mark::Line(Dash::nth(index)),
                points: self.quantity.curve(&curve, &self.x, table),
            });
        }
        let title = if has_title { format!("A = {}", table.surface_albedo()) } else { String::new() };
        Ok(self.panel(title, series, &[(table, Colour::BLACK)]))
    }

    /// All surface albedos in one panel, each with its colour.
    fn panel_of_all(&self, tables: &[&RadialData]) -> Result<Panel, Failure> {
        let mut series = Vec::new();
        let mut coloured = Vec::new();
        for (index, table) in tables.iter().enumerate() {
            let colour =
                if tables.len() > 1 { Colour::ordered(index, tables.len()) } else { Colour::unordered(0) };
            let (points, dash) = match self.kinds.first() {
                Some(kind) => {
                    let curve = kind.curve(self.truth, table, self.end)?;
                    (self.quantity.curve(&curve, &self.x, table), Dash::nth(index))
                }
                None => (self.quantity.truth(table, self.end), Dash::nth(index)),
            };
            let label = match (tables.len(), self.kinds.first()) {
                (1, Some(kind)) => kind.label(),
                _ => format!("A = {}", table.surface_albedo()),
            };
            series.push(Series { label, colour, mark: Mark::Line(dash), points });
            coloured.push((*table, if tables.len() > 1 { colour } else { Colour::BLACK }));
        }
        if self.kinds.is_empty() {
            let truth: Vec<_> = series.iter().flat_map(|series| series.points.clone()).collect();
            let y = self.quantity.y_axis(&truth, &truth, self.end);
            return Ok(Panel { title: String::new(), x: self.x.clone(), y, series });
        }
        Ok(self.panel(String::new(), series, &coloured))
    }

    /// A panel of curves with the truth on top.
    fn panel(&self, title: String, curves: Vec<Series>, tables: &[(&RadialData, Colour)]) -> Panel {
        let all = |series: &[Series]| -> Vec<(f64, f64)> {
            let inside = |(x, _): &(f64, f64)| (self.x.low..=self.x.high).contains(x);
            series.iter().flat_map(|series| series.points.iter().copied().filter(inside)).collect()
        };
        let (label, mark, entry_colour) = match self.quantity {
            Quantity::Residual => ("Monte Carlo, ± 1 standard error", Mark::Area, Colour::GREY),
            _ => ("Monte Carlo", Mark::Dots, Colour::BLACK),
        };
        // Of several colours none stands for all: the legend has an entry without points.
        let mut truths = vec![Series { label: label.into(), colour: entry_colour, mark, points: Vec::new() }];
        for (table, colour) in tables {
            let (colour, points) = match self.quantity {
                Quantity::Residual => (Colour::GREY, Quantity::noise(table)),
                _ => (*colour, self.quantity.truth(table, self.end)),
            };
            truths.push(Series { label: String::new(), colour, mark, points });
        }
        let y = self.quantity.y_axis(&all(&truths), &all(&curves), self.end);
        // Areas lie below the curves, dots above.
        let series = match self.quantity {
            Quantity::Residual => truths.into_iter().chain(curves).collect(),
            _ => curves.into_iter().chain(truths).collect(),
        };
        Panel { title, x: self.x.clone(), y, series }
    }
}
