//! The data in `materials/`: it loads without a word, and its numbers are those of their sources.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

use std::ops::ControlFlow;
use std::path::Path;

use subsurface_codegen::{MaterialSet, load_directory, load_memory, load_profile_file};
use subsurface_profile::Model;
use subsurface_reference::Entry::Searchlight;
use subsurface_reference::{Goal, HalfSpace, Run};

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

/// Refractive index, reduced scattering and absorption per mm, red, green and blue (Jensen et al. 2001, figure 5).
const JENSEN_2001: [(&str, f64, [f64; 3], [f64; 3]); 7] = [
    ("apple", 1.3, [2.29, 2.39, 1.97], [0.0030, 0.0034, 0.046]),
    ("ketchup", 1.3, [0.18, 0.07, 0.03], [0.061, 0.97, 1.45]),
    ("marble", 1.5, [2.19, 2.62, 3.00], [0.0021, 0.0041, 0.0071]),
    ("potato", 1.3, [0.68, 0.70, 0.55], [0.0024, 0.0090, 0.12]),
    ("skimmilk", 1.3, [0.70, 1.22, 1.90], [0.0014, 0.0025, 0.0142]),
    ("skin_medium", 1.3, [1.09, 1.59, 1.79], [0.013, 0.070, 0.145]),
    ("wholemilk", 1.3, [2.55, 3.21, 3.77], [0.0011, 0.0024, 0.014]),
];

#[test]
fn measured_materials_reflect_what_walks_do_at_their_index() {
    let presets = presets();
    for index in [1.3, 1.5] {
        let half_space = HalfSpace::new(Searchlight, 0.0, index).unwrap();
        let mut run = Run::new(half_space, 13);
        run.simulate(&Goal::photons(262_144).unwrap(), &mut |_| ControlFlow::Continue(()));
        for (name, _, scattering, absorption) in JENSEN_2001.into_iter().filter(|row| row.1 == index) {
            let material = presets.get(name).unwrap();
            assert_eq!(material.refractive_index, Some(index), "{name}");
            let reflectance = ((index - 1.0) / (index + 1.0)).powi(2);
            assert!((material.reflectance_at_normal - reflectance).abs() < 1e-12, "{name}");
            for channel in 0..3 {
                let extinction = scattering[channel] + absorption[channel];
                assert!((material.mean_free_path_mm[channel] * extinction - 1.0).abs() < 1e-12, "{name}");
                let total = run.surface_albedo(scattering[channel] / extinction).unwrap().mean;
                let found = material.surface_albedo[channel];
                // Noise of so many walks is 0.001, and the fit's own error less.
                assert!((found - total).abs() < 0.004, "{name} {channel}: {found}, walks say {total}");
            }
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
