//! Reader of MCML's input files (`.mci`, file version 1.0).
//!
//! One line for each group of values, in a fixed order; `#` begins a comment, empty lines do not count (MCML's manual). MCML itself reads with `sscanf` and ignores what it does not understand; this reader
//! refuses it, since a misread number makes a wrong result look right.

use std::collections::HashMap;
use std::ops::Range;

use super::grid::Grid;
use super::layer::{LARGEST_COUNT, Layer, LayerStack, check_refractive_index};
use super::layer_error::LayerError;
use super::mci_error::{MciError, MciProblem};
use super::run::{LayerRun, OutputFormat};

/// Reads the runs of one input file.
///
/// # Errors
///
/// [`MciError`] gives the line and the bytes of the first thing that is wrong, and how to mend it.
pub fn parse_mci(text: &str) -> Result<Vec<LayerRun>, MciError> {
    let mut lines = DataLines::new(text);
    lines.version()?;
    let announced = lines.run_count()?;
    let mut names = HashMap::new();
    let mut runs = Vec::new();
    for _ in 0..announced {
        runs.push(lines.run(&mut names)?);
    }
    match lines.next_data() {
        Some(line) => {
            let field = &line.fields[0];
            Err(line.error(field, MciProblem::Trailing { text: field.text.to_owned(), runs: announced }))
        }
        None => Ok(runs),
    }
}

/// A word of a line.
#[derive(Debug, Clone, PartialEq)]
struct Field<'a> {
    text: &'a str,
    span: Range<usize>,
}

/// A line that holds more than a comment.
struct DataLine<'a> {
    number: usize,
    fields: Vec<Field<'a>>,
}

impl DataLine<'_> {
    fn error(&self, field: &Field<'_>, problem: impl Into<MciProblem>) -> MciError {
        MciError { line: self.number, span: field.span.clone(), problem: problem.into() }
    }

    /// The whole of the line.
    fn span(&self) -> Range<usize> {
        let start = self.fields.first().map_or(0, |field| field.span.start);
        let end = self.fields.last().map_or(0, |field| field.span.end);
        start..end
    }

    fn number(&self, index: usize, expected: &'static str) -> Result<f64, MciError> {
        let field = &self.fields[index];
        let problem = || MciProblem::NotANumber { expected, text: field.text.to_owned() };
        field.text.parse().map_err(|_| self.error(field, problem()))
    }

    fn whole_number(&self, index: usize, expected: &'static str) -> Result<u64, MciError> {
        let field = &self.fields[index];
        let problem = || MciProblem::NotAWholeNumber { expected, text: field.text.to_owned() };
        field.text.parse().map_err(|_| self.error(field, problem()))
    }

    /// Puts the place of the field at `index` to an error of its value.
    fn value<T>(&self, index: usize, value: Result<T, LayerError>) -> Result<T, MciError> {
        value.map_err(|error| self.error(&self.fields[index], error))
    }
}

struct DataLines<'a> {
    text: &'a str,
    /// Bytes read.
    offset: usize,
    /// Lines read.
    number: usize,
}

impl<'a> DataLines<'a> {
    fn new(text: &'a str) -> Self {
        // Editors of some systems begin a file with a byte-order mark.
        let offset = if text.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
        Self { text, offset, number: 0 }
    }

