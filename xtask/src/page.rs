//! Pages of `docs`: prose from a file of `xtask`, numbers and figures from the commands that stand in it.
//!
//! A line of the prose that begins with `@` is a command of `subsurface`:
//!
//! - `@figure NAME.svg "caption" = ARGUMENTS` runs `subsurface ARGUMENTS --out FIGURES/NAME.svg`, and shows the figure, its
//!   caption and the command;
//! - `@image NAME.png "caption" = ARGUMENTS` does the same with `--sheet`;
//! - `@sheet NAME.png "caption" = ARGUMENTS` also shows what the command prints;
//! - `@output = ARGUMENTS` shows the command and what it prints;
//! - `@run = ARGUMENTS` shows the command alone;
//! - `@published = FILTER` shows the tables that the conformance suite's tests of that name print.
//!
//! Commands run in order, so that one may use the files of another; those lie in `target/NAME`, NAME being the page's.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use crate::driver::Build;
use crate::shell::{self, Failure, cargo};

/// A page of `docs`.
pub(crate) struct Page {
    /// Its name, which is that of its prose, its figures' folder and its command.
    name: &'static str,
    /// Whether its numbers are the same on every machine, so that a check can compare them.
    is_exact: bool,
}

/// How far the profiles are from ground truth.
pub(crate) const ACCURACY: Page = Page { name: "accuracy", is_exact: true };

/// How far pictures are from a path tracer's. Graphics drivers differ in the last digits.
pub(crate) const PICTURES: Page = Page { name: "pictures", is_exact: false };

/// A figure in a README should load at once.
const LARGEST_FIGURE: usize = 40 * 1024;

/// The same of a sheet of pictures.
const LARGEST_SHEET: usize = 600 * 1024;

/// A file of the page: its path from the root, and its text.
type Written = (PathBuf, Vec<u8>);

impl Page {
    /// Writes the page, or with `--check` compares it.
    pub(crate) fn run_command(&self, arguments: &[String]) -> Result<(), Failure> {
        let is_check = match arguments {
            [] => false,
            [flag] if flag == "--check" && self.is_exact => true,
            _ => {
                let flag = if self.is_exact { " [--check]" } else { "" };
                return Err(Failure(format!("usage: cargo xtask {}{flag}", self.name)));
            }
        };
        Build::Test.run()?;
        let scratch = shell::root().join(self.scratch());
        // Runs that are there would be gone on with.
        let _ = std::fs::remove_dir_all(&scratch);
        make_folder(&scratch)?;
        let files = self.generate(&read(&shell::root().join(self.prose()))?)?;
        if is_check { self.check(&files) } else { self.write(&files) }
    }

    fn page(&self) -> String {
        format!("docs/{}.md", self.name)
    }

    fn figures(&self) -> String {
        format!("docs/{}", self.name)
    }

    fn prose(&self) -> String {
        format!("xtask/{}.md", self.name)
    }

    /// Files that commands pass on to each other.
    fn scratch(&self) -> String {
        format!("target/{}", self.name)
    }

    /// The page and its figures.
    fn generate(&self, prose: &str) -> Result<Vec<Written>, Failure> {
        let mut files = Vec::new();
        let mut page = String::new();
        for (index, line) in prose.lines().enumerate() {
            let Some(directive) = line.strip_prefix('@') else {
                page.push_str(line);
                page.push('\n');
                continue;
            };
            let malformed = || Failure(format!("{}:{}: cannot read `{line}`", self.prose(), index + 1));
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
                Some((kind @ ("figure" | "image" | "sheet"), rest)) => {
                    let (name, caption) = rest.split_once(' ').ok_or_else(malformed)?;
                    let (figure, text) = self.figure(kind, name, caption.trim_matches('"'), arguments)?;
                    page.push_str(&text);
                    files.push((Path::new(&self.figures()).join(name), figure));
                }
                _ => return Err(malformed()),
            }
        }
        files.push((PathBuf::from(self.page()), page.into_bytes()));
        Ok(files)
    }

    /// A figure, and what the page has of it.
    fn figure(
        &self,
        kind: &str,
        name: &str,
        caption: &str,
        arguments: &str,
    ) -> Result<(Vec<u8>, String), Failure> {
        let (flag, largest) =
            if kind == "figure" { ("--out", LARGEST_FIGURE) } else { ("--sheet", LARGEST_SHEET) };
        let printed = subsurface(&format!("{arguments} {flag} {}/{name}", self.scratch()))?;
        let path = shell::root().join(self.scratch()).join(name);
        let figure = std::fs::read(&path)
            .map_err(|error| Failure(format!("cannot read {}: {error}", path.display())))?;
        if figure.len() > largest {
            return Err(Failure(format!("{name} has {} bytes, more than {largest}", figure.len())));
        }
        let command = format!("subsurface {arguments} {flag} {}/{name}", self.figures());
        let image = format!("![{caption}]({}/{name})\n\n*{caption}*\n", self.name);
        let text = if kind != "sheet" {
            format!("{image}\n```sh\n{command}\n```\n")
        } else {
            // The last line names the sheet.
            let tables = printed.trim_end().rsplit_once('\n').map_or("", |(tables, _)| tables);
            format!("{image}\n```text\n$ {command}\n{}\n```\n", tables.trim_end())
        };
        Ok((figure, text))
    }

    fn write(&self, files: &[Written]) -> Result<(), Failure> {
        let figures = shell::root().join(self.figures());
        // Figures that the page no longer has should go.
        let _ = std::fs::remove_dir_all(&figures);
        make_folder(&figures)?;
        for (path, bytes) in files {
            std::fs::write(shell::root().join(path), bytes)
                .map_err(|error| Failure(format!("cannot write {}: {error}", path.display())))?;
            println!("{}", path.display());
        }
        Ok(())
    }

    fn check(&self, files: &[Written]) -> Result<(), Failure> {
        let stale: Vec<String> = files
            .iter()
            .filter(|(path, bytes)| std::fs::read(shell::root().join(path)).ok().as_ref() != Some(bytes))
            .map(|(path, _)| path.display().to_string())
            .collect();
        if stale.is_empty() {
            println!("{} is what its commands give", self.page());
            return Ok(());
        }
        Err(Failure(format!(
            "not what the commands give: {}\n  = help: run `cargo xtask {}`, then look at `git diff docs`",
            stale.join(", "),
            self.name
        )))
    }
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

pub(crate) fn read(path: &Path) -> Result<String, Failure> {
    std::fs::read_to_string(path).map_err(|error| Failure(format!("cannot read {}: {error}", path.display())))
}

fn make_folder(path: &Path) -> Result<(), Failure> {
    std::fs::create_dir_all(path)
        .map_err(|error| Failure(format!("cannot make the folder {}: {error}", path.display())))
}
