//! `subsurface profile fit`.

use super::model;
use super::truth::{Truth, TruthName};
use crate::command::{material_set, number, output};
use crate::failure::Failure;
use crate::table::{Align, Table};
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use std::str::FromStr;
use subsurface_codegen::profile_file_text;
use subsurface_profile::RadialData;
use subsurface_profile::fit::{Criterion, Crop, Family, Fit, FitError, Measure, Options, Weighting, fit};

/// Arguments of `profile fit`.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  subsurface profile fit --data my_measurement.csv --family burley
  subsurface profile fit --data searchlight --family exponential-dipole --out materials/profiles/mine.ron
  subsurface profile fit --data searchlight --family polynomial --criterion r-reflectance --weighting row --crop
  subsurface profile fit --data my_measurement.csv --family gaussian-sum:4 --surface-albedo 0.8")]
pub struct FitArguments {
    /// The data: a CSV file, or a stored truth (searchlight, diffuse, searchlight-eta-1.4, diffuse-eta-1.4).
    #[arg(long, value_name = "FILE.csv|NAME")]
    pub data: TruthName,
    /// The family of models.
    #[arg(long, value_name = "FAMILY", help = format!("The family of models: {}", FamilyName::forms()))]
    pub family: FamilyName,
    #[command(flatten)]
    pub how: HowToFit,
    /// Fit to these surface albedos of the data alone.
    #[arg(long = "surface-albedo", value_name = "A,A,…", value_delimiter = ',', value_parser = number::surface_albedo, allow_hyphen_values = true)]
    pub surface_albedos: Vec<f64>,
    /// The model to start from, of the same family: a stem, a built-in profile, or a profile file (.ron); by default
    /// the family's published coefficients.
    #[arg(long, value_name = "STEM|FILE.ron")]
    pub start: Option<String>,
    /// Directory of materials whose profiles STEM may name.
    #[arg(long, value_name = "DIR", default_value = material_set::DEFAULT_DIRECTORY)]
    pub materials: PathBuf,
    /// Write the profile file here and print the errors; otherwise the profile file is printed, with the errors as
    /// its comments.
    #[arg(long, value_name = "FILE.ron")]
    pub out: Option<PathBuf>,
}

/// What a fit makes small, and of which rows.
#[derive(Clone, Copy, Debug, Args)]
pub struct HowToFit {
    /// What is made small.
    #[arg(long, value_enum, default_value_t)]
    pub criterion: CriterionName,
    /// How much each row counts.
    #[arg(long, value_enum, default_value_t)]
    pub weighting: WeightingName,
    /// Leave out the rows from the first radius on where r·R falls to this fraction of its first value: the cropping
    /// rule of Liang et al. 2023, eq. (6), whose fraction is 0.005.
    #[arg(long, value_name = "FRACTION", num_args = 0..=1, require_equals = true, default_missing_value = "0.005", value_parser = number::fraction)]
    pub crop: Option<f64>,
    /// Leave out the rows that reach beyond this radius, in mean free paths.
    #[arg(long, value_name = "R", value_parser = number::radius_above_0, allow_hyphen_values = true)]
    pub radius_max: Option<f64>,
}

/// What a fit makes small.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum CriterionName {
    /// Squares of the difference of 2πr·R/A, the density of the exit radius.
    #[default]
    RadialPdf,
    /// Squares of the difference of r·R.
    RReflectance,
    /// Squares of the difference of the cumulative distribution.
    Cdf,
    /// Squares of the relative difference.
    RelativeError,
    /// Squares of the difference of logarithms: too much counts as much as too little.
    Logarithm,
}

/// How much each row counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum WeightingName {
    /// As much as its range of radii is wide.
    #[default]
    Radius,
    /// All the same.
    Row,
    /// By the inverse of its standard error.
    StandardError,
}

impl HowToFit {
    /// As the library has it.
    pub(super) fn options(self) -> Options {
        let criterion = match self.criterion {
            CriterionName::RadialPdf => Criterion::LeastSquares(Measure::RadialDensity),
            CriterionName::RReflectance => Criterion::LeastSquares(Measure::RReflectance),
            CriterionName::Cdf => Criterion::LeastSquares(Measure::Cdf),
            CriterionName::RelativeError => Criterion::RelativeError,
            CriterionName::Logarithm => Criterion::Logarithm,
        };
        let weighting = match self.weighting {
            WeightingName::Radius => Weighting::Radius,
            WeightingName::Row => Weighting::Row,
            WeightingName::StandardError => Weighting::StandardError,
        };
        let crop = self.crop.map(|threshold| Crop { threshold });
        Options { criterion, weighting, crop, ..Options::default() }
    }
}

/// A family of models as the command line names it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FamilyName(Family);

impl FamilyName {
    /// The family.
    pub(super) fn family(self) -> Family {
        self.0
    }

    /// Its name in a legend.
    pub(super) fn label(self) -> String {
        self.0.label()
    }

