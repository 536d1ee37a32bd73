//! Lines of a CSV file, with the place of every cell.

use csv::{ReaderBuilder, StringRecord, Trim};

use crate::source::{FileId, Span};

/// A line.
#[derive(Debug)]
pub(super) struct Record {
    pub(super) span: Span,
    pub(super) cells: Vec<Cell>,
}

/// A value without the blanks around it.
#[derive(Debug)]
pub(super) struct Cell {
    pub(super) text: String,
    pub(super) span: Span,
}

/// The lines of `text` that are neither blank nor comments.
pub(super) fn records(file: FileId, text: &str) -> Vec<Record> {
    let content = text.strip_prefix('\u{feff}').unwrap_or(text);
    let offset = text.len() - content.len();
    let mut reader = ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .trim(Trim::All)
        .from_reader(content.as_bytes());
    let mut records = Vec::new();
    let mut record = StringRecord::new();
    // The text is UTF-8 and lines may differ in length, so that there is nothing left to fail.
    while let Ok(true) = reader.read_record(&mut record) {
        // A spreadsheet leaves lines of nothing but commas.
        if record.iter().all(str::is_empty) {
            continue;
        }
        let Some(start) = record.position().map(|position| position.byte()) else { continue };
        let (start, end) = (start as usize, (reader.position().byte() as usize).min(content.len()));
        let range = trimmed(content, after_comments(content, start..end)..end);
        records.push(Record {
            span: Span::new(file, range.start + offset..range.end + offset),
            cells: cells(file, offset, content, range, &record),
        });
    }
    records
}

/// Where the record begins: the reader counts the comments and blank lines before it to it.
fn after_comments(content: &str, range: std::ops::Range<usize>) -> usize {
    let mut start = range.start;
    for line in content[range].split_inclusive(['\n', '\r']) {
        if !line.starts_with('#') && !line.trim_end_matches(['\n', '\r']).is_empty() {
            break;
        }
        start += line.len();
    }
    start
}

fn cells(
    file: FileId,
    offset: usize,
    content: &str,
    range: std::ops::Range<usize>,
    record: &StringRecord,
) -> Vec<Cell> {
    let line = &content[range.clone()];
    let whole = || Span::new(file, range.start + offset..range.end + offset);
    let is_quoted = line.contains('"');
    let mut start = range.start;
    let mut parts = line.split(',');
    let mut cells = Vec::with_capacity(record.len());
    for text in record {
        let span = match parts.next() {
            // A comma within quotes separates nothing: the line as a whole is the place.
            Some(part) if !is_quoted => {
                let here = trimmed(content, start..start + part.len());
                start += part.len() + 1;
                Span::new(file, here.start + offset..here.end + offset)
            }
            _ => whole(),
        };
        cells.push(Cell { text: text.to_owned(), span });
    }
    cells
}

/// The range without the blanks at its ends; an empty range stays where it began.
fn trimmed(content: &str, range: std::ops::Range<usize>) -> std::ops::Range<usize> {
    let text = &content[range.clone()];
    let start = range.start + (text.len() - text.trim_start().len());
    let length = text.trim().len();
    if length == 0 { range.start..range.start } else { start..start + length }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::SourceMap;

    fn places(text: &str) -> Vec<Vec<String>> {
        let mut sources = SourceMap::new();
        let file = sources.add("t.csv", text);
        let of = |cell: &Cell| text[cell.span.range.clone()].to_owned();
        records(file, text).iter().map(|record| record.cells.iter().map(of).collect()).collect()
    }

    #[test]
    fn every_cell_has_its_place() {
        let text = "\u{feff}# a comment, with commas\r\n r , ä\r\n\r\n,,\r\n0.5,  1e-3 \n1,\n";
        assert_eq!(places(text), [vec!["r", "ä"], vec!["0.5", "1e-3"], vec!["1", ""]]);
    }

    #[test]
    fn quotes_are_read_and_have_the_place_of_their_line() {
        let text = "\"r\",\"a, b\"\n1,2\n";
        let mut sources = SourceMap::new();
        let file = sources.add("t.csv", text);
        let texts: Vec<String> = records(file, text)[0].cells.iter().map(|cell| cell.text.clone()).collect();
        assert_eq!(texts, ["r", "a, b"]);
        assert_eq!(places(text)[0], ["\"r\",\"a, b\"", "\"r\",\"a, b\""]);
    }

    #[test]
    fn a_quote_that_does_not_end_is_one_long_cell() {
        assert_eq!(places("r,v\n\"1,2\n3,4\n").len(), 2);
    }
}