    fn next_data(&mut self) -> Option<DataLine<'a>> {
        while self.offset < self.text.len() {
            let start = self.offset;
            let rest = &self.text[start..];
            let length = rest.find('\n').map_or(rest.len(), |at| at + 1);
            self.offset += length;
            self.number += 1;
            let data = rest[..length].split('#').next().unwrap_or_default();
            let fields: Vec<_> = data
                .split_whitespace()
                .map(|word| {
                    let at = start + (word.as_ptr() as usize - data.as_ptr() as usize);
                    Field { text: word, span: at..at + word.len() }
                })
                .collect();
            if !fields.is_empty() {
                return Some(DataLine { number: self.number, fields });
            }
        }
        None
    }

    /// The next line, which must have `needed` fields.
    fn expect(&mut self, needed: usize, expected: &str) -> Result<DataLine<'a>, MciError> {
        let Some(line) = self.next_data() else {
            let end = self.text.len();
            let problem = MciProblem::Ends { expected: expected.to_owned() };
            return Err(MciError { line: self.number + 1, span: end..end, problem });
        };
        let found = line.fields.len();
        if found < needed {
            let problem = MciProblem::TooFew { expected: expected.to_owned(), needed, found };
            return Err(MciError { line: line.number, span: line.span(), problem });
        }
        if let Some(field) = line.fields.get(needed) {
            let problem = MciProblem::TooMany { expected: expected.to_owned(), text: field.text.to_owned() };
            return Err(line.error(field, problem));
        }
        Ok(line)
    }

    fn version(&mut self) -> Result<(), MciError> {
        let line = self.expect(1, "the file version, 1.0")?;
        let field = &line.fields[0];
        if field.text == "1.0" {
            Ok(())
        } else {
            Err(line.error(field, MciProblem::Version { text: field.text.to_owned() }))
        }
    }

    fn run_count(&mut self) -> Result<u64, MciError> {
        let line = self.expect(1, "the number of runs")?;
        let count = line.whole_number(0, "the number of runs")?;
        if (1..=LARGEST_COUNT as u64).contains(&count) {
            Ok(count)
        } else {
            Err(line.error(&line.fields[0], MciProblem::RunCount { count }))
        }
    }

    fn run(&mut self, names: &mut HashMap<String, usize>) -> Result<LayerRun, MciError> {
        let (name, format) = self.output(names)?;
        let photon_line = self.expect(1, "the number of photons")?;
        let photons = photon_line.whole_number(0, "the number of photons")?;
        if photons == 0 {
            return photon_line.value(0, Err(LayerError::NoPhotons));
        }
        let grid = self.grid()?;
        let stack = self.stack()?;
        photon_line.value(0, LayerRun::new(name, format, photons, grid, stack))
    }

    fn output(&mut self, names: &mut HashMap<String, usize>) -> Result<(String, OutputFormat), MciError> {
        let line = self.expect(2, "an output file and its format, such as `slab.mco A`")?;
        let (name, format) = (&line.fields[0], &line.fields[1]);
        if let Some(first) = names.get(name.text) {
            let problem = MciProblem::SameOutput { name: name.text.to_owned(), first: *first };
            return Err(line.error(name, problem));
        }
        names.insert(name.text.to_owned(), line.number);
        let letter = match format.text {
            "A" | "a" => OutputFormat::Ascii,
            "B" | "b" => OutputFormat::Binary,
            other => return Err(line.error(format, MciProblem::Format { text: other.to_owned() })),
        };
        Ok((name.text.to_owned(), letter))
    }

    fn grid(&mut self) -> Result<Grid, MciError> {
        let sizes = self.expect(2, "two cell sizes in cm, `dz dr`")?;
        let dz = sizes.number(0, "the cell size dz in cm")?;
        let dr = sizes.number(1, "the cell size dr in cm")?;
        for (index, probe) in
            [Grid::new(dz, 1.0, 1, 1, 1), Grid::new(1.0, dr, 1, 1, 1)].into_iter().enumerate()
        {
            sizes.value(index, probe)?;
        }
        let counts = self.expect(3, "three numbers of cells, `nz nr na`")?;
        let nz = counts.whole_number(0, "the number of cells nz")?;
        let nr = counts.whole_number(1, "the number of cells nr")?;
        let na = counts.whole_number(2, "the number of cells na")?;
        let probes = [Grid::new(dz, dr, nz, 1, 1), Grid::new(dz, dr, 1, nr, 1)];
        for (index, probe) in probes.into_iter().enumerate() {
            counts.value(index, probe)?;
        }
        counts.value(2, Grid::new(dz, dr, nz, nr, na))
    }

    fn stack(&mut self) -> Result<LayerStack, MciError> {
        let count_line = self.expect(1, "the number of layers")?;
        let count = count_line.whole_number(0, "the number of layers")?;
        if !(1..=LARGEST_COUNT as u64).contains(&count) {
            let count = usize::try_from(count).unwrap_or(usize::MAX);
            return count_line.value(0, Err(LayerError::LayerCount { count }));
        }
        let above = self.refractive_index("the refractive index n above the first layer")?;
        let mut layers = Vec::new();
        let mut places = Vec::new();
        for number in 1..=count {
            let line =
                self.expect(5, &format!("the five numbers `n mua mus g d` of layer {number} of {count}"))?;
            layers.push(line.layer()?);
            places.push((line.number, line.span()));
        }
        let below = self.refractive_index("the refractive index n below the last layer")?;
        LayerStack::new(above, layers, below).map_err(|error| {
            let (line, span) = match &error {
                LayerError::Endless { layer, .. } => places[layer - 1].clone(),
                _ => (count_line.number, count_line.span()),
            };
            MciError { line, span, problem: error.into() }
        })
    }

    fn refractive_index(&mut self, expected: &'static str) -> Result<f64, MciError> {
        let line = self.expect(1, expected)?;
        let value = line.number(0, expected)?;
        line.value(0, check_refractive_index(value))?;
        Ok(value)
    }
}

impl DataLine<'_> {
    fn layer(&self) -> Result<Layer, MciError> {
        let layer = Layer::new(
            self.number(0, "the refractive index n")?,
            self.number(1, "the absorption coefficient mua in 1/cm")?,
            self.number(2, "the scattering coefficient mus in 1/cm")?,
            self.number(3, "the anisotropy g")?,
            self.number(4, "the thickness d in cm")?,
        );
        layer.map_err(|error| {
            let index = match error {
                LayerError::RefractiveIndex { .. } => 0,
                LayerError::AbsorptionCoefficient { .. } => 1,
                LayerError::ScatteringCoefficient { .. } => 2,
                LayerError::Anisotropy { .. } => 3,
                _ => 4,
            };
            self.error(&self.fields[index], error)
        })
    }
}
