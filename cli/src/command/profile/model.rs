//! The model that an argument names.

use crate::command::material_set;
use crate::failure::Failure;
use crate::suggestion::suggest;
use std::path::Path;
use subsurface_codegen::{load_profile, load_profile_file};
use subsurface_profile::Model;

/// The model that `name` names: a profile file (.ron), a stem in `materials`/profiles, or a built-in one.
pub(super) fn load(name: &str, materials: &Path) -> Result<Model, Failure> {
    let path = Path::new(name);
    let is_file = path.extension().is_some_and(|extension| extension == "ron");
    let in_directory = materials.join("profiles").join(format!("{name}.ron"));
    let loaded = if is_file {
        load_profile_file(path)
    } else if in_directory.is_file() {
        load_profile(materials, name)
    } else {
        return Model::published(name).ok_or_else(|| unknown(name, materials));
    };
    match loaded.profile {
        Some(resolved) if !loaded.report.has_errors() => {
            material_set::print_warnings(&loaded.report);
            Ok(resolved.model)
        }
        _ => Err(material_set::failure(&loaded.report)),
    }
}

/// All names that need no file path, sorted.
pub(super) fn known(materials: &Path) -> Vec<String> {
    let mut known: Vec<String> = Model::PUBLISHED.iter().map(|stem| (*stem).to_owned()).collect();
    let files = std::fs::read_dir(materials.join("profiles")).into_iter().flatten().flatten();
    let stems = files.filter_map(|entry| {
        let path = entry.path();
        let is_profile = path.extension().is_some_and(|extension| extension == "ron");
        is_profile.then(|| path.file_stem().map(|stem| stem.to_string_lossy().into_owned())).flatten()
    });
    known.extend(stems);
    known.sort();
    known.dedup();
    known
}

fn unknown(name: &str, materials: &Path) -> Failure {
    Failure::new(format!("no profile is called `{name}`"), suggest(name, &known(materials)))
}
