//! No text makes reading a material panic, and every diagnostic about it can be shown.

use proptest::prelude::*;
use subsurface_codegen::{Loaded, load_memory, profile_file_text};
use subsurface_profile::ModelKind;

/// Pieces that material files are made of, and some that they are not.
const PIECES: [&str; 88] = [
    "Material",
    "MaterialSet",
    "medium",
    "second",
    "Hapke",
    "OrenNayar",
    "Disney",
    "sigma",
    "opposition",
    "Shirley",
    "weight",
    "transmission",
    "diffused",
    "reduced_scattering_per_mm",
    "anisotropy",
    "absorption_per_mm",
    "refractive_index",
    "kernel",
    "Interleaved",
    "Separable",
    "taps",
    "rotated",
    "rejection",
    "by_normal",
    "rejected",
    "true",
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    ",",
    ":",
    "profile",
    "mean_free_path_mm",
    "diffuse_mean_free_path_mm",
    "surface_albedo",
    "specular",
    "reflectance_at_normal",
    "roughness",
    "transmission_strength",
    "transmittance",
    "diffuse",
    "coupling",
    "Chandrasekhar",
    "Lambert",
    "entry",
    "Full",
    "thin",
    "thickness_mm",
    "version",
    "name",
    "base",
    "\"skin\"",
    "\"p\"",
    "\"burley_diffuse\"",
    "parametrization",
    "Fit",
    "length",
    "MeanFreePath",
    "coefficients",
    "Liang2023",
    "a",
    "b",
    "c",
    "entry",
    "model",
    "Searchlight",
    "0",
    "1",
    "-0.5",
    "1e60",
    "1e-60",
    "NaN",
    "inf",
    "-inf",
    " ",
    "\n",
    "\r\n",
    "// x\n",
    "///é\n",
    "/*",
    "*/",
    "#![enable(implicit_some)]",
    "r#\"",
    "\u{feff}",
    "'",
];

fn pieces() -> impl Strategy<Value = String> {
    let names = ModelKind::ALL.iter().map(|kind| kind.description().name);
    let fields = ModelKind::ALL.iter().flat_map(|kind| kind.fields()).map(|field| field.name());
    let pieces: Vec<&'static str> = PIECES.into_iter().chain(names).chain(fields).collect();
    prop::collection::vec(prop::sample::select(pieces), 0..60).prop_map(|pieces| pieces.concat())
}

/// A material that is right but for a few characters.
fn damaged() -> impl Strategy<Value = String> {
    const GOOD: &str = "/// ä\nMaterial(\n  profile: GaussianSum([(variance_mm2: 0.5, weight: (1, 1, 1))]),\n  \
                        mean_free_path_mm: (1.3, 0.95, 0.67), surface_albedo: (0.83, 0.64, 0.55),\n  specular: \
                        (reflectance_at_normal: 0.028, roughness: 0.4), // é\n)";
    let edit = (0..GOOD.len(), 0..4usize, prop::sample::select(PIECES.to_vec()));
    prop::collection::vec(edit, 1..4).prop_map(|edits| {
        let mut text = GOOD.to_owned();
        for (at, removed, piece) in edits {
            let boundary =
                |offset: usize| (0..=offset.min(text.len())).rev().find(|&o| text.is_char_boundary(o));
            let start = boundary(at).unwrap_or(0);
            let end = boundary(start + removed).unwrap_or(0).max(start);
            text.replace_range(start..end, piece);
        }
        text
    })
}

/// What cells of tables hold, and some that they do not.
fn table_cell() -> impl Strategy<Value = String> {
    const CELLS: [&str; 20] = [
        "surface_albedo",
        "r",
        "r_lo",
        "r_hi",
        "reflectance",
        "r_reflectance",
        "radial_reflectance",
        "standard_error",
        "0",
        "0.5",
        "1",
        "2",
        "3e-1",
        "-1",
        "NaN",
        "1e999",
        "",
        "\"",
        "# é",
        "\r",
    ];
    prop_oneof![
        3 => prop::sample::select(CELLS.to_vec()).prop_map(str::to_owned),
        2 => any::<f64>().prop_map(|number| format!("{number:?}")),
        2 => (0.0..1.0f64).prop_map(|number| format!("{number:?}")),
    ]
}

