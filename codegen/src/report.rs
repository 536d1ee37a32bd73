//! The errors and warnings of one run: file, line and column, the source line with a caret, and remedies.

use std::cmp::Ordering;
use std::fmt;

use codespan_reporting::term;
use serde_json::{Value, json};

use crate::diagnostics::{Diagnostic, Severity};
use crate::excerpt::Excerpts;
use crate::source::{SourceMap, Span};

/// The diagnostics of one run, in a fixed order, with the text they point into.
///
/// The order is by displayed path, then by offset, whatever the order in which files were read; what has no place
/// comes first. The same diagnostic pushed twice is kept once: several materials may inherit one suspect value.
#[derive(Clone, Debug, Default)]
pub struct Report {
    sources: SourceMap,
    diagnostics: Vec<Diagnostic>,
}

impl Report {
    /// A report without diagnostics about the given files.
    #[must_use]
    pub fn new(sources: SourceMap) -> Self {
        Self { sources, diagnostics: Vec::new() }
    }

    /// The files that the diagnostics point into.
    #[must_use]
    pub fn sources(&self) -> &SourceMap {
        &self.sources
    }

    /// Gives access to the files, to add one (emitted WGSL, for example) before pointing into it.
    pub fn sources_mut(&mut self) -> &mut SourceMap {
        &mut self.sources
    }

    /// Adds a diagnostic at its place in the order.
    pub fn push(&mut self, diagnostic: Diagnostic) {
        let before = |other: &Diagnostic| order(&self.sources, other, &diagnostic) == Ordering::Less;
        let first_equal = self.diagnostics.partition_point(before);
        let known = self.diagnostics[first_equal..]
            .iter()
            .take_while(|other| order(&self.sources, other, &diagnostic) == Ordering::Equal)
            .any(|other| other.primary == diagnostic.primary && other.help == diagnostic.help);
        if !known {
            self.diagnostics.insert(first_equal, diagnostic);
        }
    }

    /// All diagnostics, in order.
    pub fn iter(&self) -> impl Iterator<Item = &Diagnostic> {
        self.diagnostics.iter()
    }

    /// The errors, in order.
    pub fn errors(&self) -> impl Iterator<Item = &Diagnostic> {
        self.iter().filter(|diagnostic| diagnostic.severity == Severity::Error)
    }

    /// The warnings, in order.
    pub fn warnings(&self) -> impl Iterator<Item = &Diagnostic> {
        self.iter().filter(|diagnostic| diagnostic.severity == Severity::Warning)
    }

    /// Whether there is an error.
    #[must_use]
    pub fn has_errors(&self) -> bool {
        self.errors().next().is_some()
    }

    /// Whether there is neither an error nor a warning.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.diagnostics.is_empty()
    }

    /// Keeps the diagnostics for which `keep` holds.
    pub fn retain(&mut self, keep: impl FnMut(&Diagnostic) -> bool) {
        self.diagnostics.retain(keep);
    }

    /// The text for a terminal, in the manner of rustc; with ANSI colours when `color` is set.
    #[must_use]
    pub fn render(&self, color: bool) -> String {
        let config = term::Config::default();
        let mut text = String::new();
        for diagnostic in &self.diagnostics {
            let excerpts = Excerpts::new(&self.sources, diagnostic);
            let shown = excerpts.to_codespan(diagnostic);
            let rendered = if color {
                let mut buffer = term::termcolor::Buffer::ansi();
                term::emit_to_write_style(&mut buffer, &config, &excerpts, &shown)
                    .map(|()| String::from_utf8_lossy(buffer.as_slice()).into_owned())
            } else {
                term::emit_into_string(&config, &excerpts, &shown)
            };
            // Rendering fails only for a span outside its file; the message must be shown even then.
            let rendered = rendered.unwrap_or_else(|_| format!("{}\n", diagnostic.message));
            // codespan-reporting pads empty lines; blessed texts and editors dislike trailing blanks.
            for line in rendered.trim_end().lines() {
                text.push_str(line.trim_end());
                text.push('\n');
            }
            text.push('\n');
        }
        text.truncate(text.trim_end().len());
        if !text.is_empty() {
            text.push('\n');
        }
        text
    }

    /// The diagnostics as data, for editors: a list of objects with `severity`, `message`, `file`, `line`, `column`,
    /// `end_line`, `end_column` (from 1, columns in characters, the end exclusive), `label`, `help` (a list) and
    /// `secondary` (a list of places with `label`). Without a place, `file` and the numbers are null.
    #[must_use]
    pub fn to_json(&self) -> Value {
        let place = |place: Option<&(Span, String)>| match place {
            Some((span, label)) => {
                let start = self.sources.position(span.file, span.range.start);
                let end = self.sources.position(span.file, span.range.end);
                json!({
                    "file": self.sources.path(span.file), "line": start.line, "column": start.column,
                    "end_line": end.line, "end_column": end.column, "label": label,
                })
            }
            None => json!({
                "file": null, "line": null, "column": null, "end_line": null, "end_column": null, "label": null,
            }),
        };
        let list = self.iter().map(|diagnostic| {
            let mut object = place(diagnostic.primary.as_ref());
            object["severity"] = json!(diagnostic.severity.name());
            object["message"] = json!(diagnostic.message);
            object["help"] = json!(diagnostic.help);
            object["secondary"] = diagnostic.secondary.iter().map(|other| place(Some(other))).collect();
            object
        });
        Value::Array(list.collect())
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(false))
    }
}

impl std::error::Error for Report {}

/// The order of the report: place, then severity, then text.
fn order(sources: &SourceMap, a: &Diagnostic, b: &Diagnostic) -> Ordering {
    fn key<'a>(sources: &'a SourceMap, diagnostic: &'a Diagnostic) -> impl Ord + 'a {
        let place = diagnostic
            .primary
            .as_ref()
            .map(|(span, _)| (sources.path(span.file), span.range.start, span.range.end));
        (place, diagnostic.severity, diagnostic.message.as_str())
    }
    key(sources, a).cmp(&key(sources, b))
}
