//! `docs/accuracy.md`: prose from `xtask/accuracy.md`, numbers and figures from the commands that stand in it.
//!
//! A line of the prose that begins with `@` is a command of `subsurface`:
//!
//! - `@figure NAME.svg "caption" = ARGUMENTS` runs `subsurface ARGUMENTS --out docs/accuracy/NAME.svg`, and shows the
//!   figure, its caption and the command;
//! - `@output = ARGUMENTS` shows the command and what it prints;
//! - `@run = ARGUMENTS` shows the command alone;
//! - `@published = FILTER` shows the tables that the conformance suite's tests of that name print.
//!
//! Commands run in order, so that one may use the files of another; those lie in `target/accuracy`.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use crate::driver::Build;
use crate::shell::{self, Failure, cargo};

/// Where the page and its figures are, from the root.
const PAGE: &str = "docs/accuracy.md";
const FIGURES: &str = "docs/accuracy";

/// What the prose is made from.
const PROSE: &str = "xtask/accuracy.md";

/// Files that commands pass on to each other.
const SCRATCH: &str = "target/accuracy";

/// A figure in a README should load at once.
const LARGEST_FIGURE: usize = 40 * 1024;

/// A file of the page: its path from the root, and its text.
type Written = (PathBuf, String);

pub(crate) fn run_command(arguments: &[String]) -> Result<(), Failure> {
    let is_check = match arguments {
        [] => false,
        [flag] if flag == "--check" => true,
        _ => return Err(Failure("usage: cargo xtask accuracy [--check]".into())),
    };
    Build::Test.run()?;
    let scratch = shell::root().join(SCRATCH);
    // Runs that are there would be gone on with.
    let _ = std::fs::remove_dir_all(&scratch);
    make_folder(&scratch)?;
    let files = generate(&read(&shell::root().join(PROSE))?)?;
    if is_check { check(&files) } else { write(&files) }
}

/// The page and its figures.
fn generate(prose: &str) -> Result<Vec<Written>, Failure> {
    let mut files = Vec::new();
    let mut page = String::new();
    for (index, line) in prose.lines().enumerate() {
        let Some(directive) = line.strip_prefix('@') else {
            page.push_str(line);
            page.push('\n');
            continue;
        };
        let malformed = || Failure(format!("{PROSE}:{}: cannot read `{line}`", index + 1));
        let (head, arguments) = directive.split_once(" = ").ok_or_else(malformed)?;
        match head.split_once(' ') {
            None if head == "output" => {
                let printed = subsurface(arguments)?;
                let _ = write!(page, "```text\n$ subsurface {arguments}\n{}\n```\n", printed.trim_end());
            }
            None if head == "run" => {
                subsurface(arguments)?;
                let _ = write!(page, "```sh\nsubsurface {arguments}\n```\n");
            }
            None if head == "published" => page.push_str(&published(arguments)?),
            Some(("figure", rest)) => {
                let (name, caption) = rest.split_once(' ').ok_or_else(malformed)?;
                let caption = caption.trim_matches('"');
                subsurface(&format!("{arguments} --out {SCRATCH}/{name}"))?;
                let svg = read(&shell::root().join(SCRATCH).join(name))?;
                if svg.len() > LARGEST_FIGURE {
                    return Err(Failure(format!(
                        "{name} has {} bytes, more than {LARGEST_FIGURE}",
                        svg.len()
                    )));
                }
                files.push((Path::new(FIGURES).join(name), svg));
                let _ = write!(
                    page,
                    "![{caption}](accuracy/{name})\n\n*{caption}*\n\n```sh\nsubsurface {arguments} --out \
                     {FIGURES}/{name}\n```\n"
                );
            }
            _ => return Err(malformed()),
        }
    }
    files.push((PathBuf::from(PAGE), page));
    Ok(files)
}

/// Runs the command line; what it prints.
pub(crate) fn subsurface(arguments: &str) -> Result<String, Failure> {
    let mut program = Build::Test.program();
    let output = program.args(arguments.split_whitespace()).output().map_err(|error| {
        Failure(format!("cannot start {}: {error}", Path::new(program.get_program()).display()))
    })?;
    if output.status.success() {
        return String::from_utf8(output.stdout)
            .map_err(|_| Failure(format!("`subsurface {arguments}` printed no text")));
    }
    let complaint = String::from_utf8_lossy(&output.stderr);
    Err(Failure(format!("`subsurface {arguments}` ended with {}\n{complaint}", output.status)))
}

/// The command of the conformance suite's tests whose name has `filter` in it, and the tables they print.
fn published(filter: &str) -> Result<String, Failure> {
    let arguments = format!("test --workspace --test conformance -- --nocapture --test-threads 1 {filter}");
    let output = cargo()
        .args(arguments.split_whitespace())
        .output()
        .map_err(|error| Failure(format!("cannot start cargo: {error}")))?;
    let printed = String::from_utf8_lossy(&output.stdout);
    if !output.status.success() {
        let complaint = String::from_utf8_lossy(&output.stderr);
        return Err(Failure(format!(
            "`cargo {arguments}` ended with {}\n{printed}{complaint}",
            output.status
        )));
    }
    let mut text = format!("```sh\ncargo {arguments}\n```\n");
    let mut was_row = false;
    for line in printed.lines() {
        let is_row = line.contains(" | ") || line.contains("-|-");
        if is_row && !was_row {
            text.push('\n');
        }
        if is_row {
            let _ = writeln!(text, "| {} |", line.replace("-|-", " | "));
        }
        was_row = is_row;
    }
    Ok(text)
}

fn write(files: &[Written]) -> Result<(), Failure> {
    let figures = shell::root().join(FIGURES);
    // Figures that the page no longer has should go.
    let _ = std::fs::remove_dir_all(&figures);
    make_folder(&figures)?;
    for (path, text) in files {
        std::fs::write(shell::root().join(path), text)
            .map_err(|error| Failure(format!("cannot write {}: {error}", path.display())))?;
        println!("{}", path.display());
    }
    Ok(())
}

fn check(files: &[Written]) -> Result<(), Failure> {
    let stale: Vec<String> = files
        .iter()
        .filter(|(path, text)| read(&shell::root().join(path)).ok().as_ref() != Some(text))
        .map(|(path, _)| path.display().to_string())
        .collect();
    if stale.is_empty() {
        println!("{PAGE} is what its commands give");
        return Ok(());
    }
    Err(Failure(format!(
        "not what the commands give: {}\n  = help: run `cargo xtask accuracy`, then look at `git diff docs`",
        stale.join(", ")
    )))
}

pub(crate) fn read(path: &Path) -> Result<String, Failure> {
    std::fs::read_to_string(path).map_err(|error| Failure(format!("cannot read {}: {error}", path.display())))
}

fn make_folder(path: &Path) -> Result<(), Failure> {
    std::fs::create_dir_all(path)
        .map_err(|error| Failure(format!("cannot make the folder {}: {error}", path.display())))
}
