//! Golden outputs: what a material set compiles to, whole.

use std::path::Path;

use subsurface_codegen::{Compiler, Estimator, OutputFormat, Rejected, Rejection};

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
        [("wgsl", compilation.wgsl()), ("rust", &compilation.rust), ("manifest", &compilation.manifest)]
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
        assert_eq!(compilation.parts.material_rows().len() % (16 * names.len()), 0, "{}", path.display());
    }
}

#[test]
fn the_caller_overrides_the_file_of_the_set() {
    let directory = "tests/in/pass/described_set";
    let compile = |compiler: Compiler| compiler.compile().unwrap_or_else(|report| panic!("{report}"));
    let own = compile(Compiler::new(directory));
    assert_eq!(own.estimator(), Estimator::ImportanceSampled { taps: 33 });
    let rejection = Rejection {
        by_material: true,
        by_distance: false,
        by_normal: false,
        rejected: Rejected::ReturnedToCentre,
    };
    assert_eq!((own.rejection, own.set.rejection), (rejection, rejection));
    for line in [
        "// Estimator: ImportanceSampled, 33 taps\n",
        "// Rejects: by material; rejected energy is returned to the centre\n",
        "const REJECT_BY_MATERIAL: bool = true;",
        "const REJECT_BY_DISTANCE: bool = false;",
        "const RETURN_TO_CENTRE: bool = true;",
        "texture_storage_2d<rgba16float, write>",
    ] {
        assert!(own.wgsl().contains(line), "{line}");
    }
    assert!(own.rust.contains("Estimator::ImportanceSampled") && own.rust.contains("taps: 33"));

    let default = Rejection::default();
    let other = Compiler::new(directory).estimator(Estimator::default()).rejection(default);
    let other = compile(other.output_format(OutputFormat::Rgba32Float));
    assert_eq!((other.estimator(), other.rejection), (Estimator::default(), default));
    // What the set's own file says stays on record.
    assert_eq!(other.set.estimator, own.estimator());
    assert!(other.wgsl().contains("// Estimator: Interleaved, 4 taps\n"));
    assert!(other.wgsl().contains("texture_storage_2d<rgba32float, write>"));
    assert!(other.rust.contains("Estimator::Interleaved"));
    assert_ne!(other.provenance, own.provenance);
}

#[test]
fn a_set_that_asks_for_an_error_states_it() {
    let compile = |compiler: Compiler| compiler.compile().unwrap_or_else(|report| panic!("{report}"));
    let directory = "tests/in/pass/described_by_its_error";
    let compilation = compile(Compiler::new(directory));
    let report = compilation.quality.as_ref().expect("the set asks for an error");
    assert!(report.error > 0.0 && report.error <= 0.03, "{report:?}");
    assert_eq!(compilation.estimator(), report.estimator);
    let (error, taps) = (report.error, report.estimator.taps());
    let head = format!("// Estimator: {}\n// Error: {error} of the white level", report.estimator);
    assert!(compilation.wgsl().contains(&head), "{head}");
    assert!(compilation.rust.contains(&format!("pub const KERNEL_ERROR: f64 = {error};")));
    assert!(compilation.rust.contains("pub enum Quality"));
    assert!(compilation.rust.contains(&format!("taps: {taps},")));
    assert!(compilation.manifest.contains(&format!("\"error\": {error}")));
    for tier in report.tiers {
        let stated = format!("{} {} ({})", tier.tier.name(), tier.taps, tier.error);
        assert!(compilation.wgsl().contains(&stated), "{stated}");
    }
    // Again, and the same bytes.
    let again = compile(Compiler::new(directory));
    assert_eq!((&again.parts, &again.rust), (&compilation.parts, &compilation.rust));
    assert_eq!(again.manifest, compilation.manifest);

    // An estimator that the caller names is not searched, and a set that asks for none says nothing of errors.
    let named = compile(Compiler::new(directory).estimator(Estimator::Dense));
    let without = compile(Compiler::new("tests/in/pass/described_set"));
    for compilation in [named, without] {
        assert_eq!(compilation.quality, None);
        assert!(!compilation.wgsl().contains("// Error:"));
        assert!(!compilation.rust.contains("KERNEL_ERROR") && !compilation.rust.contains("enum Quality"));
        assert!(!compilation.manifest.contains("quality"));
    }
}

