//! Tables of radial data: CSV in, checked data out, every error with its line and column.
//!
//! A header names the columns, in any order; what is not known is ignored. Lines that begin with `#` are comments.
//! `surface_albedo` may be left out if the table is of one; radii, in mean free paths, are `r` (points) or `r_lo` and
//! `r_hi` (bins); the value is `reflectance` R per mean free path squared, `r_reflectance` r·R, or
//! `radial_reflectance` 2πr·R; `standard_error` is that of the value, and optional.

mod columns;
mod error_text;
mod record;

use std::collections::BTreeMap;
use std::f64::consts::PI;

use subsurface_profile::{RadialData, RadialRow, TabulatedModel};

use crate::diagnostics::Diagnostic;
use crate::schema::Decoder;
use crate::source::{FileId, Span};
use crate::suggestion::shortened;

use columns::{Columns, Measure, Radii};
use record::{Cell, Record, records};

/// Largest table that is read, in bytes.
pub const LARGEST_TABLE: u64 = 16 * 1024 * 1024;

/// Share of its surface albedo that a table holds without a warning: less than the first is a table in other units
/// or cut short, more than the second is more light than the surface reflects.
const USUAL_ENERGY: [f64; 2] = [0.5, 1.05];

/// A table by surface albedo.
#[derive(Debug)]
pub(crate) struct Table {
    /// In the order of first appearance.
    pub(crate) data: Vec<RadialData>,
    /// Where the rows of each are written.
    places: Vec<Vec<Place>>,
    pub(crate) header: Span,
}

/// Where a row is written.
#[derive(Clone, Debug)]
struct Place {
    row: Span,
    /// The radius, or where the bin begins.
    radius: Span,
    /// The radius, or where the bin ends.
    end: Span,
}

impl Table {
    /// Reads `text`; `None` when it is no table, which is reported.
    pub(crate) fn parse(decoder: &mut Decoder, file: FileId, text: &str) -> Option<Table> {
        if let Some(offset) = text.find('\0') {
            decoder.report(
                Diagnostic::error("the file is no text")
                    .label(Span::new(file, offset..offset + 1), "a zero byte, which no CSV file has")
                    .help("give a CSV file: a header and rows of numbers, separated by commas"),
            );
            return None;
        }
        let records = records(file, text);
        let Some((header, rows)) = records.split_first() else {
            decoder.report(
                Diagnostic::error("the table is empty")
                    .label(Span::new(file, text.len()..text.len()), "expected a header")
                    .help(columns::EXAMPLE),
            );
            return None;
        };
        let columns = Columns::of(decoder, header)?;
        let mut groups = Groups::default();
        let mut is_good = true;
        for record in rows {
            match row(decoder, &columns, header, record) {
                Some((surface_albedo, row, place)) => groups.add(surface_albedo, row, place),
                None => is_good = false,
            }
        }
        if rows.is_empty() {
            decoder.report(
                Diagnostic::error("the table has no rows")
                    .label(header.span.clone(), "nothing follows the header")
                    .help("give at least 2 rows for each surface albedo"),
            );
            return None;
        }
        if !is_good {
            return None;
        }
        groups.finish(decoder, header.span.clone())
    }

    /// The model that the table gives; `None` when it gives none, which is reported.
    pub(crate) fn model(&self, decoder: &mut Decoder) -> Option<TabulatedModel> {
        match TabulatedModel::new(&self.data) {
            Ok(model) => Some(model),
            Err(error) => {
                decoder.report(self.describe(&error));
                None
            }
        }
    }
}

/// Rows by surface albedo, in the order of first appearance.
#[derive(Default)]
struct Groups {
    /// `None` where the table does not say.
    surface_albedos: Vec<Option<f64>>,
    rows: Vec<(Vec<RadialRow>, Vec<Place>)>,
    by_bits: BTreeMap<u64, usize>,
}

impl Groups {
    fn add(&mut self, surface_albedo: Option<f64>, row: RadialRow, place: Place) {
        let key = surface_albedo.unwrap_or(0.0).to_bits();
        let group = *self.by_bits.entry(key).or_insert(self.rows.len());
        if group == self.rows.len() {
            self.surface_albedos.push(surface_albedo);
            self.rows.push(Default::default());
        }
        self.rows[group].0.push(row);
        self.rows[group].1.push(place);
    }

    fn finish(self, decoder: &mut Decoder, header: Span) -> Option<Table> {
        let mut table = Table { data: Vec::new(), places: Vec::new(), header };
        let mut is_good = true;
        for (surface_albedo, (rows, places)) in self.surface_albedos.into_iter().zip(self.rows) {
            match data(decoder, surface_albedo, rows, &places, &table.header) {
                Some(data) => {
                    table.data.push(data);
                    table.places.push(places);
                }
                None => is_good = false,
            }
        }
        is_good.then_some(table)
    }
}

/// The data of one surface albedo, checked.
fn data(
    decoder: &mut Decoder,
    surface_albedo: Option<f64>,
    rows: Vec<RadialRow>,
    places: &[Place],
    header: &Span,
) -> Option<RadialData> {
    // Without a surface albedo the rows are first read as those of 1, which scales nothing.
    let data = match RadialData::new(surface_albedo.unwrap_or(1.0), rows) {
        Ok(data) => data,
        Err(error) => {
            decoder.report(error_text::of_data(&error, surface_albedo, places));
            return None;
        }
    };
    let energy = energy(&data);
    let Some(surface_albedo) = surface_albedo else {
        // Roundings of many rows.
        if energy > 1.0 + 1e-6 {
            decoder.report(error_text::more_than_all(energy, header));
            return None;
        }
        return RadialData::new(energy.min(1.0), data.rows().to_vec()).ok();
    };
    let share = energy / surface_albedo;
    if !(USUAL_ENERGY[0]..=USUAL_ENERGY[1]).contains(&share) {
        decoder.report(error_text::unusual_energy(share, surface_albedo, &places[0].row));
    }
    Some(data)
}

