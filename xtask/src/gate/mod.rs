//! The gate: every check that a change must pass, in one command.
//!
//! Cheap steps come first, so that a misspelt word does not wait for the tests. A step that cannot run here says so, with
//! the reason, in its own place and again in the summary: the gate never skips in silence.

mod step;
mod steps;
mod summary;

use std::time::Instant;

use crate::driver;
use crate::shell::Failure;
use step::{Outcome, Step};
use summary::{Ended, Line};

const USAGE: &str = "usage: cargo xtask ci [--quick] [--keep-going]";

/// What the command line asks for.
#[derive(Clone, Copy, Debug, Default)]
struct Wanted {
    /// Only what takes a minute or two: formatting, lints and unit tests.
    is_quick: bool,
    /// Run the steps after a failed one too.
    keeps_going: bool,
}

impl Wanted {
    fn parse(arguments: &[String]) -> Result<Self, Failure> {
        let mut wanted = Self::default();
        for argument in arguments {
            match argument.as_str() {
                "--quick" => wanted.is_quick = true,
                "--keep-going" => wanted.keeps_going = true,
                other => return Err(Failure(format!("`{other}` is no option of `ci`\n  = help: {USAGE}"))),
            }
        }
        Ok(wanted)
    }
}

pub(crate) fn run_command(arguments: &[String]) -> Result<(), Failure> {
    let wanted = Wanted::parse(arguments)?;
    // The lints build everything, before any test does.
    driver::ensure_compiler()?;
    let steps: &[Step] = if wanted.is_quick { &steps::QUICK } else { &steps::ALL };
    let start = Instant::now();
    let mut lines: Vec<Line> = Vec::new();
    for (index, step) in steps.iter().enumerate() {
        let has_failed = lines.iter().any(|line| matches!(line.ended, Ended::Failed(_)));
        if has_failed && !wanted.keeps_going {
            lines.push(Line::not_run(step.title, "an earlier step failed"));
            continue;
        }
        println!("\n== {} of {}: {} ({})", index + 1, steps.len(), step.title, step.what);
        let started = Instant::now();
        let ended = match (step.run)() {
            Ok(Outcome::Passed) => Ended::Passed(None),
            Ok(Outcome::PassedExcept(what)) => Ended::Passed(Some(what)),
            Ok(Outcome::NotRun(why)) => Ended::NotRun(why),
            Err(Failure(why)) => Ended::Failed(why),
        };
        let line = Line { title: step.title, time: started.elapsed(), ended };
        println!("== {line}");
        lines.push(line);
    }
    println!("\n{}", summary::render(&lines, start.elapsed()));
    let failed: Vec<&str> =
        lines.iter().filter(|line| matches!(line.ended, Ended::Failed(_))).map(|line| line.title).collect();
    if failed.is_empty() { Ok(()) } else { Err(Failure(format!("the gate failed: {}", failed.join(", ")))) }
}

#[cfg(test)]
mod tests {
    use super::Wanted;

    fn parse(arguments: &[&str]) -> Result<Wanted, String> {
        let arguments: Vec<String> = arguments.iter().map(|&argument| argument.to_owned()).collect();
        Wanted::parse(&arguments).map_err(|failure| failure.0)
    }

    #[test]
    fn options_come_in_any_order_and_others_are_refused() {
        let wanted = parse(&["--keep-going", "--quick"]).expect("both are options");
        assert!(wanted.is_quick && wanted.keeps_going);
        let wanted = parse(&[]).expect("none is needed");
        assert!(!wanted.is_quick && !wanted.keeps_going);
        let message = parse(&["--fast"]).expect_err("there is no such option");
        assert!(message.contains("`--fast`") && message.contains("--keep-going"), "{message}");
    }
}
