//! Tables beside the files that name them.

use std::path::{Path, PathBuf};

use subsurface_profile::{RadialData, TabulatedModel};

use crate::diagnostics::Diagnostic;
use crate::report::Report;
use crate::schema::{Decoder, Tables};
use crate::source::{Span, Spanned};
use crate::table::Table;

use super::reader::Reader;

/// What came of reading a table of radial data.
#[derive(Debug, Default)]
pub struct LoadedTable {
    /// The data, by surface albedo in the order of the file; `None` when there are errors.
    pub data: Option<Vec<RadialData>>,
    /// Errors and warnings, with the text they point into.
    pub report: Report,
    /// The file, if it could be named.
    pub files_read: Vec<PathBuf>,
}

/// Reads a table of radial data, as `Tabulated(file: "…")` does: a CSV file with a header.
///
/// The columns, in any order: `surface_albedo` (may be missing if there is one: the table's integral is then taken
/// for it); `r`, or `r_lo` and `r_hi`, in mean free paths; `reflectance` (R per mean free path squared),
/// `r_reflectance` (r·R) or `radial_reflectance` (2πr·R); optionally `standard_error`, of that value. Others are
/// ignored, as are lines that begin with `#`. A value of `reflectance` in a bin is the mean over the ring's area,
/// one of the others the mean over its radii.
#[must_use]
pub fn load_radial_table(path: &Path) -> LoadedTable {
    let mut reader = Reader::disk();
    let data = read(&mut reader, path).filter(|_| !reader.report.has_errors()).map(|table| table.data);
    let (report, files_read, _) = reader.finish();
    LoadedTable { data, report, files_read }
}

/// Reports on a table, and on whether it is a profile.
pub(super) fn check(reader: &mut Reader, path: &Path) {
    let Some(table) = read(reader, path) else { return };
    let mut decoder = Decoder::default();
    // Only what is reported counts.
    let _ = table.model(&mut decoder);
    for diagnostic in decoder.finish(&table.header) {
        reader.report.push(diagnostic);
    }
}

fn read(reader: &mut Reader, path: &Path) -> Option<Table> {
    let file = match reader.read_table(path) {
        Ok(file) => file,
        Err(diagnostic) => {
            reader.report.push(*diagnostic);
            return None;
        }
    };
    let text = reader.text(file);
    let mut decoder = Decoder::default();
    let table = Table::parse(&mut decoder, file, &text);
    for diagnostic in decoder.finish(&Span::new(file, 0..text.len())) {
        reader.report.push(diagnostic);
    }
    table
}

/// The tables that one file may name: their paths are relative to it.
pub(super) struct TablesBeside<'r> {
    reader: &'r mut Reader,
    folder: &'r Path,
}

impl<'r> TablesBeside<'r> {
    /// The tables of the file at `path`.
    pub(super) fn new(reader: &'r mut Reader, path: &'r Path) -> Self {
        Self { reader, folder: path.parent().unwrap_or_else(|| Path::new("")) }
    }
}

impl Tables for TablesBeside<'_> {
    fn read(&mut self, decoder: &mut Decoder, file: &Spanned<String>) -> Option<TabulatedModel> {
        let path = self.folder.join(&file.value);
        // Every error says which file named the table: it may be wrong about that, and it is the one that is checked.
        let named = |diagnostic: Diagnostic| match diagnostic.primary {
            Some(_) => diagnostic.secondary(file.span.clone(), "the table is named here"),
            None => diagnostic
                .label(file.span.clone(), "no such table")
                .help("the path is relative to the folder of this file"),
        };
        let csv = match self.reader.read_table(&path) {
            Ok(csv) => csv,
            Err(diagnostic) => {
                decoder.report(named(*diagnostic));
                return None;
            }
        };
        let text = self.reader.text(csv);
        let mut of_table = Decoder::default();
        let table = Table::parse(&mut of_table, csv, &text);
        let model = table.and_then(|table| table.model(&mut of_table));
        decoder.report_of_table(of_table.finish(&Span::new(csv, 0..text.len())).into_iter().map(named));
        model
    }
}
