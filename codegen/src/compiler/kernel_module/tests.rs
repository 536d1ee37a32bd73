//! What the text of a module looks like.

use std::collections::{BTreeMap, BTreeSet};

use naga::{Handle, Type};
use subsurface_kernel::{DebugView, Estimator, OutputFormat, Rejection};
use subsurface_shaders::Module;

use super::*;
use crate::compiler::rows::Rows;
use crate::compiler::{Compiler, KNOT, ROW};
use crate::item::items;
use crate::layout::{FieldType, structure};
use crate::material::MaterialSet;

/// A set with every published profile, a table and a mixture.
fn compiler(estimator: Estimator) -> Compiler {
    let material = |profile: &str| {
        format!(
            "Material(profile: {profile}, mean_free_path_mm: (1.3, 0.95, 0.67), surface_albedo: (0.8, 0.6, 0.4))"
        )
    };
    let published = subsurface_profile::Model::PUBLISHED
        .map(|stem| (format!("{stem}.ron"), material(&format!("\"{stem}\""))));
    let tabulated = [
        ("t.csv".to_owned(), "r,r_reflectance\n0,0.1\n1,0.05\n2,0\n".to_owned()),
        ("t.ron".to_owned(), material("Tabulated(file: \"t.csv\")")),
    ];
    let parts = "(0.5, Burley(parametrization: Diffuse)), (0.5, Dipole(medium: Skin1))";
    let mixture = ("mixture.ron".to_owned(), material(&format!("Mixture([{parts}])")));
    Compiler::from_memory(published.into_iter().chain(tabulated).chain([mixture])).estimator(estimator)
}

fn wgsl(compiler: &Compiler) -> String {
    let compilation = compiler.compile().unwrap_or_else(|report| panic!("{report}"));
    compilation.wgsl().to_owned()
}

#[test]
fn no_line_is_longer_than_120_columns() {
    for estimator in Estimator::ALL {
        let text = wgsl(&compiler(estimator).with_debug_views());
        for line in text.lines() {
            assert!(line.chars().count() <= 120, "{estimator}: {line}");
        }
    }
}

#[test]
fn entry_points_come_first_and_names_before_their_use() {
    for estimator in Estimator::ALL {
        let text = wgsl(&compiler(estimator).with_debug_views());
        let sections: Vec<(usize, &str)> = text
            .match_indices("// ── ")
            .map(|(at, _)| (at, text[at..].lines().next().unwrap_or_default()))
            .collect();
        let section =
            |at: usize| sections.iter().rev().find(|(start, _)| *start <= at).map(|(_, name)| *name);
        let place = |item: &str| item.as_ptr() as usize - text.as_ptr() as usize;
        let items = items(&text).unwrap_or_else(|at| panic!("{at}")).items;
        let is_entry =
            |text: &str| ["@vertex", "@fragment", "@compute"].iter().any(|stage| text.contains(stage));
        let entries = items.iter().take_while(|item| is_entry(item.text)).count();
        assert!(entries > 0 && !items[entries..].iter().any(|item| is_entry(item.text)), "{estimator}");

        let places: BTreeMap<&str, usize> = items.iter().map(|item| (item.name, place(item.text))).collect();
        for item in &items[entries..] {
            let here = section(place(item.text));
            // A profile whose functions the set writes out calls them in turn.
            if here.is_some_and(|name| name.starts_with("// ── profiles/")) {
                continue;
            }
            for name in &item.references {
                let Some(&at) = places.get(name) else { continue };
                let is_above = at < place(item.text) || section(at) == here;
                assert!(is_above, "{estimator}: {} uses {name}, which stands below", item.name);
            }
        }
    }
}

#[test]
fn debug_views_are_linked_when_asked_for() {
    let plain = wgsl(&compiler(Estimator::default()));
    for name in [DebugView::ENTRY_POINT, "debug_colour", "gather_importance_sampled", "relative_deviation"] {
        assert!(!plain.contains(&format!("fn {name}(")), "{name}");
    }
    let with_views = wgsl(&compiler(Estimator::default()).with_debug_views());
    assert!(with_views.contains(&format!("fn {}(", DebugView::ENTRY_POINT)));
    for view in DebugView::ALL {
        let declaration = format!("const {}: u32 = {}u;", view.constant(), view.number());
        assert!(with_views.contains(&declaration), "{declaration}");
    }
}

