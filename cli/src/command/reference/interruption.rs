//! Ctrl-C during a long simulation.

use crate::failure::Failure;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether the user wants to stop. The second Ctrl-C ends the program at once.
#[derive(Clone, Debug)]
pub(super) struct Interruption(Arc<AtomicBool>);

impl Interruption {
    /// Listens from now on.
    pub(super) fn listen() -> Result<Self, Failure> {
        let wanted = Arc::new(AtomicBool::new(false));
        let handler = Arc::clone(&wanted);
        ctrlc::set_handler(move || {
            if handler.swap(true, Ordering::Relaxed) {
                std::process::exit(130);
            }
        })
        .map_err(|reason| {
            Failure::new(
                format!("cannot listen to Ctrl-C: {reason}"),
                "start the command from another terminal",
            )
        })?;
        Ok(Self(wanted))
    }

    /// Whether Ctrl-C was pressed.
    pub(super) fn is_wanted(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// A pool of so many threads; all cores for none.
pub(super) fn pool(threads: Option<usize>) -> Result<rayon::ThreadPool, Failure> {
    rayon::ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0)).build().map_err(|reason| {
        Failure::new(format!("cannot start the threads: {reason}"), "ask for fewer with --threads")
    })
}
