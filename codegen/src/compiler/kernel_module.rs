//! The kernel module of a set, from its materials to a validated text.

use subsurface_kernel::{Estimator, RowBinding};
use subsurface_shaders::{KERNELS, LIBRARY, Module, PASSES, PROFILES};

use crate::compose::{LinkError, Linked, link};
use crate::diagnostics::{Diagnostic, Report};
use crate::emit::{Choices, Emitted, emit, material_constant};
use crate::material::MaterialSet;
use crate::reflect::{Reflection, reflect};
use crate::validate::{Validated, validate};

use super::{DEFECT, Pass, parameter_table};

/// Entry points of the subsurface pass of every kernel: those of the fragment path, then of the compute path.
const SUBSURFACE_ENTRIES: [&str; 6] = [
    "subsurface_vertex",
    "subsurface_fragment",
    "passthrough_fragment",
    "debug_fragment",
    "classify_compute",
    "subsurface_compute",
];

/// Those of a kernel that has a stage before the last.
const FIRST_ENTRIES: [&str; 2] = ["first_fragment", "first_compute"];

/// That of a kernel whose stages read packed pixels; the compute path packs them as it classifies.
const PACK_ENTRY: &str = "pack_fragment";

const GBUFFER_ENTRIES: [&str; 2] = ["gbuffer_vertex", "gbuffer_fragment"];

/// A kernel module on its way to text.
pub(super) struct KernelModule {
    pub(super) linked: Linked,
    pub(super) emitted: Emitted,
    pub(super) validated: Validated,
    pub(super) reflection: Reflection,
    pub(super) row_binding: RowBinding,
}

impl KernelModule {
    /// Emits, links, validates and reflects; what is wrong is reported.
    pub(super) fn generate(
        set: &MaterialSet,
        choices: &Choices,
        gbuffer: bool,
        passes: &[Pass],
        header: &str,
        report: &mut Report,
    ) -> Option<Self> {
        let mut emitted = match emit(set, choices) {
            Ok(emitted) => emitted,
            Err(error) => {
                report.push(error.into());
                return None;
            }
        };
        let in_use = |module: &&Module| {
            emitted.models.iter().any(|model| module.name == format!("profiles/{}", model.stem()))
        };
        let pass_files = pass_files(choices.estimator, gbuffer);
        let modules: Vec<Module> = LIBRARY
            .iter()
            .chain(PROFILES.iter().filter(in_use))
            .chain(KERNELS)
            .chain(PASSES.iter().filter(|module| pass_files.iter().any(|file| file == module.name)))
            .copied()
            .chain(passes.iter().map(|pass| Module { name: pass.name, text: pass.text }))
            .collect();
        let row_binding = parameter_table::declare(&mut emitted.glue, &modules, set.materials.len());
        let mut roots = SUBSURFACE_ENTRIES.to_vec();
        if choices.estimator.has_two_stages() {
            roots.extend(FIRST_ENTRIES);
        }
        if choices.estimator.packs_pixels() {
            roots.push(PACK_ENTRY);
        }
        if gbuffer {
            roots.extend(GBUFFER_ENTRIES);
        }
        roots.extend(passes.iter().flat_map(|pass| pass.entry_points));
        let linked = match link(&modules, &emitted.glue, &roots, header) {
            Ok(linked) => linked,
            Err(error) => {
                report.push(link_diagnostic(set, &error));
                return None;
            }
        };
        let validated = validate(&linked, "subsurface.wgsl", report)?;
        match reflect(&validated.module, &validated.info, &linked) {
            Ok(reflection) => Some(Self { linked, emitted, validated, reflection, row_binding }),
            Err(error) => {
                report.push(Diagnostic::error(error.to_string()).help(DEFECT));
                None
            }
        }
    }
}

/// What is wrong: a material may be called what makes its constant one of the shaders'.
fn link_diagnostic(set: &MaterialSet, error: &LinkError) -> Diagnostic {
    let taken = match error {
        LinkError::DeclaredTwice { name, .. } => {
            set.materials.iter().find(|material| material_constant(&material.name) == *name)
        }
        _ => None,
    };
    match taken {
        Some(material) => Diagnostic::error(format!("the name `{}` is taken by the shaders", material.name))
            .label(
                material.span.clone(),
                format!("becomes `{}` in the generated WGSL", material_constant(&material.name)),
            )
            .help("rename the file, or give the material a `name: \"…\"` of its own"),
        None => Diagnostic::error(error.to_string()).help(DEFECT),
    }
}

/// The modules that hold the passes of one kernel: what all kernels share, and what this one adds.
fn pass_files(estimator: Estimator, gbuffer: bool) -> Vec<String> {
    let stem = estimator.stem();
    let mut files = vec![
        "passes/subsurface".to_owned(),
        "passes/subsurface_compute".to_owned(),
        "passes/subsurface_debug".to_owned(),
        "passes/subsurface_fragment".to_owned(),
        format!("passes/{stem}"),
    ];
    if estimator.has_two_stages() {
        files.push(format!("passes/{stem}_compute"));
    } else {
        files.extend(["passes/single_stage".to_owned(), "passes/single_stage_compute".to_owned()]);
    }
    if gbuffer {
        files.push("passes/gbuffer".to_owned());
    }
    files
}
