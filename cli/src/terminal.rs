//! Standard output, which may be closed early: `subsurface check … | head` is no error.

#![allow(clippy::print_stderr, reason = "the last word before the program ends")]

use std::fmt::Arguments;
use std::io::{ErrorKind, Write as _};

/// Writes a line to standard output.
///
/// A reader that went away is ignored, since files may still have to be written; any other failure ends the program.
pub fn say(line: Arguments<'_>) {
    let mut output = std::io::stdout().lock();
    match writeln!(output, "{line}").and_then(|()| output.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            eprintln!("error: cannot write to standard output: {error}");
            std::process::exit(1);
        }
        _ => {}
    }
}

/// [`say`] with the arguments of `println!`.
#[macro_export]
macro_rules! say {
    ($($argument:tt)*) => { $crate::terminal::say(format_args!($($argument)*)) };
}