    /// What it may be, in words.
    pub(super) fn forms() -> String {
        let forms = Family::all().map(|family| {
            let name = family.name().replace('_', "-");
            if family.has_terms() { format!("{name} or {name}:N (of N terms)") } else { name }
        });
        forms.collect::<Vec<_>>().join(", ")
    }
}

impl FromStr for FamilyName {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        /// More terms than any table tells apart.
        const MOST_TERMS: usize = 16;
        let (name, terms) = text.split_once(':').map_or((text, None), |(name, terms)| (name, Some(terms)));
        // Stems are written with underscores, and so may families be.
        let family = Family::from_name(&name.replace('-', "_"));
        let family = family.ok_or_else(|| format!("the families are {}", Self::forms()))?;
        let Some(terms) = terms else { return Ok(Self(family)) };
        if !family.has_terms() {
            return Err(format!("`{name}` has no number of terms to choose"));
        }
        let terms = terms.parse().ok().filter(|terms| (1..=MOST_TERMS).contains(terms));
        let family = terms.and_then(|terms| family.with_terms(terms));
        family.map(Self).ok_or(format!("`{name}` has 1 to {MOST_TERMS} terms"))
    }
}

/// Runs the command.
pub(super) fn run(arguments: &FitArguments) -> Result<(), Failure> {
    if let Some(path) = &arguments.out {
        output::check(path)?;
    }
    let truth = Truth::load(&arguments.data)?;
    let data = chosen(&truth, &arguments.surface_albedos, arguments.how)?;
    let start = start(arguments, &data)?;
    let fitted = fit(&start, &data, &arguments.how.options()).map_err(|error| failure(&error, &truth))?;
    let errors = errors(&fitted);
    let mut docs = vec![format!("Fitted to {}: {}.", truth.describe(), fitted.stop), String::new()];
    docs.extend(errors.lines().map(|line| format!("    {line}")));
    let text = profile_file_text(&fitted.model, &docs).ok_or_else(|| {
        Failure::new(
            format!("a {} is not written as coefficients", fitted.model.description().caption),
            "choose another family",
        )
    })?;
    match &arguments.out {
        Some(path) => {
            output::write(path, &text)?;
            output::print(&format!("{errors}{}\n{}\n", fitted.stop, path.display()))
        }
        None => output::print(&text),
    }
}

/// The tables to fit to: those of the surface albedos given (all for none), without what lies too far out.
pub(super) fn chosen(
    truth: &Truth,
    surface_albedos: &[f64],
    how: HowToFit,
) -> Result<Vec<RadialData>, Failure> {
    let tables: Vec<RadialData> = match surface_albedos {
        [] => truth.tables.clone(),
        some => some.iter().map(|a| truth.table(*a).cloned()).collect::<Result<_, _>>()?,
    };
    let Some(radius_max) = how.radius_max else { return Ok(tables) };
    let near = |table: RadialData| {
        let rows = table.rows().iter().copied().filter(|row| row.r_hi <= radius_max).collect();
        RadialData::new(table.surface_albedo(), rows).map_err(|error| {
            Failure::new(
                format!("within the radius {radius_max} there is too little to fit to: {error}"),
                "give a larger --radius-max",
            )
        })
    };
    tables.into_iter().map(near).collect()
}

fn start(arguments: &FitArguments, data: &[RadialData]) -> Result<subsurface_profile::Model, Failure> {
    let usual = arguments.family.family().start(data);
    let Some(name) = &arguments.start else { return Ok(usual) };
    let model = model::load(name, &arguments.materials)?;
    if model.kind() == usual.kind() {
        return Ok(model);
    }
    Err(Failure::new(
        format!("the start `{name}` is not of the family `{}`", arguments.family.label()),
        "choose the family of the start, or another start",
    ))
}

/// One line per surface albedo.
fn errors(fitted: &Fit) -> String {
    let is_cropped = fitted.tables.iter().any(|table| table.cropped_at.is_some());
    let mut heads = vec![("A", Align::Right), ("L1 %", Align::Right), ("rows", Align::Right)];
    heads.extend(is_cropped.then_some(("cropped at", Align::Right)));
    let mut table = Table::new(heads);
    for fitted in &fitted.tables {
        let mut row = vec![
            fitted.surface_albedo.to_string(),
            format!("{:.3}", 100.0 * fitted.l1),
            fitted.rows.to_string(),
        ];
        row.extend(fitted.cropped_at.map(|radius| format!("{radius:.2}")));
        table.row(row);
    }
    let mean = fitted.tables.iter().map(|table| table.l1).sum::<f64>() / fitted.tables.len() as f64;
    format!("{table}mean L1 {:.3} %\n", 100.0 * mean)
}

/// The library's errors say their remedy after a colon or a semicolon.
pub(super) fn failure(error: &FitError, truth: &Truth) -> Failure {
    let text = error.to_string();
    let (message, help) = text
        .rsplit_once("; ")
        .or_else(|| text.rsplit_once(": "))
        .unwrap_or((&text, "correct the data or the start"));
    Failure::new(format!("cannot fit to {}: {message}", truth.describe()), help)
}
