//! The house's own files keep to their headers, all of them, and the rooms to their order.

use super::*;
use crate::compiler::Compiler;
use crate::constants::shared_constants;
use crate::emit::{Choices, emit};
use subsurface_kernel::{Estimator, OutputFormat};
use subsurface_profile::ModelKind;
use subsurface_shaders::{GATHER, KERNELS, LIBRARY, LIGHT, PASSES, PROFILES, modules};

/// The glue of a set that uses every model.
fn glue_of_all(estimator: Estimator) -> Glue {
    let material = |profile: &str| {
        format!(
            "Material(profile: {profile}, mean_free_path_mm: (1.3, 0.95, 0.67), surface_albedo: (0.8, 0.6, 0.4))"
        )
    };
    let table = ("my_table.csv".to_owned(), "r_lo,r_hi,radial_reflectance\n0,1,0.1\n1,2,0.1\n".to_owned());
    let examples = ModelKind::ALL.iter().map(|kind| kind.description());
    let files = examples
        .map(|description| (format!("{}_one.ron", description.stem), material(description.example)))
        .chain([table]);
    let set = Compiler::from_memory(files).load().set.expect("the set is sound");
    let choices = Choices { estimator, rejection: set.rejection, output_format: OutputFormat::default() };
    let mut emitted = emit(&set, &choices).expect("every model has a shader");
    assert_eq!(emitted.models.len(), PROFILES.len(), "a model is missing here");
    let rows = set.materials.len();
    let table = format!("\nvar<private> material_table: array<SubsurfaceMaterial, {rows}>;\n");
    emitted.glue.text.push_str(&table);
    emitted.glue
}

/// Passes that are modules of their own.
const OWN_MODULES: [&str; 3] = ["passes/composite", "passes/distance", "passes/shadow"];

/// Whether a file is a part of a module with this estimator: those of other estimators' passes bear the same names.
fn is_of(estimator: Estimator, file: &Module) -> bool {
    let others = Estimator::ALL.map(Estimator::stem).into_iter().filter(|stem| *stem != estimator.stem());
    let single = ["passes/single_stage", "passes/single_stage_compute"];
    let is_others = others
        .into_iter()
        .any(|stem| file.name == format!("passes/{stem}") || file.name == format!("passes/{stem}_compute"));
    // A kernel that packs pixels does so as it classifies them.
    let is_of_no_packing = estimator.packs_pixels() && file.name == "passes/classify_compute";
    let is_of_one_stage = estimator.has_two_stages() && single.contains(&file.name);
    !(is_others || is_of_no_packing || is_of_one_stage || OWN_MODULES.contains(&file.name))
}

/// Checks every file, not only what passes reach.
fn check(files: Files<'_>, glue: &Glue, may_be_open: &[&str]) {
    let parts = parts(files, glue).unwrap_or_else(|error| panic!("{error}"));
    let mut declared: Declared<'_, '_> = BTreeMap::new();
    for (index, part) in parts.iter().enumerate() {
        for item in &part.items {
            let twice = declared.insert(item.name, (index, item));
            assert!(twice.is_none(), "{} stands twice", item.name);
        }
    }
    let all: Vec<usize> = (0..parts.len()).collect();
    let order = order(&parts, &declared, &[], &all).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(order.len(), parts.len());
    for part in &parts {
        let open = part.header.needs.iter().find(|need| !declared.contains_key(**need));
        assert!(open.is_none_or(|need| may_be_open.contains(need)), "{} needs {open:?}", part.name);
    }
}

#[test]
fn every_file_keeps_to_its_header() {
    let rooms: Vec<Module> = [LIBRARY, PROFILES, GATHER, KERNELS, LIGHT]
        .into_iter()
        .flatten()
        .copied()
        .chain(shared_constants())
        .collect();
    for estimator in Estimator::ALL {
        let passes: Vec<Module> = PASSES.iter().filter(|file| is_of(estimator, file)).copied().collect();
        // What the passes of one stage declare for their kernels is open where there are two stages.
        let may_be_open: &[&str] = if estimator.has_two_stages() { &["gather_at"] } else { &[] };
        let files = Files { rooms: &rooms, passes: &passes, guests: &[] };
        check(files, &glue_of_all(estimator), may_be_open);
    }
    for name in OWN_MODULES {
        let pass: Vec<Module> = PASSES.iter().filter(|file| file.name == name).copied().collect();
        let rooms: Vec<Module> = LIBRARY.iter().copied().chain(shared_constants()).collect();
        check(Files { rooms: &rooms, passes: &pass, guests: &[] }, &Glue::default(), &[]);
    }
}

#[test]
fn rooms_look_down_only() {
    // The rooms of the constants that Rust shares.
    const CONSTANTS: &str = "kernel";
    const COEFFICIENTS: &str = "profile";
    // What each room may use, itself included.
    let below = |room: &str| -> &[&str] {
        match room {
            "lib" => &["lib", CONSTANTS, COEFFICIENTS],
            // Which models the parts of mixtures have is known to the set alone.
            "profiles" => &["profiles", "lib", COEFFICIENTS, GLUE],
            "gather" => &["gather", "lib", CONSTANTS, GLUE],
            "kernels" => &["kernels", "gather", "lib", CONSTANTS, GLUE],
            "light" => &["light", "gather", "lib", CONSTANTS, GLUE],
            "passes" => &["passes", "kernels", "light", "gather", "lib", CONSTANTS, GLUE],
            other => panic!("no rule for the room {other}"),
        }
    };
    let room = |name: &str| name.split('/').next().map(str::to_owned).unwrap_or_default();
    for module in modules() {
        let (header, _) = header::split(module.text).unwrap_or_else(|line| panic!("{}: {line}", module.name));
        for used in &header.uses {
            let is_below = below(&room(module.name)).contains(&room(used).as_str());
            assert!(is_below, "{} uses {used}, which is no room below its own", module.name);
        }
    }
}

#[test]
fn passes_hold_bindings_entry_points_and_what_files_need() {
    let needs: BTreeSet<&str> = modules()
        .filter_map(|module| header::split(module.text).ok())
        .flat_map(|(header, _)| header.needs)
        .collect();
    for module in PASSES {
        let (_, text) = header::split(module.text).unwrap_or_else(|line| panic!("{}: {line}", module.name));
        for item in items(text).unwrap_or_else(|at| panic!("{}: {at}", module.name)).items {
            let is_function = item.text.lines().any(|line| line.starts_with("fn "));
            let is_entry = ["@vertex", "@fragment", "@compute"].iter().any(|stage| item.text.contains(stage));
            assert!(
                !is_function || is_entry || needs.contains(item.name),
                "{}: {} is no entry point, and no file needs it: it belongs into a room",
                module.name,
                item.name
            );
        }
    }
}
