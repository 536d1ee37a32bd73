//! The presets, compiled: the same bytes every time, what the generated Rust holds, and the tiers that they reach.

use subsurface_codegen::Compiler;

#[test]
fn the_presets_compile_to_the_same_bytes_every_time() {
    let compile = |directory: &str| {
        let result = Compiler::new(directory).compile();
        let compilation = result.unwrap_or_else(|report| panic!("{report}"));
        (compilation.parts, compilation.rust, compilation.manifest)
    };
    let absolute = std::fs::canonicalize("materials").expect("the folder is there");
    let first = compile("materials");
    assert!(first == compile("materials"), "two runs differ");
    assert!(first == compile(&absolute.to_string_lossy()), "the place of the checkout shows");
}

#[test]
fn the_generated_tables_are_those_of_the_compiler() {
    use subsurface::presets::{CURVE_SIZE, MATERIALS, Material, PROFILE_CURVES, WGSL};
    let compilation = Compiler::new("materials").compile().unwrap_or_else(|report| panic!("{report}"));
    let parts = &compilation.parts;
    assert_eq!(subsurface::runtime::bytemuck::cast_slice::<_, u8>(&MATERIALS), parts.material_rows());
    assert_eq!(Material::NAMES.as_slice(), compilation.material_names());
    assert_eq!(WGSL, compilation.wgsl());
    assert_eq!((CURVE_SIZE, PROFILE_CURVES), (parts.curve_size(), parts.profile_curves()));
    for (number, material) in Material::ALL.into_iter().enumerate() {
        assert_eq!(material.number() as usize, number);
        assert_eq!(Material::from_name(material.name()), Some(material));
    }
}

#[test]
fn the_ready_made_materials_reach_every_tier() {
    let ron = |entry: std::io::Result<std::fs::DirEntry>| entry.expect("the folder can be read").path();
    let mut files: Vec<(String, String)> = std::fs::read_dir("materials")
        .expect("the folder is there")
        .map(ron)
        .filter(|path| path.extension().is_some_and(|extension| extension == "ron"))
        .map(|path| {
            let name = path.file_name().expect("it has a name").to_string_lossy().into_owned();
            (name, std::fs::read_to_string(path).expect("it is text"))
        })
        .filter(|(name, _)| name != "set.ron")
        .collect();
    files.push(("set.ron".to_owned(), "MaterialSet(quality: Ultra)".to_owned()));
    let compilation = Compiler::from_memory(files).compile().unwrap_or_else(|report| panic!("{report}"));
    for tier in compilation.quality.expect("the set asks for a tier").tiers {
        assert!(tier.error <= tier.tier.target(), "{tier:?}");
    }
}
