//! Reports as tables for terminals.

use super::goal::{CLOSER_DB, LARGEST_SHARE};
use super::outcome::{AtPsnr, OURS, Outcome, outcomes};
use super::report::{Report, path_name};
use super::{Contender as _, KernelContender, WITNESS};
use crate::table::{Align, Table};
use std::fmt::Write as _;

/// One report: a line per contender, those that did not enter below.
pub fn scores(report: &Report) -> String {
    let mut table = Table::new([
        ("kernel", Align::Left),
        ("taps", Align::Right),
        ("RMSE", Align::Right),
        ("PSNR dB", Align::Right),
        ("ms", Align::Right),
        ("time ratio", Align::Right),
        ("path", Align::Left),
    ]);
    for line in &report.lines {
        let time = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), |value| format!("{value:.3}"));
        table.row([
            line.family.clone(),
            line.taps.to_string(),
            format!("{:.3e}", line.score.rmse),
            format!("{:.2}", line.score.psnr_db),
            time(line.time.map(|time| time.milliseconds)),
            time(line.time.map(|time| time.ratio)),
            path_name(line.path).to_owned(),
        ]);
    }
    let mut text = format!("{}\n{table}", report.title());
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "dense, the reference, took {:.1} ms once, its pipeline included; {} {} agrees to {:.1} dB",
        report.dense_ms,
        KernelContender { estimator: WITNESS }.family(),
        WITNESS.taps(),
        report.witness_db
    );
    if report.is_reference_doubtful() {
        text.push_str(
            "warning: the reference does not hold, so the errors above say nothing. This driver may end long loops: \
             try another adapter, smaller --footprints, or Gaussian sums of at most 32 terms\n",
        );
    }
    for declined in &report.declined {
        let _ = writeln!(text, "{} {} left out: {}", declined.family, declined.taps, declined.reason);
    }
    text
}

/// What is said of a goal; nothing where there is no reference to hold the errors against.
fn verdict(report: &Report, is_met: bool) -> &'static str {
    match (report.is_reference_doubtful(), is_met) {
        (true, _) => "the reference does not hold",
        (false, true) => "met",
        (false, false) => "not met",
    }
}

/// The goals of all reports, a line for each rival; empty where none has a goal.
pub fn goals(reports: &[Report]) -> String {
    let mut table = Table::new([
        ("case", Align::Left),
        ("profile", Align::Left),
        ("rival", Align::Left),
        ("its dB", Align::Right),
        ("its time", Align::Right),
        ("share of its time", Align::Right),
        ("dB more", Align::Right),
        ("goal", Align::Left),
    ]);
    let mut is_empty = true;
    for report in reports {
        for (rival, outcome) in outcomes(report) {
            is_empty = false;
            let (share, gain, goal) = match &outcome {
                Outcome::Faster(at) => {
                    let share = match at {
                        AtPsnr::Ratio(share) => format!("{share:.3}"),
                        AtPsnr::AtMost(share) => format!("≤ {share:.3}"),
                        AtPsnr::OutOfReach(best_db) => format!("best is {best_db:.1} dB"),
                    };
                    (share, "same".to_owned(), format!("≤ {LARGEST_SHARE}"))
                }
                Outcome::FasterAndCloser(best) => {
                    let goal = format!("< 1, ≥ {CLOSER_DB} dB");
                    match best {
                        Some((share, gain)) => (format!("{share:.3}"), format!("{gain:+.1}"), goal),
                        None => ("none is faster".to_owned(), "–".to_owned(), goal),
                    }
                }
            };
            table.row([
                report.case.clone(),
                report.profile.clone(),
                format!("{} {}", rival.family, rival.taps),
                format!("{:.2}", rival.score.psnr_db),
                rival.time.map_or_else(String::new, |time| format!("{:.3}", time.ratio)),
                share,
                gain,
                format!("{goal}: {}", verdict(report, outcome.is_met())),
            ]);
        }
    }
    if is_empty { String::new() } else { format!("{OURS} against its rivals\n{table}") }
}
