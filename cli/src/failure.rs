//! Errors as the command line shows them: what is wrong, and a remedy.

use std::fmt;

/// An error or warning that knows its remedy.
pub trait Explain: fmt::Display {
    /// What to do about it.
    fn help(&self) -> Option<String>;
}

/// Why a command failed; the process then exits with [`exit_code`](Self::exit_code).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    message: String,
    help: Option<String>,
    is_interruption: bool,
}

impl Failure {
    /// A failure with its remedy.
    pub fn new(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { message: message.into(), help: Some(help.into()), is_interruption: false }
    }

    /// The user broke off, and nothing is lost.
    pub fn interrupted(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { is_interruption: true, ..Self::new(message, help) }
    }

    /// 1; 130 where the user broke off, as shells have it (128 + SIGINT).
    pub fn exit_code(&self) -> u8 {
        if self.is_interruption { 130 } else { 1 }
    }

    /// A failure whose text says everything already: a report of diagnostics, with its own `error:` lines.
    pub fn reported(report: impl Into<String>) -> Self {
        Self { message: report.into(), help: None, is_interruption: false }
    }

    /// The text for the terminal, in the manner of rustc.
    pub fn render(&self) -> String {
        match &self.help {
            Some(help) if self.is_interruption => text("interrupted", &self.message, Some(help)),
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
        Self::new(error.to_string(), error.help().unwrap_or_default())
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
