//! A table of what a paper prints and what is measured.

use std::fmt::Write;

/// Printed and measured values, one below the other, and what to think of each pair.
pub(crate) struct Comparison {
    title: String,
    rows: Vec<[String; 4]>,
    failures: Vec<String>,
}

impl Comparison {
    pub(crate) fn new(title: &str) -> Comparison {
        Comparison { title: title.to_owned(), rows: Vec::new(), failures: Vec::new() }
    }

    /// The printed number is right, within `tolerance`.
    pub(crate) fn agrees(&mut self, what: &str, printed: f64, measured: f64, tolerance: f64) {
        let agrees = (measured - printed).abs() <= tolerance;
        self.statement(what, &number(printed), &number(measured), agrees);
    }

    /// The printed number is not right, for the reason given. What is measured instead stays at `expected` within
    /// `tolerance`, which must tell the two apart.
    pub(crate) fn differs(
        &mut self,
        what: &str,
        printed: f64,
        measured: f64,
        [expected, tolerance]: [f64; 2],
        reason: &str,
    ) {
        let told_apart = (expected - printed).abs() > tolerance;
        let in_place = (measured - expected).abs() <= tolerance;
        self.contradiction(what, &number(printed), &number(measured), told_apart && in_place, reason);
    }

    /// What the paper says in words is so.
    pub(crate) fn statement(&mut self, what: &str, printed: &str, measured: &str, is_so: bool) {
        self.row(what, printed, measured, "yes", is_so);
    }

    /// What the paper says is not so, for the reason given. `in_place` says whether it is so in the way it was.
    pub(crate) fn contradiction(
        &mut self,
        what: &str,
        printed: &str,
        measured: &str,
        in_place: bool,
        reason: &str,
    ) {
        self.row(what, printed, measured, &format!("NO: {reason}"), in_place);
    }

    /// Prints the table, then fails if a row did.
    #[allow(clippy::print_stdout, reason = "the table is what this suite is for")]
    pub(crate) fn finish(self) {
        let head = [self.title.as_str(), "printed", "measured", "verdict"];
        let mut widths = head.map(|cell| cell.chars().count());
        for row in &self.rows {
            for (width, cell) in widths.iter_mut().zip(row) {
                *width = cell.chars().count().max(*width);
            }
        }
        let line = |cells: [&str; 4]| {
            let [what, printed, measured, verdict] = cells;
            let [w0, w1, w2, _] = widths;
            format!("{what:w0$} | {printed:>w1$} | {measured:>w2$} | {verdict}\n")
        };
        let mut text = String::from("\n");
        text.push_str(&line(head));
        let rule = widths.map(|width| "-".repeat(width));
        writeln!(text, "{}", rule.join("-|-")).unwrap();
        for [what, printed, measured, verdict] in &self.rows {
            text.push_str(&line([what, printed, measured, verdict]));
        }
        // One call, so that tables of tests that run at the same time do not mix.
        println!("{text}");
        assert!(self.failures.is_empty(), "{}:\n{}", self.title, self.failures.join("\n"));
    }

    fn row(&mut self, what: &str, printed: &str, measured: &str, verdict: &str, passed: bool) {
        let verdict = if passed { verdict.to_owned() } else { format!("FAILED, was: {verdict}") };
        if !passed {
            self.failures.push(format!("{what}: printed {printed}, measured {measured}. {verdict}"));
        }
        self.rows.push([what.to_owned(), printed.to_owned(), measured.to_owned(), verdict]);
    }
}

/// Four digits, with an exponent where they would be zeros. What is only rounding differs between machines.
pub(crate) fn number(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && size < 1e-12 {
        return "< 1e-12".to_owned();
    }
    if size != 0.0 && !(1e-3..1e5).contains(&size) {
        return format!("{value:.2e}");
    }
    let digits_before = if size >= 1.0 { size.log10().floor() as usize + 1 } else { 1 };
    let text = format!("{value:.*}", 5_usize.saturating_sub(digits_before));
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}