/// The module of `set` from `shaders`, and its rows and knots; or what the build says.
fn built(set: &MaterialSet, shaders: &ShaderFiles) -> Result<KernelModule, String> {
    let choices = Choices {
        estimator: Estimator::default(),
        rejection: Rejection::default(),
        output_format: OutputFormat::default(),
    };
    let mut report = Report::default();
    let wanted = Wanted { shaders, gbuffer: true, debug_views: true, passes: &[] };
    let module = KernelModule::generate(set, &choices, wanted, "", &mut report);
    let module = module.ok_or_else(|| report.to_string())?;
    for (name, values) in [(ROW, &module.emitted.rows), (KNOT, &module.emitted.knots)] {
        Rows::of(&module.validated.module, &module.linked.docs, name, values)
            .map_err(|error| error.message)?;
    }
    Ok(module)
}

/// Members of a struct and of all structs within it, by struct.
fn members(of: &KernelModule, handle: Handle<Type>, all: &mut BTreeSet<(String, String)>) {
    let Some(found) = structure(&of.validated.module, &of.linked.docs, handle) else { return };
    for field in found.fields {
        all.insert((found.name.clone(), field.name));
        match field.ty {
            FieldType::Struct(inner) => members(of, inner, all),
            FieldType::Array { element, .. } => {
                if let FieldType::Struct(inner) = *element {
                    members(of, inner, all);
                }
            }
            _ => {}
        }
    }
}

/// `text` with another name for `word` wherever it stands, as an editor renames it.
fn renamed(text: &str, word: &str, other: &str) -> String {
    let is_of_word = |c: char| c.is_alphanumeric() || c == '_';
    let mut result = String::new();
    let mut rest = text;
    while let Some(at) = rest.find(word) {
        let (before, from) = rest.split_at(at);
        let after = &from[word.len()..];
        let is_whole = !before.ends_with(is_of_word) && !after.starts_with(is_of_word);
        result.push_str(before);
        result.push_str(if is_whole { other } else { word });
        rest = after;
    }
    result + rest
}

#[test]
fn what_is_renamed_in_wgsl_alone_stops_the_build() {
    let loaded = compiler(Estimator::default()).load();
    let set = loaded.set.unwrap_or_else(|| panic!("{}", loaded.report));
    let house = ShaderFiles::default();
    let module = built(&set, &house).unwrap_or_else(|report| panic!("{report}"));
    let mut all = BTreeSet::new();
    for name in [ROW, KNOT] {
        let types = &module.validated.module.types;
        let (handle, _) =
            types.iter().find(|(_, ty)| ty.name.as_deref() == Some(name)).expect("it is declared");
        members(&module, handle, &mut all);
    }
    let files = || house.rooms.iter().chain(&house.profiles).chain(&house.passes);
    // Structs of the glue take their names from the descriptions in Rust: their members cannot differ.
    all.retain(|(name, _)| files().any(|file| file.text.contains(&format!("struct {name} {{"))));
    let structs: BTreeSet<&String> = all.iter().map(|(name, _)| name).collect();
    // What every material has, the coefficients of every model, a knot.
    assert!(structs.len() >= 8, "{structs:?}");
    let entries = Estimator::default().entry_points().chain([DebugView::ENTRY_POINT]).chain(GBUFFER_ENTRIES);
    let words: BTreeSet<String> =
        all.into_iter().map(|(_, member)| member).chain(entries.map(str::to_owned)).collect();
    for member in &words {
        let other = format!("{member}_anew");
        let renamed = |files: &[Module]| -> Vec<Module> {
            let of = |file: &Module| Module {
                name: file.name,
                text: Box::leak(renamed(file.text, member, &other).into_boxed_str()),
            };
            files.iter().map(of).collect()
        };
        let shaders = ShaderFiles {
            rooms: renamed(&house.rooms),
            profiles: renamed(&house.profiles),
            passes: renamed(&house.passes),
        };
        let Err(message) = built(&set, &shaders) else { panic!("`{member}` may be renamed") };
        assert!(message.contains(member.as_str()), "`{member}`: {message}");
    }
}