#[test]
fn every_choice_of_the_caller_shows_in_the_provenance() {
    let skin = include_str!("in/pass/one_model/skin.ron");
    let compiler = || Compiler::from_memory([("skin.ron", skin)]);
    let rejection = Rejection::default();
    let compilers = [
        compiler(),
        compiler().estimator(Estimator::Interleaved { taps: 5 }),
        compiler().estimator(Estimator::ImportanceSampled { taps: 4 }),
        compiler().rejection(Rejection { by_normal: true, ..rejection }),
        compiler().rejection(Rejection { rejected: Rejected::ReturnedToCentre, ..rejection }),
        compiler().output_format(OutputFormat::Rgba32Float),
        compiler().without_gbuffer(),
    ];
    let provenance = |compiler: Compiler| match compiler.compile() {
        Ok(compilation) => compilation.provenance,
        Err(report) => panic!("{report}"),
    };
    let different: std::collections::BTreeSet<String> = compilers.map(provenance).into();
    assert_eq!(different.len(), 7);
}

#[test]
fn a_kernel_with_taps_that_it_cannot_have_is_refused() {
    let skin = include_str!("in/pass/one_model/skin.ron");
    for (kernel, message) in [
        (
            Estimator::Separable { taps: 16, rotated: false },
            "error: the estimator `Separable` cannot have 16 taps\n = help: give `Compiler::estimator` an odd number from 3 to 65\n",
        ),
        (
            Estimator::Interleaved { taps: 0 },
            "error: the estimator `Interleaved` cannot have 0 taps\n = help: give `Compiler::estimator` a whole number from 1 to 64\n",
        ),
    ] {
        let compiler = Compiler::from_memory([("skin.ron", skin)]).estimator(kernel);
        let report = compiler.compile().expect_err("no such kernel");
        assert_eq!(report.render(false), message);
    }
}

#[test]
fn the_curves_are_written_beside_the_rest() {
    let directory = tempfile::tempdir().expect("there is room");
    let compilation = Compiler::new("tests/in/pass/every_form").compile();
    let compilation = compilation.unwrap_or_else(|report| panic!("{report}"));
    compilation.write_to(directory.path()).expect("the folder can be written to");
    let curves = std::fs::read(directory.path().join("subsurface.curves")).expect("the file is there");
    assert_eq!(curves, compilation.parts.profile_curves());
    let [width, height] = compilation.parts.curve_size().map(|extent| extent as usize);
    assert_eq!(curves.len(), 16 * width * height);
}

#[test]
fn clear_materials_are_constants_of_their_own() {
    let compilation = Compiler::new("tests/in/pass/clear").compile().expect("the set is good");
    let [bottle, water] = &compilation.set.clear[..] else { panic!("{:?}", compilation.set.clear) };
    assert_eq!((bottle.name.as_str(), bottle.shell_thickness_mm), ("green_bottle", Some(3.0)));
    assert_eq!((water.name.as_str(), water.refractive_index, water.roughness), ("water", 1.33, 0.0));
    let rust = &compilation.rust;
    for part in [
        "pub mod clear",
        "pub const WATER: ::subsurface_runtime::ClearMaterial",
        "shell_thickness_mm: Some(3.0)",
    ] {
        assert!(rust.contains(part), "no `{part}`");
    }
    let manifest = &compilation.manifest;
    assert!(manifest.contains("\"clear_materials\"") && manifest.contains("\"green_bottle\""));
}

#[test]
fn a_material_may_take_away_what_its_base_has() {
    let base = "Material(profile: \"two_exponential_dipole_searchlight\", mean_free_path_mm: (1, 1, 1), \
                surface_albedo: (0.5, 0.5, 0.5), thin: (thickness_mm: 0.2), \
                specular: (second: (roughness: 0.2, weight: 0.3)))";
    let without = "Material(base: \"leaf\", thin: None, specular: (second: None))";
    let files = [("leaf.ron", base), ("stem.ron", without)];
    let compilation = Compiler::from_memory(files).compile().expect("the set is good");
    let [leaf, stem] = ["leaf", "stem"].map(|name| compilation.set.get(name).expect("it is there"));
    assert!(leaf.second_lobe.is_some() && leaf.thin_thickness_mm == Some(0.2));
    assert!(stem.second_lobe.is_none() && stem.thin_thickness_mm.is_none());
}
