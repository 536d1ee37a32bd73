//! Which column of a table holds what.

use crate::diagnostics::Diagnostic;
use crate::schema::Decoder;
use crate::suggestion::{closest, list, shortened};

use super::record::{Cell, Record};

pub(super) const EXAMPLE: &str =
    "for example `surface_albedo,r,r_reflectance`, then rows such as `0.5,0.1,0.048`";

/// What the value of a row measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Measure {
    /// R per area.
    Reflectance,
    /// r·R.
    RReflectance,
    /// 2πr·R.
    RadialReflectance,
}

impl Measure {
    const ALL: [Measure; 3] = [Measure::Reflectance, Measure::RReflectance, Measure::RadialReflectance];

    pub(super) fn name(self) -> &'static str {
        match self {
            Measure::Reflectance => "reflectance",
            Measure::RReflectance => "r_reflectance",
            Measure::RadialReflectance => "radial_reflectance",
        }
    }

    pub(super) fn meaning(self) -> &'static str {
        match self {
            Measure::Reflectance => {
                "give R per mean free path squared, 0 or more; where noise fell below 0, write 0"
            }
            Measure::RReflectance => {
                "give r·R per mean free path, 0 or more; where noise fell below 0, write 0"
            }
            Measure::RadialReflectance => {
                "give 2πr·R per mean free path, 0 or more; where noise fell below 0, write 0"
            }
        }
    }
}

/// The columns of the radii.
#[derive(Clone, Copy, Debug)]
pub(super) enum Radii {
    Points(usize),
    Bins(usize, usize),
}

/// The columns in use.
#[derive(Debug)]
pub(super) struct Columns {
    pub(super) surface_albedo: Option<usize>,
    pub(super) radii: Radii,
    pub(super) measure: Measure,
    pub(super) value: usize,
    pub(super) standard_error: Option<usize>,
}

/// Every name that a column may have.
const KNOWN: [&str; 8] = [
    "surface_albedo",
    "r",
    "r_lo",
    "r_hi",
    "reflectance",
    "r_reflectance",
    "radial_reflectance",
    "standard_error",
];

impl Columns {
    /// Reads the header; `None` when columns are missing or contradict each other, which is reported.
    pub(super) fn of(decoder: &mut Decoder, header: &Record) -> Option<Columns> {
        if header.cells.iter().all(|cell| cell.text.parse::<f64>().is_ok()) {
            decoder.report(
                Diagnostic::error("the table has no header")
                    .label(header.span.clone(), "expected the names of the columns, found numbers")
                    .help(EXAMPLE),
            );
            return None;
        }
        let only = header.cells.len() == 1;
        if let Some(separator) =
            [';', '\t', '|'].into_iter().find(|c| only && header.cells[0].text.contains(*c))
        {
            decoder.report(
                Diagnostic::error("the columns are not separated by commas")
                    .label(header.span.clone(), format!("found {separator:?}"))
                    .help("save the table with commas between the columns and points in the numbers"),
            );
            return None;
        }
        repeated(decoder, header)?;
        let find = |name: &str| header.cells.iter().position(|cell| cell.text == name);
        let radii = match (find("r"), find("r_lo"), find("r_hi")) {
            (Some(r), None, None) => Radii::Points(r),
            (None, Some(r_lo), Some(r_hi)) => Radii::Bins(r_lo, r_hi),
            (Some(r), Some(other), _) | (Some(r), None, Some(other)) => {
                decoder.report(exclusive(
                    &header.cells[r],
                    &header.cells[other],
                    "`r` for points, or `r_lo` and `r_hi` for bins",
                ));
                return None;
            }
            (None, Some(_), None) => {
                return missing(decoder, header, "r_hi", "add `r_hi`, where each bin ends");
            }
            (None, None, Some(_)) => {
                return missing(decoder, header, "r_lo", "add `r_lo`, where each bin begins");
            }
            (None, None, None) => {
                let help = "add `r` for points, or `r_lo` and `r_hi` for bins, in mean free paths";
                return missing(decoder, header, "r", help);
            }
        };
        let mut values = Measure::ALL.into_iter().filter_map(|m| Some((m, find(m.name())?)));
        let Some((measure, value)) = values.next() else {
            let help =
                "add `reflectance` (R per area), `r_reflectance` (r·R) or `radial_reflectance` (2πr·R)";
            return missing(decoder, header, "r_reflectance", help);
        };
        if let Some((_, other)) = values.next() {
            let choice = format!("one of {}", list(Measure::ALL.map(Measure::name)));
            decoder.report(exclusive(&header.cells[value], &header.cells[other], &choice));
            return None;
        }
        Some(Columns {
            surface_albedo: find("surface_albedo"),
            radii,
            measure,
            value,
            standard_error: find("standard_error"),
        })
    }
}

/// Reports a known column that stands twice.
fn repeated(decoder: &mut Decoder, header: &Record) -> Option<()> {
    let cells = header.cells.iter().enumerate();
    for (position, cell) in cells.filter(|(_, cell)| KNOWN.contains(&cell.text.as_str())) {
        if let Some(first) = header.cells[..position].iter().find(|other| other.text == cell.text) {
            decoder.report(
                Diagnostic::error(format!("column `{}` stands twice", cell.text))
                    .label(cell.span.clone(), "again here")
                    .secondary(first.span.clone(), "first here")
                    .help("remove or rename one of the two"),
            );
            return None;
        }
    }
    Some(())
}

fn exclusive(one: &Cell, other: &Cell, choice: &str) -> Diagnostic {
    Diagnostic::error(format!("`{}` and `{}` exclude each other", one.text, other.text))
        .label(one.span.clone(), "given here")
        .secondary(other.span.clone(), "and here")
        .help(format!("give either {choice}, and rename the other column to have it ignored"))
}

/// Reports that a column is missing; names the one that was probably meant.
fn missing<T>(decoder: &mut Decoder, header: &Record, name: &str, help: &str) -> Option<T> {
    let mut diagnostic =
        Diagnostic::error(format!("missing column `{name}`")).label(header.span.clone(), "no such column");
    let unknown = header.cells.iter().filter(|cell| !KNOWN.contains(&cell.text.as_str()));
    for cell in unknown {
        // A short name such as `R` is near to many: case aside it must be the same.
        let same = KNOWN.into_iter().find(|known| known.eq_ignore_ascii_case(&cell.text));
        let near = || closest(&cell.text, KNOWN).filter(|_| cell.text.len() > 3);
        if let Some(known) = same.or_else(near) {
            let written = shortened(&cell.text);
            diagnostic = diagnostic
                .help(format!("is `{written}` meant to be `{known}`? Names are read to the letter"));
        }
    }
    decoder.report(diagnostic.help(help.to_owned()));
    None
}
