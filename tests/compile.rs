//! Golden outputs: what a material set compiles to, whole.

use std::path::Path;

use subsurface_codegen::Compiler;

/// Compares `text` with the blessed file; `cargo xtask bless` accepts a change.
fn assert_blessed(folder: &str, name: &str, text: &str) {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(Path::new("out").join(folder));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!(name, text));
}

#[test]
fn a_set_of_one_model_compiles_to_the_blessed_texts() {
    let skin = include_str!("in/pass/one_model/skin.ron");
    let compilation = Compiler::from_memory([("skin.ron", skin)]).without_gbuffer().compile();
    let compilation = compilation.unwrap_or_else(|report| panic!("{report}"));
    for (folder, text) in
        [("wgsl", &compilation.wgsl), ("rust", &compilation.rust), ("manifest", &compilation.manifest)]
    {
        // The hash covers every shader and the version: it changes with each, and says nothing new beside the text.
        assert_blessed(folder, "one_model", &text.replace(&compilation.provenance, "<sha256>"));
    }
}

#[test]
fn every_accepted_set_compiles() {
    for entry in std::fs::read_dir("tests/in/pass").expect("the folder is there") {
        let path = entry.expect("the folder can be read").path();
        let compilation = Compiler::new(&path).compile().unwrap_or_else(|report| panic!("{report}"));
        let names = compilation.material_names();
        assert_eq!(compilation.material_table.len() % (16 * names.len()), 0, "{}", path.display());
    }
}

#[test]
fn the_presets_compile_to_the_same_bytes_every_time() {
    let compile = |directory: &str| {
        let result = Compiler::new(directory).compile();
        let compilation = result.unwrap_or_else(|report| panic!("{report}"));
        (compilation.wgsl, compilation.rust, compilation.manifest)
    };
    let absolute = std::fs::canonicalize("materials").expect("the folder is there");
    let first = compile("materials");
    assert!(first == compile("materials"), "two runs differ");
    assert!(first == compile(&absolute.to_string_lossy()), "the place of the checkout shows");
}

#[test]
fn the_generated_table_is_the_one_that_is_uploaded() {
    use subsurface::presets::{MATERIALS, Material, WGSL};
    let compilation = Compiler::new("materials").compile().unwrap_or_else(|report| panic!("{report}"));
    assert_eq!(subsurface::runtime::bytemuck::cast_slice::<_, u8>(&MATERIALS), compilation.material_table);
    assert_eq!(Material::NAMES.as_slice(), compilation.material_names());
    assert_eq!(WGSL, compilation.wgsl);
    for (number, material) in Material::ALL.into_iter().enumerate() {
        assert_eq!(material.number() as usize, number);
        assert_eq!(Material::from_name(material.name()), Some(material));
    }
}
