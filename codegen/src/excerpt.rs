//! What of a file is shown under a diagnostic: lines too long for a terminal are cut around the label.
//!
//! A file nested 10 000 deep or a name of 300 characters is one long line; printing it whole would bury the message.
//! The numbers in `file:line:column` stay those of the real file.

use std::collections::BTreeMap;
use std::ops::Range;

use codespan_reporting::diagnostic as codespan;
use codespan_reporting::files::{self, Files};

use crate::diagnostics::{Diagnostic, Severity};
use crate::source::{FileId, SourceMap, Span};

/// Longest line shown whole, in bytes. Two terminal widths: rustfmt's own limit here is 110.
const LONGEST_LINE: usize = 160;
/// Text kept before the label of a line that is cut, in bytes.
const LEAD: usize = 60;
/// Stands for the text that is left out.
const ELLIPSIS: &str = "…";

/// The files of a [`SourceMap`] as one diagnostic shows them.
pub(crate) struct Excerpts<'a> {
    sources: &'a SourceMap,
    cut: BTreeMap<FileId, CutFile>,
}

struct CutFile {
    text: String,
    lines: Vec<CutLine>,
}

/// One line of a cut file.
struct CutLine {
    /// Offset of the line in the real file.
    original_start: usize,
    /// Offset of the line in the shown text.
    shown_start: usize,
    /// The part of the real file that is shown.
    window: Range<usize>,
    /// Bytes shown before the window (an ellipsis or nothing).
    prefix: usize,
}

impl<'a> Excerpts<'a> {
    /// Cuts the files that `diagnostic` points into, where its labels lie on long lines.
    pub(crate) fn new(sources: &'a SourceMap, diagnostic: &Diagnostic) -> Self {
        // Offsets that must stay visible, the primary label first.
        let mut wanted: BTreeMap<FileId, Vec<usize>> = BTreeMap::new();
        for (span, _) in labels(diagnostic) {
            wanted.entry(span.file).or_default().extend([span.range.start, span.range.end]);
        }
        let mut cut = BTreeMap::new();
        for (file, offsets) in wanted {
            let on_long_line = |&offset: &usize| {
                let line = sources.line_index(file, offset).unwrap_or(0);
                sources.line_range(file, line).is_ok_and(|range| range.len() > LONGEST_LINE)
            };
            if offsets.iter().any(on_long_line) {
                cut.insert(file, CutFile::new(sources.text(file), &offsets));
            }
        }
        Self { sources, cut }
    }

    /// The diagnostic with its labels moved to where the shown text has them.
    pub(crate) fn to_codespan(&self, diagnostic: &Diagnostic) -> codespan::Diagnostic<FileId> {
        let severity = match diagnostic.severity {
            Severity::Error => codespan::Severity::Error,
            Severity::Warning => codespan::Severity::Warning,
        };
        let is_primary =
            |label: &(Span, String)| diagnostic.primary.as_ref().is_some_and(|p| std::ptr::eq(p, label));
        let labels = labels(diagnostic).map(|label| {
            let (span, message) = label;
            let style = if is_primary(label) {
                codespan::LabelStyle::Primary
            } else {
                codespan::LabelStyle::Secondary
            };
            let range = self.shown(span.file, span.range.start)..self.shown(span.file, span.range.end);
            codespan::Label::new(style, span.file, range).with_message(message)
        });
        codespan::Diagnostic::new(severity)
            .with_message(&diagnostic.message)
            .with_labels(labels.collect())
            .with_notes(diagnostic.help.iter().map(|help| format!("help: {help}")).collect())
    }

    fn shown(&self, file: FileId, offset: usize) -> usize {
        self.cut.get(&file).map_or(offset, |cut| cut.shown(offset))
    }
}

fn labels(diagnostic: &Diagnostic) -> impl Iterator<Item = &(Span, String)> {
    diagnostic.primary.iter().chain(&diagnostic.secondary)
}

/// The last character boundary up to `offset`.
fn boundary_before(text: &str, offset: usize) -> usize {
    (0..=offset).rev().find(|&offset| text.is_char_boundary(offset)).unwrap_or(0)
}

impl CutFile {
    fn new(text: &str, offsets: &[usize]) -> Self {
        let mut shown = String::new();
        let mut lines = Vec::new();
        let mut original_start = 0;
        for line in text.split_inclusive('\n') {
            let content = line.trim_end_matches(['\n', '\r']);
            let whole = original_start..original_start + content.len();
            let mut window = whole.clone();
            if content.len() > LONGEST_LINE {
                let wanted =
                    offsets.iter().copied().find(|offset| (whole.start..=whole.end).contains(offset));
                let lead = wanted.unwrap_or(whole.start).saturating_sub(LEAD).max(whole.start);
                window.start = boundary_before(text, lead);
                window.end = boundary_before(text, (window.start + LONGEST_LINE).min(whole.end));
            }
            let shown_start = shown.len();
            let prefix = if window.start > whole.start { ELLIPSIS } else { "" };
            let suffix = if window.end < whole.end { ELLIPSIS } else { "" };
            shown.extend([prefix, &text[window.clone()], suffix, &line[content.len()..]]);
            lines.push(CutLine { original_start, shown_start, window, prefix: prefix.len() });
            original_start += line.len();
        }
        if text.is_empty() || text.ends_with('\n') {
            let end = text.len();
            lines.push(CutLine {
                original_start: end,
                shown_start: shown.len(),
                window: end..end,
                prefix: 0,
            });
        }
        Self { text: shown, lines }
    }

