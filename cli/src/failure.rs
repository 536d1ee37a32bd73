//! Errors as the command line shows them: what is wrong, and a remedy.

use std::fmt;

/// An error or warning that knows its remedy.
pub trait Explain: fmt::Display {
    /// What to do about it.
    fn help(&self) -> Option<String>;
}

/// Why a command failed; the process then exits with 1.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    message: String,
    help: Option<String>,
}

impl Failure {
    /// A failure with its remedy.
    pub fn new(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { message: message.into(), help: Some(help.into()) }
    }

    /// A failure whose text says everything already: a report of diagnostics, with its own `error:` lines.
    pub fn reported(report: impl Into<String>) -> Self {
        Self { message: report.into(), help: None }
    }

    /// The text for the terminal, in the manner of rustc.
    pub fn render(&self) -> String {
        match &self.help {
            Some(help) => text("error", &self.message, Some(help)),
            None => self.message.trim_end().to_owned(),
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Failure {}

impl<E: Explain> From<E> for Failure {
    fn from(error: E) -> Self {
        Self { message: error.to_string(), help: Some(error.help().unwrap_or_default()) }
    }
}

/// A warning in the manner of rustc.
pub fn warning(warning: &impl Explain) -> String {
    text("warning", &warning.to_string(), warning.help().as_deref())
}

fn text(severity: &str, message: &str, help: Option<&str>) -> String {
    match help {
        Some(help) if !help.is_empty() => format!("{severity}: {message}\n  = help: {help}"),
        _ => format!("{severity}: {message}"),
    }
}