/// The fraction of the entered energy that the profile of these data holds, what it adds before a first point at r > 0
/// included.
fn energy(data: &RadialData) -> f64 {
    match TabulatedModel::new(std::slice::from_ref(data)) {
        Ok(model) => model.energy_before_normalization(data.surface_albedo()) * data.surface_albedo(),
        // Reported where the profile is made, which a fit does not need.
        Err(_) => data.energy(),
    }
}

/// One row: its surface albedo, its values, its place.
fn row(
    decoder: &mut Decoder,
    columns: &Columns,
    header: &Record,
    record: &Record,
) -> Option<(Option<f64>, RadialRow, Place)> {
    if record.cells.iter().any(|cell| cell.text.contains('\n')) {
        decoder.report(error_text::cell_of_several_lines(record));
        return None;
    }
    if record.cells.len() != header.cells.len() {
        decoder.report(error_text::wrong_number_of_cells(record, header));
        return None;
    }
    let cell = |column: usize| &record.cells[column];
    // All are read before the first failure counts, so that each is reported.
    let surface_albedo = columns.surface_albedo.map(|column| surface_albedo(decoder, cell(column)));
    let (lo, hi) = match columns.radii {
        Radii::Points(r) => (r, r),
        Radii::Bins(r_lo, r_hi) => (r_lo, r_hi),
    };
    let r_lo = radius(decoder, cell(lo));
    let r_hi = if lo == hi { r_lo } else { radius(decoder, cell(hi)) };
    let value = not_negative(decoder, cell(columns.value), columns.measure.name(), columns.measure.meaning());
    let standard_error = columns.standard_error.filter(|column| !cell(*column).text.is_empty());
    let standard_error = standard_error.map(|column| {
        let help = "give the standard deviation of the value, 0 or more, or leave the cell empty";
        not_negative(decoder, cell(column), "standard_error", help)
    });
    let (r_lo, r_hi, value) = (r_lo?, r_hi?, value?);
    let surface_albedo = surface_albedo.map_or(Some(None), |known| known.map(Some))?;
    let standard_error = standard_error.map_or(Some(None), |known| known.map(Some))?;
    let factor = match columns.measure {
        // R as the mean over the ring: ∫ R r dr = R (r_hi² - r_lo²)/2.
        Measure::Reflectance => 0.5 * (r_lo + r_hi),
        Measure::RReflectance => 1.0,
        Measure::RadialReflectance => 0.5 / PI,
    };
    let row = RadialRow {
        r_lo,
        r_hi,
        r_reflectance: factor * value,
        standard_error: standard_error.map(|error| factor * error),
    };
    let place = Place { row: record.span.clone(), radius: cell(lo).span.clone(), end: cell(hi).span.clone() };
    Some((surface_albedo, row, place))
}

/// A number; `name` is that of the column.
fn number(decoder: &mut Decoder, cell: &Cell, name: &str, help: &str) -> Option<f64> {
    let refused = |message: String, label: &str| {
        Diagnostic::error(message).label(cell.span.clone(), label).help(help.to_owned())
    };
    let shown = shortened(&cell.text);
    let error = match cell.text.parse::<f64>() {
        Ok(value) if value.is_finite() => return Some(value),
        Ok(value) if value.is_nan() => {
            refused(format!("{name} is not a number"), "expected a number, found NaN")
        }
        Ok(_) => refused(format!("{name} `{shown}` is infinite"), "expected a finite number"),
        Err(_) if cell.text.is_empty() => refused(format!("{name} is missing"), "expected a number"),
        Err(_) => {
            refused(format!("{name} `{shown}` is not a number"), "expected a number, such as 0.25 or 1e-3")
        }
    };
    decoder.report(error);
    None
}

fn not_negative(decoder: &mut Decoder, cell: &Cell, name: &str, help: &str) -> Option<f64> {
    let value = number(decoder, cell, name, help)?;
    if value < 0.0 {
        decoder.report(
            Diagnostic::error(format!("{name} is {}", shortened(&cell.text)))
                .label(cell.span.clone(), "expected 0 or more")
                .help(help.to_owned()),
        );
        return None;
    }
    // The sum turns -0.0 into 0.0.
    Some(value + 0.0)
}

fn radius(decoder: &mut Decoder, cell: &Cell) -> Option<f64> {
    /// Beyond these, in mean free paths, a 32-bit float runs out once a length in mm scales them.
    const RANGE: [f64; 2] = [1e-12, 1e12];
    const HELP: &str = "give the radius in mean free paths, 0 or more";
    let value = not_negative(decoder, cell, "radius", HELP)?;
    if value != 0.0 && !(RANGE[0]..=RANGE[1]).contains(&value) {
        decoder.report(
            Diagnostic::error(format!("radius {} is out of range", shortened(&cell.text)))
                .label(cell.span.clone(), "expected 0, or a number from 1e-12 to 1e12")
                .help(HELP),
        );
        return None;
    }
    Some(value)
}

fn surface_albedo(decoder: &mut Decoder, cell: &Cell) -> Option<f64> {
    const HELP: &str = "give the share of the light that the surface reflects in all: above 0 (black has no profile), at most 1";
    let value = number(decoder, cell, "surface_albedo", HELP)?;
    if !(value > 0.0 && value <= 1.0) {
        decoder.report(
            Diagnostic::error(format!("surface_albedo is {}", shortened(&cell.text)))
                .label(cell.span.clone(), "expected a number above 0, at most 1")
                .help(HELP),
        );
        return None;
    }
    Some(value)
}
