//! The kernel module of a set, from its materials to a validated text.

use subsurface_kernel::{DebugView, Estimator, RowBinding};
use subsurface_shaders::Module;

use crate::compose::{Files, LinkError, Linked, link};
use crate::constants::shared_constants;
use crate::diagnostics::Diagnostic;
use crate::emit::{Choices, Emitted, emit, material_constant};
use crate::material::MaterialSet;
use crate::no_profile::no_profile;
use crate::reflect::{Reflection, reflect};
use crate::report::Report;
use crate::validate::{Validated, validate};

use super::shader_files::ShaderFiles;
use super::{DEFECT, Pass, parameter_table};

const GBUFFER_ENTRIES: [&str; 2] = ["gbuffer_vertex", "gbuffer_fragment"];

/// What a module holds beside the subsurface pass, and where it comes from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wanted<'a> {
    pub(super) shaders: &'a ShaderFiles,
    pub(super) gbuffer: bool,
    pub(super) debug_views: bool,
    /// Passes of the caller's own.
    pub(super) passes: &'a [Pass],
}

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
        wanted: Wanted<'_>,
        header: &str,
        report: &mut Report,
    ) -> Option<Self> {
        let mut emitted = match emit(set, choices) {
            Ok(emitted) => emitted,
            Err(error) => {
                report.push(no_profile(set, &error));
                return None;
            }
        };
        let in_use = |module: &&Module| {
            emitted.models.iter().any(|model| module.name == format!("profiles/{}", model.description().stem))
        };
        let ShaderFiles { rooms, profiles, .. } = wanted.shaders;
        let rooms: Vec<Module> =
            rooms.iter().chain(profiles.iter().filter(in_use)).copied().chain(shared_constants()).collect();
        let of_house = pass_files(choices.estimator, wanted);
        let guests: Vec<Module> =
            wanted.passes.iter().map(|pass| Module { name: pass.name, text: pass.text }).collect();
        let row_binding = parameter_table::declare(&mut emitted.glue, &rooms, set.materials.len());
        let mut roots: Vec<&str> = choices.estimator.entry_points().collect();
        if wanted.debug_views {
            roots.push(DebugView::ENTRY_POINT);
        }
        if wanted.gbuffer {
            roots.extend(GBUFFER_ENTRIES);
        }
        roots.extend(wanted.passes.iter().flat_map(|pass| pass.entry_points));
        let files = Files { rooms: &rooms, passes: &of_house, guests: &guests };
        let linked = match link(files, &emitted.glue, &roots, header) {
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
        None if matches!(error, LinkError::OfAGuest { .. }) => Diagnostic::error(error.to_string())
            .help("no material file is to blame: change the text that `Compiler::with_pass` got"),
        None => Diagnostic::error(error.to_string()).help(DEFECT),
    }
}

/// The passes of one kernel: what all kernels share, and what this one adds. Bindings come before the entry points whose
/// files need them.
fn pass_files(estimator: Estimator, wanted: Wanted<'_>) -> Vec<Module> {
    let stem = estimator.stem();
    let mut stems = vec!["subsurface", "subsurface_fragment", stem];
    let compute = format!("{stem}_compute");
    if !estimator.has_two_stages() {
        stems.push("single_stage");
    }
    stems.push("subsurface_compute");
    // A kernel that packs pixels does so as it classifies them.
    if !estimator.packs_pixels() {
        stems.push("classify_compute");
    }
    stems.push(if estimator.has_two_stages() { &compute } else { "single_stage_compute" });
    if wanted.debug_views {
        stems.push("subsurface_debug");
    }
    if wanted.gbuffer {
        stems.push("gbuffer");
    }
    let passes = &wanted.shaders.passes;
    let pass = |stem: &&str| passes.iter().find(|module| module.name.strip_prefix("passes/") == Some(stem));
    stems.iter().filter_map(pass).copied().collect()
}

#[cfg(test)]
mod tests;
