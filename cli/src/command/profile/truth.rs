//! The truth that models are judged by: stored tables, or a file.

use crate::command::material_set;
use crate::failure::Failure;
use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use subsurface_codegen::load_radial_table;
use subsurface_profile::single_scattering_albedo::{Entry, from_surface_albedo};
use subsurface_profile::{RadialData, RadialRow};
use subsurface_reference::{RadialTable, TruthTable, truth};

/// A stored table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Setting {
    /// Perpendicular entry, index-matched.
    Searchlight,
    /// Diffuse entry, index-matched.
    Diffuse,
    /// Perpendicular entry, refractive index 1.4.
    SearchlightEta14,
    /// Diffuse entry, refractive index 1.4.
    DiffuseEta14,
}

impl Setting {
    /// All stored tables.
    pub(super) const ALL: [Setting; 4] =
        [Self::Searchlight, Self::Diffuse, Self::SearchlightEta14, Self::DiffuseEta14];

    /// The setting that a profile of this name was made for.
    ///
    /// Stems end in the setting: `…_searchlight`, `…_diffuse`, and `…_eta_1_4` after it. The others (`burley_dmfp`,
    /// `liang_2023`) were published for perpendicular entry.
    pub(super) fn of_model(name: &str) -> Setting {
        let stem = std::path::Path::new(name).file_stem().map_or(name.into(), |stem| stem.to_string_lossy());
        match (stem.contains("diffuse"), stem.contains("eta_1_4")) {
            (false, false) => Self::Searchlight,
            (true, false) => Self::Diffuse,
            (false, true) => Self::SearchlightEta14,
            (true, true) => Self::DiffuseEta14,
        }
    }

    /// Its name on the command line.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Searchlight => "searchlight",
            Self::Diffuse => "diffuse",
            Self::SearchlightEta14 => "searchlight-eta-1.4",
            Self::DiffuseEta14 => "diffuse-eta-1.4",
        }
    }

    fn stored(self) -> &'static TruthTable {
        match self {
            Self::Searchlight => truth::searchlight(),
            Self::Diffuse => truth::diffuse(),
            Self::SearchlightEta14 => truth::searchlight_eta_1_4(),
            Self::DiffuseEta14 => truth::diffuse_eta_1_4(),
        }
    }
}

/// What `--truth` names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TruthName {
    /// A stored table.
    Stored(Setting),
    /// A CSV file.
    File(PathBuf),
}

impl FromStr for TruthName {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if let Some(setting) = Setting::ALL.into_iter().find(|setting| setting.name() == text) {
            return Ok(Self::Stored(setting));
        }
        let path = PathBuf::from(text);
        if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("csv")) {
            return Ok(Self::File(path));
        }
        let names = Setting::ALL.map(Setting::name).join(", ");
        Err(format!("the stored tables are {names}; a file must end in .csv"))
    }
}

impl fmt::Display for TruthName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stored(setting) => f.write_str(setting.name()),
            Self::File(path) => write!(f, "{}", path.display()),
        }
    }
}

/// Tables of one setting, by surface albedo.
#[derive(Clone, Debug)]
pub(super) struct Truth {
    pub(super) name: TruthName,
    pub(super) tables: Vec<RadialData>,
}

impl Truth {
    /// Reads the tables.
    pub(super) fn load(name: &TruthName) -> Result<Truth, Failure> {
        let tables = match name {
            TruthName::Stored(setting) => {
                let tables = setting.stored().tables.iter().map(radial_data);
                tables.collect::<Result<_, _>>().map_err(|error| {
                    Failure::new(
                        format!("the stored truth {name} is damaged: {error}"),
                        "build the program again from an unchanged copy",
                    )
                })?
            }
            TruthName::File(path) => read(path)?,
        };
        Ok(Truth { name: name.clone(), tables })
    }

    /// The table of a surface albedo.
    pub(super) fn table(&self, surface_albedo: f64) -> Result<&RadialData, Failure> {
        let found = self.tables.iter().find(|table| (table.surface_albedo() - surface_albedo).abs() < 1e-9);
        found.ok_or_else(|| {
            Failure::new(
                format!("the truth {} has no surface albedo {surface_albedo}", self.name),
                format!("it has {}", list(&self.surface_albedos())),
            )
        })
    }

    /// All surface albedos of the truth.
    pub(super) fn surface_albedos(&self) -> Vec<f64> {
        self.tables.iter().map(RadialData::surface_albedo).collect()
    }

    /// The refractive index of the medium, where that is known.
    pub(super) fn refractive_index(&self) -> f64 {
        match &self.name {
            TruthName::Stored(setting) => setting.stored().half_space.refractive_index(),
            TruthName::File(_) => 1.0,
        }
    }

    /// α of the medium that has a surface albedo: the stored one, or that of perpendicular entry.
    pub(super) fn medium_at(&self, surface_albedo: f64) -> f64 {
        let stored = match &self.name {
            TruthName::Stored(setting) => &setting.stored().tables[..],
            TruthName::File(_) => &[],
        };
        let table = stored.iter().find(|table| (table.surface_albedo - surface_albedo).abs() < 1e-9);
        let fallback = || from_surface_albedo(Entry::Searchlight, surface_albedo);
        table.map_or_else(fallback, |table| table.single_scattering_albedo)
    }

    /// What the tables are, in a few words.
    pub(super) fn describe(&self) -> String {
        match &self.name {
            TruthName::File(path) => path.display().to_string(),
            TruthName::Stored(setting) => match setting {
                Setting::Searchlight => "searchlight entry".into(),
                Setting::Diffuse => "diffuse entry".into(),
                Setting::SearchlightEta14 => "searchlight entry, refractive index 1.4".into(),
                Setting::DiffuseEta14 => "diffuse entry, refractive index 1.4".into(),
            },
        }
    }
}

fn radial_data(table: &RadialTable) -> Result<RadialData, subsurface_profile::RadialDataError> {
    let row = |bin: &subsurface_reference::RadialBin| RadialRow {
        r_lo: bin.r_lo,
        r_hi: bin.r_hi,
        r_reflectance: bin.r_reflectance,
        standard_error: Some(bin.standard_error),
    };
    RadialData::new(table.surface_albedo, table.bins.iter().map(row).collect())
}

/// The tables of a CSV file, in the form that profile files read too.
fn read(path: &Path) -> Result<Vec<RadialData>, Failure> {
    let loaded = load_radial_table(path);
    match loaded.data {
        Some(data) if !loaded.report.has_errors() => {
            material_set::print_warnings(&loaded.report);
            Ok(data)
        }
        _ => Err(material_set::failure(&loaded.report)),
    }
}

/// Numbers as a list.
fn list(numbers: &[f64]) -> String {
    numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(", ")
}
