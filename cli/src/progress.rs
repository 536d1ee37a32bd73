//! Progress on long work, on standard error; nothing where that is no terminal.

use indicatif::{HumanCount, ProgressBar, ProgressState, ProgressStyle};
use std::fmt;
use std::time::Duration;

/// A spinner that says what is being done; it vanishes when dropped.
#[derive(Debug)]
pub struct Spinner(ProgressBar);

impl Spinner {
    /// Starts to spin.
    pub fn new(what: impl Into<String>) -> Self {
        let bar = ProgressBar::new_spinner();
        if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} [{elapsed}]") {
            bar.set_style(style);
        }
        bar.set_message(what.into());
        bar.enable_steady_tick(Duration::from_millis(100));
        Self(bar)
    }

    /// Says what is being done now.
    pub fn say(&self, what: impl Into<String>) {
        self.0.set_message(what.into());
    }
}

impl Drop for Spinner {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

/// A bar over `count` steps of one kind, for example tiles of a contact sheet.
pub fn bar(count: u64, what: impl Into<String>) -> ProgressBar {
    let bar = ProgressBar::new(count);
    if let Ok(style) = ProgressStyle::with_template("{msg} {wide_bar} {pos}/{len} [{elapsed}]") {
        bar.set_style(style);
    }
    bar.with_message(what.into())
}

/// A bar over photons, with rate and time left; its message is for the estimate. `is_quiet` hides it.
pub fn photons(goal: u64, already: u64, is_quiet: bool) -> ProgressBar {
    if is_quiet {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(goal);
    let template = "{wide_bar} {human_pos}/{human_len} photons  {rate}  {eta} left  {msg}";
    if let Ok(style) = ProgressStyle::with_template(template) {
        // The one that comes with the bar has four digits behind the point.
        let rate = |state: &ProgressState, text: &mut dyn fmt::Write| {
            let _ = write!(text, "{}/s", HumanCount(state.per_sec() as u64));
        };
        bar.set_style(style.with_key("rate", rate));
    }
    // Photons of earlier runs are no work of this one: neither rate nor time left should count them.
    bar.set_position(already);
    bar.reset_eta();
    bar
}
