//! Errors and warnings about material files: file, line and column, the source line with a caret, and a remedy.

use std::cmp::Ordering;
use std::fmt;

use codespan_reporting::term;
use serde_json::{Value, json};

use crate::excerpt::Excerpts;
use crate::source::{SourceMap, Span};

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Nothing is generated.
    Error,
    /// Legal but suspect: the value is used as written.
    Warning,
}

/// One error or warning.
///
/// ```
/// use subsurface_codegen::diagnostics::{Diagnostic, Report};
/// use subsurface_codegen::source::Span;
///
/// let mut report = Report::default();
/// let file = report.sources_mut().add("jade.ron", "Material(rougness: 0.4)");
/// report.push(
///     Diagnostic::error("unknown field `rougness`")
///         .label(Span::new(file, 9..17), "not a field of `Material`")
///         .help("did you mean `roughness`?"),
/// );
/// assert!(report.render(false).contains("jade.ron:1:10"));
/// let alone = report.iter().next().unwrap().to_string();
/// assert!(alone.starts_with("error: unknown field `rougness`"));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Error or warning.
    pub severity: Severity,
    /// What is wrong, in one line that makes sense on its own.
    pub message: String,
    /// Where, with a label that says what is expected there. `None` when no file is to blame (an empty directory).
    pub primary: Option<(Span, String)>,
    /// Other places that explain the error.
    pub secondary: Vec<(Span, String)>,
    /// Remedies.
    pub help: Vec<String>,
}

impl Diagnostic {
    /// An error without a place yet.
    #[must_use]
    pub fn error(message: impl Into<String>) -> Self {
        Self::new(Severity::Error, message)
    }

    /// A warning without a place yet.
    #[must_use]
    pub fn warning(message: impl Into<String>) -> Self {
        Self::new(Severity::Warning, message)
    }

    fn new(severity: Severity, message: impl Into<String>) -> Self {
        Self { severity, message: message.into(), primary: None, secondary: Vec::new(), help: Vec::new() }
    }

    /// Sets the place that is to blame; the label says what is expected there.
    #[must_use]
    pub fn label(mut self, span: Span, label: impl Into<String>) -> Self {
        self.primary = Some((span, label.into()));
        self
    }

    /// Adds a place that explains the error.
    #[must_use]
    pub fn secondary(mut self, span: Span, label: impl Into<String>) -> Self {
        self.secondary.push((span, label.into()));
        self
    }

    /// Adds a remedy.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help.push(help.into());
        self
    }
}

/// What is wrong, and the remedies, a line each. The place is not in it: [`Report::render`] knows the files.
impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.severity.name(), self.message)?;
        let label = self.primary.iter().map(|(_, label)| label).filter(|label| !label.is_empty());
        for note in label {
            write!(f, "\n  = note: {note}")?;
        }
        for help in &self.help {
            write!(f, "\n  = help: {help}")?;
        }
        Ok(())
    }
}

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

impl Severity {
    /// `error` or `warning`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Error => "error",
            Self::Warning => "warning",
        }
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
