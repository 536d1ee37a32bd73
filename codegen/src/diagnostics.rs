//! Errors and warnings about material files: what is wrong, where, and a remedy.

use std::fmt;

use crate::source::Span;

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
/// use subsurface_codegen::source::Span;
/// use subsurface_codegen::{Diagnostic, Report};
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

/// What is wrong, and the remedies, a line each. The place is not in it: [`Report::render`](crate::Report::render) knows the files.
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
