//! Profiles of one half-space at several surface albedos, as CSV.
//!
//! ```text
//! # entry: searchlight
//! # anisotropy: 0
//! # refractive_index: 1
//! # photons: 200015872
//! # seed: 1
//! # command: ...
//! surface_albedo,single_scattering_albedo,r_lo,r_hi,r_reflectance,standard_error,cdf_at_r_hi
//! 0.01,0.0625788,0,0.005,4.85033e-3,3.7e-8,0.0152378
//! ```

use std::fmt::Write;

use crate::{Entry, EstimateError, HalfSpace, HalfSpaceError, RING_EDGES, RadialBin, RadialTable, Run};

const COLUMNS: &str =
    "surface_albedo,single_scattering_albedo,r_lo,r_hi,r_reflectance,standard_error,cdf_at_r_hi";

/// What one half-space does at several surface albedos, and where the numbers come from.
#[derive(Clone, Debug, PartialEq)]
pub struct TruthTable {
    /// The medium.
    pub half_space: HalfSpace,
    /// Photons simulated.
    pub photons: u64,
    /// Seeds of the run, rising: more than one if runs were merged.
    pub seeds: Vec<u64>,
    /// The command that makes this table.
    pub command: String,
    /// One profile per surface albedo, rising.
    pub tables: Vec<RadialTable>,
}

