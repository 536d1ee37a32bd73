//! The tables in `README.md` and `materials/README.md` that the program knows better: what stands between two markers is
//! what a command prints.
//!
//! `<!-- subsurface profile list --markdown -->` begins a table, `<!-- end -->` ends it.

use std::path::Path;

use crate::driver::Build;
use crate::page::{read, subsurface};
use crate::shell::{self, Failure};

/// The pages, from the root.
const PAGES: [&str; 2] = ["README.md", "materials/README.md"];

const BEGIN: &str = "<!-- subsurface ";
const END: &str = "<!-- end -->";

pub(crate) fn run_command(arguments: &[String]) -> Result<(), Failure> {
    let is_check = match arguments {
        [] => false,
        [flag] if flag == "--check" => true,
        _ => return Err(Failure("usage: cargo xtask tables [--check]".into())),
    };
    Build::Test.run()?;
    let mut stale = Vec::new();
    for page in PAGES {
        let path = shell::root().join(page);
        let text = read(&path)?;
        let fresh = generate(page, &text)?;
        if fresh == text {
            continue;
        }
        if is_check {
            stale.push(page);
        } else {
            std::fs::write(&path, fresh)
                .map_err(|error| Failure(format!("cannot write {}: {error}", path.display())))?;
            println!("{page}");
        }
    }
    if stale.is_empty() {
        return Ok(());
    }
    Err(Failure(format!(
        "the tables are not what the commands give: {}\n  = help: run `cargo xtask tables`, then look at `git diff`",
        stale.join(", ")
    )))
}

/// The page with what its commands print now.
fn generate(page: &str, text: &str) -> Result<String, Failure> {
    let mut fresh = String::new();
    let mut lines = text.lines().enumerate();
    while let Some((number, line)) = lines.next() {
        fresh.push_str(line);
        fresh.push('\n');
        let Some(arguments) = line.strip_prefix(BEGIN).and_then(|rest| rest.strip_suffix(" -->")) else {
            continue;
        };
        if !lines.any(|(_, line)| line == END) {
            return Err(Failure(format!(
                "{}:{}: `{line}` has no `{END}` after it",
                Path::new(page).display(),
                number + 1
            )));
        }
        fresh.push_str(subsurface(arguments)?.trim_end());
        fresh.push('\n');
        fresh.push_str(END);
        fresh.push('\n');
    }
    Ok(fresh)
}
