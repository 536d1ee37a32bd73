//! What the gate ran, how long each step took, and what it did not run.

use std::fmt;
use std::time::Duration;

/// How a step ended.
#[derive(Debug)]
pub(crate) enum Ended {
    /// With what was left out, if anything was.
    Passed(Option<String>),
    Failed(String),
    NotRun(String),
}

/// A line of the summary.
#[derive(Debug)]
pub(crate) struct Line {
    pub(crate) title: &'static str,
    pub(crate) time: Duration,
    pub(crate) ended: Ended,
}

impl Line {
    pub(crate) fn not_run(title: &'static str, why: &str) -> Self {
        Self { title, time: Duration::ZERO, ended: Ended::NotRun(why.to_owned()) }
    }
}

impl fmt::Display for Line {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let time = Clock(self.time);
        match &self.ended {
            Ended::Passed(None) => write!(out, "passed   {time}  {}", self.title),
            Ended::Passed(Some(except)) => write!(out, "passed   {time}  {}, except {except}", self.title),
            Ended::Failed(why) => write!(out, "FAILED   {time}  {}: {why}", self.title),
            Ended::NotRun(why) => write!(out, "not run  {time}  {}: {why}", self.title),
        }
    }
}

/// The steps, one a line, under a line that counts them.
pub(crate) fn render(lines: &[Line], total: Duration) -> String {
    let count = |is: fn(&Ended) -> bool| lines.iter().filter(|line| is(&line.ended)).count();
    let mut text = format!(
        "gate: {} passed, {} failed, {} not run, in {} min\n",
        count(|ended| matches!(ended, Ended::Passed(_))),
        count(|ended| matches!(ended, Ended::Failed(_))),
        count(|ended| matches!(ended, Ended::NotRun(_))),
        Clock(total).to_string().trim_start(),
    );
    for line in lines {
        text.push_str(&format!("  {line}\n"));
    }
    text
}

/// Minutes and seconds, as a stopwatch shows them.
struct Clock(Duration);

impl fmt::Display for Clock {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let seconds = self.0.as_secs_f64().round() as u64;
        write!(out, "{:>3}:{:02}", seconds / 60, seconds % 60)
    }
}

#[cfg(test)]
mod tests {
    use super::{Ended, Line, render};
    use std::time::Duration;

    #[test]
    fn the_summary_names_what_was_not_run_and_why() {
        let lines = [
            Line { title: "lints", time: Duration::from_secs(75), ended: Ended::Passed(None) },
            Line {
                title: "dependencies",
                time: Duration::from_millis(1600),
                ended: Ended::Passed(Some("advisories".to_owned())),
            },
            Line {
                title: "tests",
                time: Duration::from_secs(600),
                ended: Ended::Failed("one failed".to_owned()),
            },
            Line::not_run("packages", "an earlier step failed"),
        ];
        let expected = "gate: 2 passed, 1 failed, 1 not run, in 11:17 min\n  \
                        passed     1:15  lints\n  \
                        passed     0:02  dependencies, except advisories\n  \
                        FAILED    10:00  tests: one failed\n  \
                        not run    0:00  packages: an earlier step failed\n";
        assert_eq!(render(&lines, Duration::from_secs(677)), expected);
    }
}