/// Why a text is not a [`TruthTable`]. Lines count from 1.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TruthTableError {
    /// A line `# key: value` is missing or unreadable.
    #[error("the header has no readable line `# {0}: ...`: write the table with this program")]
    Header(&'static str),
    /// The medium cannot be.
    #[error("the medium of the table cannot be: {0}")]
    HalfSpace(#[from] HalfSpaceError),
    /// The line with the names of the columns is missing or different.
    #[error("line {0}: expected the columns `{COLUMNS}`")]
    Columns(usize),
    /// A row that is not seven finite numbers.
    #[error("line {0}: expected seven finite numbers, separated by commas")]
    Row(usize),
    /// A negative or impossible value.
    #[error("line {line}: {what}")]
    Value {
        /// Where.
        line: usize,
        /// What is wrong, and what was expected.
        what: &'static str,
    },
    /// No rows, or a profile of one ring.
    #[error("a profile needs at least two rings: the table has {0} row(s) for one of its surface albedos")]
    TooShort(usize),
}

impl TruthTable {
    /// Where the stored tables have profiles: those that fits are made at, and ones in between.
    pub const SURFACE_ALBEDOS: [f64; 27] = [
        0.01, 0.02, 0.05, 0.08, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5, 0.55, 0.6, 0.65, 0.7, 0.75,
        0.8, 0.84, 0.88, 0.9, 0.93, 0.95, 0.97, 0.98, 0.99,
    ];

    /// What `run` says at `surface_albedos`, which rise. `command` is noted in the header.
    ///
    /// Rings are as in [`RING_EDGES`], but for two things that keep the text small: the finest are joined in pairs, and a
    /// profile ends where less than 5·10⁻⁵ of its energy is left outside.
    ///
    /// # Errors
    ///
    /// A surface albedo outside [0, 1] or not above the one before it; no photons.
    pub fn from_run(run: &Run, surface_albedos: &[f64], command: &str) -> Result<TruthTable, EstimateError> {
        const LEFT_OUTSIDE: f64 = 5e-5;
        const JOINED_UP_TO: f64 = 0.12;
        let mut tables = Vec::new();
        for &surface_albedo in surface_albedos {
            if tables.last().is_some_and(|last: &RadialTable| surface_albedo <= last.surface_albedo) {
                return Err(EstimateError::Order(surface_albedo));
            }
            let single_scattering_albedo = run.single_scattering_albedo(surface_albedo)?;
            let fine = run.radial_profile(single_scattering_albedo)?;
            let last = fine.bins.iter().position(|bin| bin.cdf_at_r_hi > 1.0 - LEFT_OUTSIDE);
            let rings = last.map_or(fine.bins.len(), |last| last + 1);
            let edges: Vec<f64> = RING_EDGES[..=rings]
                .iter()
                .enumerate()
                .filter(|&(index, &edge)| edge > JOINED_UP_TO || index % 2 == 0)
                .map(|(_, &edge)| edge)
                .collect();
            let profile = run.radial_profile_on(single_scattering_albedo, &edges)?;
            tables.push(RadialTable { surface_albedo, ..profile });
        }
        let command = command.lines().collect::<Vec<_>>().join(" ");
        Ok(TruthTable {
            half_space: run.half_space(),
            photons: run.photons(),
            seeds: run.seeds().collect(),
            command,
            tables,
        })
    }

    /// The table as text. Numbers have six digits, errors two: what is left off is far below the standard error of the rings
    /// of all stored tables.
    pub fn to_csv(&self) -> String {
        let entry = match self.half_space.entry() {
            Entry::Searchlight => "searchlight",
            Entry::Diffuse => "diffuse",
        };
        let mut text = String::new();
        let mut header = |key: &str, value: &dyn std::fmt::Display| {
            writeln!(text, "# {key}: {value}").expect("a String takes all text");
        };
        header("entry", &entry);
        header("anisotropy", &self.half_space.anisotropy());
        header("refractive_index", &self.half_space.refractive_index());
        header("photons", &self.photons);
        header("seed", &self.seeds.iter().map(u64::to_string).collect::<Vec<_>>().join(", "));
        header("command", &self.command);
        text.push_str(COLUMNS);
        text.push('\n');
        for table in &self.tables {
            // 1 - α needs digits near α = 1, so α has nine.
            let albedos = format!(
                "{},{}",
                short(&format!("{:.8}", table.surface_albedo)),
                short(&format!("{:.9}", table.single_scattering_albedo))
            );
            for bin in &table.bins {
                writeln!(
                    text,
                    "{albedos},{},{},{:.5e},{:.1e},{}",
                    bin.r_lo,
                    bin.r_hi,
                    bin.r_reflectance,
                    bin.standard_error,
                    short(&format!("{:.6}", bin.cdf_at_r_hi))
                )
                .expect("a String takes all text");
            }
        }
        text
    }

    /// Reads what [`to_csv`](TruthTable::to_csv) wrote.
    ///
    /// # Errors
    ///
    /// A missing header; rows that are not seven finite numbers, not sorted by surface albedo and radius, with gaps between
    /// rings, negative, or fewer than two per surface albedo.
    pub fn from_csv(text: &str) -> Result<TruthTable, TruthTableError> {
        let entry = match header(text, "entry")? {
            "searchlight" => Entry::Searchlight,
            "diffuse" => Entry::Diffuse,
            _ => return Err(TruthTableError::Header("entry")),
        };
        let half_space =
            HalfSpace::new(entry, number(text, "anisotropy")?, number(text, "refractive_index")?)?;
        let photons = number(text, "photons")?;
        let seeds = header(text, "seed")?
            .split(',')
            .map(|seed| seed.trim().parse().map_err(|_| TruthTableError::Header("seed")))
            .collect::<Result<_, _>>()?;
        let command = header(text, "command")?.to_owned();
        let mut lines = text
            .lines()
            .enumerate()
            .map(|(index, line)| (index + 1, line.trim()))
            .filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
        match lines.next() {
            Some((_, COLUMNS)) => {}
            Some((line, _)) => return Err(TruthTableError::Columns(line)),
            None => return Err(TruthTableError::TooShort(0)),
        }
        let mut tables: Vec<RadialTable> = Vec::new();
        for (line, row) in lines {
            push_row(&mut tables, line, row)?;
        }
        let shortest = tables.iter().map(|table| table.bins.len()).min().unwrap_or(0);
        if shortest < 2 {
            return Err(TruthTableError::TooShort(shortest));
        }
        Ok(TruthTable { half_space, photons, seeds, command, tables })
    }
}

/// Without the zeros at the end of a decimal fraction.
fn short(number: &str) -> &str {
    number.trim_end_matches('0').trim_end_matches('.')
}

fn header<'text>(text: &'text str, key: &'static str) -> Result<&'text str, TruthTableError> {
    text.lines()
        .filter_map(|line| line.strip_prefix('#')?.trim_start().strip_prefix(key)?.strip_prefix(':'))
        .map(str::trim)
        .next()
        .ok_or(TruthTableError::Header(key))
}

fn number<T: std::str::FromStr>(text: &str, key: &'static str) -> Result<T, TruthTableError> {
    header(text, key)?.parse().map_err(|_| TruthTableError::Header(key))
}

fn push_row(tables: &mut Vec<RadialTable>, line: usize, row: &str) -> Result<(), TruthTableError> {
    let mut values = [0.0; 7];
    let mut fields = row.split(',');
    for value in &mut values {
        let parsed = fields.next().and_then(|field| field.trim().parse::<f64>().ok());
        *value = parsed.filter(|value| value.is_finite()).ok_or(TruthTableError::Row(line))?;
    }
    if fields.next().is_some() {
        return Err(TruthTableError::Row(line));
    }
    let [surface_albedo, single_scattering_albedo, r_lo, r_hi, r_reflectance, standard_error, cdf_at_r_hi] =
        values;
    let require = |holds: bool, what| if holds { Ok(()) } else { Err(TruthTableError::Value { line, what }) };
    require(
        (0.0..=1.0).contains(&surface_albedo) && (0.0..=1.0).contains(&single_scattering_albedo),
        "albedos must be in [0, 1]",
    )?;
    require(
        r_reflectance >= 0.0 && standard_error >= 0.0,
        "r_reflectance and its error must not be negative",
    )?;
    // Six digits of a fraction that is 1 may round up.
    require((0.0..=1.000_001).contains(&cdf_at_r_hi), "cdf_at_r_hi must be in [0, 1]")?;
    require(r_lo >= 0.0 && r_hi > r_lo, "a ring must have 0 <= r_lo < r_hi")?;
    let bin = RadialBin { r_lo, r_hi, r_reflectance, standard_error, cdf_at_r_hi };
    match tables.last_mut() {
        Some(table) if table.surface_albedo == surface_albedo => {
            require(
                table.single_scattering_albedo == single_scattering_albedo,
                "one surface albedo must have one single-scattering albedo",
            )?;
            let last = table.bins.last().map_or((0.0, 0.0), |bin| (bin.r_hi, bin.cdf_at_r_hi));
            require(r_lo == last.0, "rings must follow each other without a gap, from the axis outwards")?;
            require(cdf_at_r_hi >= last.1, "cdf_at_r_hi must not fall")?;
            table.bins.push(bin);
        }
        last => {
            require(
                last.is_none_or(|table| table.surface_albedo < surface_albedo),
                "surface albedos must rise, with the rows of one kept together",
            )?;
            require(r_lo == 0.0, "rings must follow each other without a gap, from the axis outwards")?;
            tables.push(RadialTable { single_scattering_albedo, surface_albedo, bins: vec![bin] });
        }
    }
    Ok(())
}
