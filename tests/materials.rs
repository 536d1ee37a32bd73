//! The data in `materials/`: it loads without a word, and its numbers are those of their sources.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

use std::path::Path;

use subsurface_codegen::{MaterialSet, load_directory, load_memory, load_profile_file};
use subsurface_profile::Model;
use subsurface_profile::single_scattering_albedo::{Entry, to_surface_albedo};

fn presets() -> MaterialSet {
    let loaded = load_directory(Path::new("materials"));
    assert!(loaded.report.is_empty(), "{}", loaded.report);
    loaded.set.unwrap()
}

#[test]
fn the_presets_are_those_of_the_readme() {
    let names: Vec<String> = presets().materials.into_iter().map(|material| material.name).collect();
    let expected = [
        "apple",
        "jade",
        "ketchup",
        "marble",
        "potato",
        "skimmilk",
        "skin",
        "skin_medium",
        "wax",
        "wholemilk",
    ];
    assert_eq!(names, expected);
    let readme = std::fs::read_to_string("materials/README.md").unwrap();
    for name in expected.iter().chain(&Model::PUBLISHED) {
        assert!(readme.contains(&format!("`{name}`")), "{name} is not in materials/README.md");
    }
}

#[test]
fn every_published_profile_is_spelled_out_as_data() {
    for stem in Model::PUBLISHED {
        let path = Path::new("materials/profiles").join(stem).with_extension("ron");
        let loaded = load_profile_file(&path);
        let profile = loaded.profile.unwrap_or_else(|| panic!("{}", loaded.report));
        assert_eq!(Some(profile.model), Model::published(stem), "{stem}");
        assert!(profile.docs.len() >= 3, "{stem} does not say where it comes from");
    }
}

/// Reduced scattering and absorption per mm, red, green and blue (Jensen et al. 2001, figure 5).
const JENSEN_2001: [(&str, [f64; 3], [f64; 3]); 7] = [
    ("apple", [2.29, 2.39, 1.97], [0.0030, 0.0034, 0.046]),
    ("ketchup", [0.18, 0.07, 0.03], [0.061, 0.97, 1.45]),
    ("marble", [2.19, 2.62, 3.00], [0.0021, 0.0041, 0.0071]),
    ("potato", [0.68, 0.70, 0.55], [0.0024, 0.0090, 0.12]),
    ("skimmilk", [0.70, 1.22, 1.90], [0.0014, 0.0025, 0.0142]),
    ("skin_medium", [1.09, 1.59, 1.79], [0.013, 0.070, 0.145]),
    ("wholemilk", [2.55, 3.21, 3.77], [0.0011, 0.0024, 0.014]),
];

#[test]
fn measured_materials_have_the_lengths_and_surface_albedos_of_their_source() {
    let presets = presets();
    for (name, scattering, absorption) in JENSEN_2001 {
        let material = presets.get(name).unwrap();
        for channel in 0..3 {
            let extinction = scattering[channel] + absorption[channel];
            let surface_albedo = to_surface_albedo(Entry::Searchlight, scattering[channel] / extinction);
            // Written with four significant digits, so half a unit of the fourth: at most 5e-4 relative.
            let is_near = |a: f64, b: f64| (a - b).abs() <= 5e-4 * b;
            assert!(is_near(material.mean_free_path_mm[channel], 1.0 / extinction), "{name} {channel}");
            assert!(is_near(material.surface_albedo[channel], surface_albedo), "{name} {channel}");
        }
    }
}

#[test]
fn every_preset_says_what_it_is() {
    for material in presets().materials {
        assert!(!material.docs.is_empty(), "{}", material.name);
        let says_source =
            material.docs.iter().any(|line| line.contains("Jensen") || line.contains("our own"));
        assert!(says_source, "{} does not say where its values come from", material.name);
    }
}

#[test]
fn the_example_of_the_readme_is_what_the_compiler_says() {
    let text = "Material(\n    profile: \"two_exponential_dipole_serchlight\",\n    mean_free_path_mm: (1.30, 0.95, -0.67),\n    surface_albedo: (0.83, 0.64, 0.55),\n)\n";
    let report = load_memory([("skin.ron", text)]).report.render(false);
    let readme = std::fs::read_to_string("materials/README.md").unwrap();
    assert!(readme.contains(&report), "materials/README.md should show:\n{report}");
}