    fn shown(&self, offset: usize) -> usize {
        let line = self.lines.partition_point(|line| line.original_start <= offset).saturating_sub(1);
        self.lines.get(line).map_or(0, |line| {
            let inside = offset.clamp(line.window.start, line.window.end);
            line.shown_start + line.prefix + (inside - line.window.start)
        })
    }

    fn line_index(&self, shown_offset: usize) -> usize {
        self.lines.partition_point(|line| line.shown_start <= shown_offset).saturating_sub(1)
    }
}

impl<'a> Files<'a> for Excerpts<'_> {
    type FileId = FileId;
    type Name = &'a str;
    type Source = &'a str;

    fn name(&'a self, id: FileId) -> Result<&'a str, files::Error> {
        Ok(self.sources.path(id))
    }

    fn source(&'a self, id: FileId) -> Result<&'a str, files::Error> {
        Ok(self.cut.get(&id).map_or_else(|| &**self.sources.text(id), |cut| cut.text.as_str()))
    }

    fn line_index(&'a self, id: FileId, byte_index: usize) -> Result<usize, files::Error> {
        match self.cut.get(&id) {
            Some(cut) => Ok(cut.line_index(byte_index)),
            None => self.sources.line_index(id, byte_index),
        }
    }

    fn line_range(&'a self, id: FileId, line_index: usize) -> Result<Range<usize>, files::Error> {
        let Some(cut) = self.cut.get(&id) else { return self.sources.line_range(id, line_index) };
        let max = cut.lines.len().saturating_sub(1);
        let line = cut.lines.get(line_index).ok_or(files::Error::LineTooLarge { given: line_index, max })?;
        let end = cut.lines.get(line_index + 1).map_or(cut.text.len(), |next| next.shown_start);
        Ok(line.shown_start..end)
    }

    fn column_number(
        &'a self,
        id: FileId,
        line_index: usize,
        byte_index: usize,
    ) -> Result<usize, files::Error> {
        let Some(cut) = self.cut.get(&id) else {
            let range = self.sources.line_range(id, line_index)?;
            return Ok(files::column_index(self.sources.text(id), range, byte_index) + 1);
        };
        let max = cut.lines.len().saturating_sub(1);
        let line = cut.lines.get(line_index).ok_or(files::Error::LineTooLarge { given: line_index, max })?;
        let inside = byte_index.saturating_sub(line.shown_start + line.prefix);
        let original = (line.window.start + inside).min(line.window.end);
        Ok(self.sources.position(id, original).column)
    }
}

#[cfg(test)]
mod tests {
    use crate::diagnostics::Diagnostic;
    use crate::report::Report;
    use crate::source::Span;

    #[test]
    fn a_long_line_is_cut_around_its_label_and_keeps_its_column() {
        let mut report = Report::default();
        let text = format!("// first line\n{}bad{}\nlast", "é".repeat(5_000), "(".repeat(5_000));
        let file = report.sources_mut().add("long.ron", text.as_str());
        let start = text.find("bad").expect("it is there");
        report.push(Diagnostic::error("this is bad").label(Span::new(file, start..start + 3), "here"));
        let rendered = report.render(false);
        assert!(rendered.contains("long.ron:2:5001"), "{rendered}");
        assert!(rendered.lines().all(|line| line.chars().count() < 200), "{rendered}");
        let caret = rendered.lines().find(|line| line.contains("^^^ here")).expect("a caret line");
        let source = rendered.lines().find(|line| line.contains("bad(")).expect("a source line");
        let column = |line: &str, what| line[..line.find(what).expect("it is there")].chars().count();
        assert_eq!(column(caret, "^^^"), column(source, "bad"));
    }

    #[test]
    fn a_label_at_the_very_end_of_a_long_file_is_shown() {
        let mut report = Report::default();
        let text = format!("{}\n", "x".repeat(1_000));
        let file = report.sources_mut().add("long.ron", text.as_str());
        for at in [999, 1_000, 1_001] {
            report.push(Diagnostic::error("end").label(Span::new(file, at..at), format!("at {at}")));
        }
        let rendered = report.render(false);
        assert!(["at 999", "at 1000", "at 1001"].iter().all(|label| rendered.contains(label)), "{rendered}");
    }
}
