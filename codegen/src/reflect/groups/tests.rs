use subsurface_shaders::Module;

use super::*;
use crate::compose::{Files, Glue, link};
use crate::reflect::{Reflection, Resource, reflect};
use crate::report::Report;
use crate::validate::validate;

/// Links two modules, `passes/one` and `passes/two`, with an entry point each.
fn reflected(one: &'static str, two: &'static str) -> Reflection {
    let modules = [Module { name: "passes/one", text: one }, Module { name: "passes/two", text: two }];
    let mut report = Report::default();
    let files = Files { guests: &modules, ..Files::default() };
    let linked = link(files, &Glue::default(), &["one_main", "two_main"], "").expect("links");
    let validated = validate(&linked, "test.wgsl", &mut report).unwrap_or_else(|| panic!("{report}"));
    reflect(&validated.module, &validated.info, &linked).unwrap_or_else(|error| panic!("{error}"))
}

/// Number, module, entry points and names of each group.
type Shown<'a> = (u32, Option<&'a str>, Vec<&'a str>, Vec<&'a str>);

fn shown(reflection: &Reflection) -> Vec<Shown<'_>> {
    fn of(group: &Group) -> Shown<'_> {
        let names = group.bindings.values().map(|bound| bound.name.as_str()).collect();
        let entries = group.entry_points.iter().map(String::as_str).collect();
        (group.number, group.module.as_deref(), entries, names)
    }
    reflection.groups.iter().map(of).collect()
}

#[test]
fn a_group_that_one_module_declares_is_shared() {
    let reflection = reflected(
        "@group(0) @binding(0) var one: texture_2d<f32>;\n@group(0) @binding(1) var two: texture_2d<u32>;\n\
         @fragment fn one_main() -> @location(0) vec4f { return textureLoad(one, vec2i(), 0); }\n",
        "var<workgroup> kept: u32;\n\
         @compute @workgroup_size(8, 4) fn two_main() {\n\
         kept = textureLoad(two, vec2i(), 0).x + u32(textureLoad(one, vec2i(), 0).x); }\n",
    );
    assert_eq!(shown(&reflection), [(0, None, vec!["one_main", "two_main"], vec!["one", "two"])]);
    let stages =
        |binding: u32| reflection.groups[0].bindings[&binding].stages.iter().copied().collect::<Vec<_>>();
    assert_eq!(stages(0), [Stage::Fragment, Stage::Compute]);
    assert_eq!(stages(1), [Stage::Compute]);
    let sizes: Vec<_> = reflection.entry_points.iter().map(|entry| entry.workgroup_size).collect();
    assert_eq!(sizes, [None, Some([8, 4, 1])]);
}

#[test]
fn a_group_that_two_modules_declare_is_two() {
    let reflection = reflected(
        "@group(2) @binding(0) var source: texture_2d<f32>;\n\
         @fragment fn one_main() -> @location(0) vec4f { return textureLoad(source, vec2i(), 0); }\n",
        "@group(2) @binding(0) var words: texture_2d<u32>;\n\
         @group(2) @binding(1) var written: texture_storage_2d<rg32uint, write>;\n\
         @group(2) @binding(2) var<storage, read_write> tiles: array<atomic<u32>>;\n\
         @group(3) @binding(0) var<storage, read> points: array<vec2f>;\n\
         @compute @workgroup_size(8) fn two_main() {\n\
         textureStore(written, vec2i(i32(points[0].x)), textureLoad(words, vec2i(), 0)); \
         atomicAdd(&tiles[3], 1u); }\n",
    );
    let expected = [
        (2, Some("passes/one"), vec!["one_main"], vec!["source"]),
        (2, Some("passes/two"), vec!["two_main"], vec!["words", "written", "tiles"]),
        (3, None, vec!["two_main"], vec!["points"]),
    ];
    assert_eq!(shown(&reflection), expected);
    let resource = |group: usize, binding: u32| reflection.groups[group].bindings[&binding].resource.clone();
    let written =
        Resource::StorageTexture { access: "WriteOnly", format: "Rg32Uint".to_owned(), dimension: "D2" };
    assert_eq!(resource(1, 1), written);
    let tiles = Resource::Storage { size: 4, holds: "atomic<u32>".to_owned(), read_only: false };
    assert_eq!(resource(1, 2), tiles);
    let points = Resource::Storage { size: 8, holds: "vec2<f32>".to_owned(), read_only: true };
    assert_eq!(resource(2, 0), points);
}
