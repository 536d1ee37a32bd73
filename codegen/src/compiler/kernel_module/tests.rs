//! What the text of a module looks like.

use std::collections::BTreeMap;

use subsurface_kernel::{DebugView, Estimator};

use crate::compiler::Compiler;
use crate::item::items;

/// A set with every published profile and a table.
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
    Compiler::from_memory(published.into_iter().chain(tabulated)).estimator(estimator)
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
