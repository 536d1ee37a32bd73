//! A step of the gate.

use crate::shell::Failure;

/// One check.
pub(crate) struct Step {
    /// What is checked, in a word or two.
    pub(crate) title: &'static str,
    /// The command that does it, as a person would type it.
    pub(crate) what: &'static str,
    /// Runs the check.
    pub(crate) run: fn() -> Result<Outcome, Failure>,
}

/// How a check that did not fail ended.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    Passed,
    /// Passed, but for a part that was not checked: which, and why.
    PassedExcept(String),
    /// Not run: why, and what would change that.
    NotRun(String),
}
