//! What a table's author reads when its rows make no data, or the data no model.

use subsurface_profile::{RadialDataError, TabulatedError};

use crate::diagnostics::Diagnostic;
use crate::schema::rounded;
use crate::source::Span;

use super::record::Record;
use super::{Place, Table};

/// Rows that make no data; `places` are those of the rows, of which there is at least one.
pub(super) fn of_data(error: &RadialDataError, surface_albedo: Option<f64>, places: &[Place]) -> Diagnostic {
    let of = surface_albedo.map_or_else(|| "the table".to_owned(), |a| format!("surface albedo {a}"));
    let first = &places[0].row;
    // The row of an error is a row of the table.
    let place = |row: &usize| places.get(*row).unwrap_or(&places[0]);
    match error {
        RadialDataError::TooFewRows { .. } => Diagnostic::error(format!("{of} has one row"))
            .label(first.clone(), "a single row is no profile")
            .help("give at least 2 rows for each surface albedo"),
        RadialDataError::EmptyBin { row, r_lo, r_hi } => {
            Diagnostic::error(format!("the bin from {r_lo} to {r_hi} has no width"))
                .label(place(row).end.clone(), "expected a radius above `r_lo`")
                .secondary(place(row).radius.clone(), "the bin begins here")
                .help("`r_lo` is the inner radius of a ring, `r_hi` the outer one; for points, give `r`")
        }
        RadialDataError::NotSorted { row, radius, previous } => {
            let message = if radius == previous {
                format!("radius {radius} stands twice in {of}")
            } else {
                format!("the radii of {of} are not sorted")
            };
            Diagnostic::error(message)
                .label(place(row).radius.clone(), format!("expected a radius above {previous}"))
                .secondary(place(&row.saturating_sub(1)).radius.clone(), "the row before")
                .help("sort the rows of each surface albedo by radius, and give each radius once")
        }
        RadialDataError::Overlap { row, r_lo, previous } => {
            Diagnostic::error(format!("two bins of {of} overlap"))
                .label(place(row).radius.clone(), format!("begins at {r_lo}, before the bin above ends"))
                .secondary(place(&row.saturating_sub(1)).end.clone(), format!("ends at {previous}"))
                .help("let each bin begin where the one before ends")
        }
        RadialDataError::NoEnergy { .. } => Diagnostic::error(format!("every value of {of} is 0"))
            .label(first.clone(), "the first of them")
            .help("a profile needs light somewhere: remove these rows, or give their values"),
        // What a single number can get wrong is found cell by cell; what is left is the size of the sum.
        other => Diagnostic::error(other.to_string())
            .label(first.clone(), "the first of its rows")
            .help("give radii in mean free paths and R per mean free path squared"),
    }
}

/// A table without a surface albedo that reflects more light than there is.
pub(super) fn more_than_all(energy: f64, header: &Span) -> Diagnostic {
    Diagnostic::error(format!("the table integrates to {}, more than all light", rounded(energy)))
        .label(header.clone(), "there is no `surface_albedo` that would say what to scale it to")
        .help("add the column `surface_albedo`; the integral ∫ R 2πr dr should come near to it")
        .help("give radii in mean free paths and R per mean free path squared")
}

/// A table whose integral is far from its surface albedo: legal, for a profile is normalised.
pub(super) fn unusual_energy(share: f64, surface_albedo: f64, row: &Span) -> Diagnostic {
    Diagnostic::warning(format!(
        "the table of surface albedo {surface_albedo} integrates to {} times that",
        rounded(share)
    ))
    .label(row.clone(), "its first row")
    .help("a profile is normalised, so that only the shape counts; a fit takes the values as they are")
    .help("radii are in mean free paths, R per mean free path squared, and ∫ R 2πr dr is the surface albedo")
}

/// A line that goes on after its end.
pub(super) fn cell_of_several_lines(record: &Record) -> Diagnostic {
    Diagnostic::error("a value spans several lines")
        .label(record.span.clone(), "expected a line of numbers")
        .help("a quotation mark that is not closed takes in all that follows: write numbers without")
}

/// A line with too many or too few cells.
pub(super) fn wrong_number_of_cells(record: &Record, header: &Record) -> Diagnostic {
    let (found, expected) = (record.cells.len(), header.cells.len());
    let diagnostic = Diagnostic::error(format!("the row has {found} values, the header {expected} names"))
        .label(record.span.clone(), format!("expected {expected} values"))
        .secondary(header.span.clone(), "the header");
    if found > expected {
        diagnostic.help("separate values by commas, and write numbers with a decimal point: 0.5, not 0,5")
    } else {
        diagnostic.help("give every column a value; the file may have been cut short")
    }
}

impl Table {
    /// Data that make no model.
    pub(super) fn describe(&self, error: &TabulatedError) -> Diagnostic {
        let place = |surface_albedo: f64, row: usize| {
            let table = self.data.iter().position(|data| data.surface_albedo() == surface_albedo);
            table.and_then(|table| self.places[table].get(row))
        };
        let span = |place: Option<&Place>| place.map_or_else(|| self.header.clone(), |p| p.radius.clone());
        match *error {
            TabulatedError::Gap { surface_albedo, row, from, to } => {
                let mut diagnostic =
                    Diagnostic::error(format!("no bin covers the radii from {from} to {to}"))
                        .label(span(place(surface_albedo, row)), "the bin after the gap");
                if row == 0 {
                    diagnostic = diagnostic.help("let the first bin begin at 0");
                }
                diagnostic.help(
                    "let each bin begin where the one before ends, with a value of 0 where there is no light",
                )
            }
            TabulatedError::TooClose { surface_albedo, row, from, to } => {
                Diagnostic::error(format!("the radii {from} and {to} are too close to each other"))
                    .label(span(place(surface_albedo, row)), "no 32-bit float tells the two apart")
                    .help("the GPU computes in 32-bit floats: leave out one of the two, or merge the bins")
            }
            ref other => Diagnostic::error(other.to_string())
                .label(self.header.clone(), "in this table")
                .help("a kernel carries the table to the GPU: a few hundred radii describe any profile"),
        }
    }
}