/// The laws of any result.
fn check(loaded: &Loaded) {
    assert_eq!(loaded.set.is_none(), loaded.report.has_errors());
    let rendered = loaded.report.render(false);
    for diagnostic in loaded.report.iter() {
        assert!(!diagnostic.help.is_empty(), "no remedy: {}", diagnostic.message);
        // The renderer falls back to the bare message when a span does not fit its file; it must not have to.
        let shown = format!("{}: {}", diagnostic.severity.name(), diagnostic.message);
        assert!(rendered.contains(shown.lines().next().unwrap_or_default()), "{shown} is not in\n{rendered}");
        for (span, _) in diagnostic.primary.iter().chain(&diagnostic.secondary) {
            assert!(
                loaded.report.sources().text(span.file).get(span.range.clone()).is_some(),
                "{diagnostic:?}"
            );
        }
    }
    let _ = loaded.report.render(true);
    assert_eq!(loaded.report.to_json().as_array().map_or(0, Vec::len), loaded.report.iter().count());
}

proptest! {
    #[test]
    fn random_characters(text in "\\PC{0,200}") {
        check(&load_memory([("skin.ron", &text), ("profiles/p.ron", &text)]));
    }

    #[test]
    fn random_bytes(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        check(&load_memory([("skin.ron", &bytes), ("profiles/p.ron", &bytes)]));
    }

    #[test]
    fn random_tables(lines in prop::collection::vec(prop::collection::vec(table_cell(), 0..5), 0..12), bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let material = "Material(profile: Tabulated(file: \"t.csv\"), mean_free_path_mm: (1, 1, 1), surface_albedo: (1, 0, 0.5))";
        let rows: Vec<String> = lines.iter().map(|cells| cells.join(",")).collect();
        let headed = format!("surface_albedo,r,r_reflectance\n{}", rows.join("\n"));
        for csv in [rows.join("\n").into_bytes(), headed.into_bytes(), bytes] {
            check(&load_memory([("skin.ron", material.as_bytes()), ("t.csv", &csv)]));
        }
    }

    #[test]
    fn random_pieces(material in pieces(), profile in pieces()) {
        check(&load_memory([("skin.ron", &format!("Material({material})")), ("jade.ron", &material)]));
        check(&load_memory([("skin.ron", "Material(profile: \"p\")"), ("profiles/p.ron", &profile)]));
        for set in [format!("MaterialSet({material})"), format!("MaterialSet(kernel: {material})")] {
            check(&load_memory([("set.ron", &set), ("profiles/p.ron", &set)]));
        }
    }

    #[test]
    fn damaged_materials(text in damaged()) {
        check(&load_memory([("skin.ron", &text)]));
    }

    #[test]
    fn random_numbers(numbers in prop::array::uniform6(any::<f64>()), variance in any::<f64>()) {
        let [a, b, c, d, e, f] = numbers;
        let text = format!(
            "Material(profile: GaussianSum([(variance_mm2: {variance:?}, weight: ({d:?}, {e:?}, {f:?}))]), \
             mean_free_path_mm: ({a:?}, {b:?}, {c:?}), surface_albedo: ({d:?}, {e:?}, {f:?}))"
        );
        check(&load_memory([("skin.ron", text)]));
    }

    #[test]
    fn random_coefficients(numbers in prop::array::uniform12(-1e3f64..1e3)) {
        let rest = "mean_free_path_mm: (1, 1, 1), surface_albedo: (0.5, 0.5, 0.5)";
        let mut next = numbers.iter().cycle();
        let mut models: Vec<String> = ModelKind::ALL.iter().filter_map(|kind| kind.blank(2)).map(|mut model| {
            model.visit(&mut |slot| slot.values.iter_mut().zip(next.by_ref()).for_each(|(place, value)| *place = *value));
            profile_file_text(&model, &[]).expect("a model of coefficients")
        }).collect();
        models.push(format!("Mixture([({}, {}), ({}, {})])", numbers[0], models[0], numbers[1], models[1]));
        for model in models {
            check(&load_memory([("skin.ron", format!("Material(profile: {model}, {rest})"))]));
        }
    }
}
