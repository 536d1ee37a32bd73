//! Material sets from a directory, with their diagnostics on standard error.

use crate::failure::Failure;
use crate::progress::Spinner;
use crate::suggestion::suggest;
use std::path::Path;
use subsurface_codegen::{Compilation, Compiler, Report};

/// The directory when none is given.
pub(super) const DEFAULT_DIRECTORY: &str = "materials";

/// Compiles the set in `directory`; prints warnings.
pub(super) fn compile(directory: &Path) -> Result<Compilation, Failure> {
    let compiler = compiler(directory)?;
    let spinner = Spinner::new(format!("compiling {}", directory.display()));
    let compilation = compiler.compile();
    drop(spinner);
    finish(compilation)
}

/// The compiler of the set in `directory`.
pub(super) fn compiler(directory: &Path) -> Result<Compiler, Failure> {
    Ok(Compiler::new(existing(directory)?))
}

/// What came out of the compiler; prints warnings.
pub(super) fn finish(compilation: Result<Compilation, Report>) -> Result<Compilation, Failure> {
    let compilation = compilation.map_err(|report| failure(&report))?;
    print_warnings(&compilation.report);
    Ok(compilation)
}

/// The failure that shows a report with errors.
pub(super) fn failure(report: &Report) -> Failure {
    Failure::reported(report.render(colour()))
}

/// Prints what a report without errors has to say.
pub(super) fn print_warnings(report: &Report) {
    if !report.is_empty() {
        eprint!("{}", report.render(colour()));
    }
}

/// Whether standard error shows colours: a terminal, and not refused (<https://no-color.org>).
pub(super) fn colour() -> bool {
    use std::io::IsTerminal as _;
    std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
}

/// `directory`, if it is one.
pub(super) fn existing(directory: &Path) -> Result<&Path, Failure> {
    if directory.is_dir() {
        return Ok(directory);
    }
    let message = format!("there is no materials directory {}", directory.display());
    Err(Failure::new(message, "name one with --materials DIR; it holds one .ron file per material"))
}

/// Number of the material `name`, or an error that lists the others.
pub(super) fn number(compilation: &Compilation, name: &str) -> Result<u32, Failure> {
    match compilation.set.index_of(name) {
        Some(index) => Ok(index as u32),
        None => Err(Failure::new(
            format!("no material is called `{name}`"),
            suggest(name, &compilation.material_names()),
        )),
    }
}
