//! Material sets from a directory, with their diagnostics on standard error.

use crate::failure::Failure;
use crate::progress::Spinner;
use crate::scene::Scene;
use crate::suggestion::suggest;
use std::path::Path;
use subsurface_codegen::{ClearMaterial, Compilation, Compiler, Report};
use subsurface_runtime as runtime;

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

/// What `--material` names.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Chosen {
    /// The number of a material that scatters.
    Scattering(u32),
    /// A material that is clear.
    Clear(runtime::ClearMaterial),
}

/// The material `name`, scattering or clear, or an error that lists the others.
pub(super) fn chosen(compilation: &Compilation, name: &str) -> Result<Chosen, Failure> {
    match compilation.set.clear.iter().find(|clear| clear.name == name) {
        Some(clear) => Ok(Chosen::Clear(on_device(clear))),
        None => match compilation.set.index_of(name) {
            Some(index) => Ok(Chosen::Scattering(index as u32)),
            None => {
                let clear = compilation.set.clear.iter().map(|clear| clear.name.clone());
                let known: Vec<String> = compilation.material_names().into_iter().chain(clear).collect();
                Err(Failure::new(format!("no material is called `{name}`"), suggest(name, &known)))
            }
        },
    }
}

fn on_device(clear: &ClearMaterial) -> runtime::ClearMaterial {
    runtime::ClearMaterial {
        absorption_per_mm: clear.absorption_per_mm.map(|absorption| absorption as f32),
        refractive_index: clear.refractive_index as f32,
        roughness: clear.roughness as f32,
        shell_thickness_mm: clear.shell_thickness_mm.map(|thickness| thickness as f32),
    }
}

/// Gives the objects of a scene their materials: by the name that the file gives, else `fallback`. The number of one that
/// is clear means nothing.
pub(crate) fn assign(scene: &mut Scene, compilation: &Compilation, fallback: Chosen) -> Vec<u32> {
    let of = |name: Option<&str>| name.and_then(|name| chosen(compilation, name).ok());
    let assigned = scene.objects.iter_mut().map(|object| {
        let surface = &mut object.surface;
        let named = of(surface.material_name.as_deref());
        // What the file itself has clear stays so, unless it has the name of a material of the set.
        match named.or((surface.clear.is_none()).then_some(fallback)) {
            Some(Chosen::Scattering(number)) => {
                surface.clear = None;
                number
            }
            Some(Chosen::Clear(clear)) => {
                surface.clear = Some(clear);
                0
            }
            None => 0,
        }
    });
    assigned.collect()
}

/// Number of the material `name`, or an error that lists the others.
pub(super) fn number(compilation: &Compilation, name: &str) -> Result<u32, Failure> {
    match compilation.set.index_of(name) {
        Some(index) => Ok(index as u32),
        None if compilation.set.clear.iter().any(|clear| clear.name == name) => Err(Failure::new(
            format!("`{name}` is clear: it does not scatter"),
            format!("name a material that does; {}", suggest("", &compilation.material_names())),
        )),
        None => Err(Failure::new(
            format!("no material is called `{name}`"),
            suggest(name, &compilation.material_names()),
        )),
    }
}
