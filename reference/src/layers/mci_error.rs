//! What is wrong with an input file, and where.

use std::ops::Range;

use thiserror::Error;

use super::layer_error::LayerError;

/// An error in MCML's input, with its place in the text.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("line {line}: {problem}")]
#[non_exhaustive]
pub struct MciError {
    /// Line, from 1. For a text that ends too early, the line after its last.
    pub line: usize,
    /// Bytes of the text that are to blame.
    pub span: Range<usize>,
    /// What is wrong.
    pub problem: MciProblem,
}

/// What is wrong with a line of MCML's input, and what to write instead.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum MciProblem {
    /// The text ends where a line is due.
    #[error("the text ends where {expected} should follow; add the missing lines")]
    Ends {
        /// What was due.
        expected: String,
    },
    /// A line has fewer fields than it needs.
    #[error("expected {expected}, found {found} of {needed}; add what is missing to this line")]
    TooFew {
        /// What the line should hold.
        expected: String,
        /// Fields needed.
        needed: usize,
        /// Fields found.
        found: usize,
    },
    /// A line goes on after its last field.
    #[error("unexpected `{text}` after {expected}; begin a comment with `#`")]
    TooMany {
        /// What the line should hold.
        expected: String,
        /// The first field too many.
        text: String,
    },
    /// A field is not a number.
    #[error("`{text}` is not a number: expected {expected}, such as 0.01 or 1E-2")]
    NotANumber {
        /// What the field should be.
        expected: &'static str,
        /// What it is.
        text: String,
    },
    /// A field is not a whole number.
    #[error("`{text}` is not a whole number: expected {expected}, written in digits alone, such as 1000000")]
    NotAWholeNumber {
        /// What the field should be.
        expected: &'static str,
        /// What it is.
        text: String,
    },
    /// The file is of another version.
    #[error(
        "file version `{text}`: expected 1.0, the version of MCML 1.x; inputs of MCML 2 have another form"
    )]
    Version {
        /// What the first field is.
        text: String,
    },
    /// A number of runs outside 1 to 32 767.
    #[error("{count} runs: expected 1 to 32767")]
    RunCount {
        /// What was given.
        count: u64,
    },
    /// The output's format is neither A nor B.
    #[error("output format `{text}`: expected A (text) or B")]
    Format {
        /// What was given.
        text: String,
    },
    /// Two runs would write the same file.
    #[error("output file `{name}` is already that of line {first}; give each run a name of its own")]
    SameOutput {
        /// The name.
        name: String,
        /// Line of its first use.
        first: usize,
    },
    /// More follows after the last run.
    #[error(
        "unexpected `{text}` after the last of {runs} runs; raise the number of runs, or comment it out with `#`"
    )]
    Trailing {
        /// The first field too many.
        text: String,
        /// Number of runs that the text announces.
        runs: u64,
    },
    /// A value that no run can have.
    #[error(transparent)]
    Value(#[from] LayerError),
}
