//! Material directories in, blessed diagnostics out: `tests/in/{fail,warn,pass,out_of_reach}/CASE` and
//! `tests/out/errors/CASE.snap`.
//!
//! A case is a small materials directory. The test itself writes cases that should not lie in a repository (10 MB, bytes
//! that are no text). After a change: `cargo xtask bless -p subsurface-codegen`, and read the difference.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

use std::fs;
use std::path::{Path, PathBuf};

use subsurface_codegen::{Compiler, Loaded, check_paths, load_directory, load_profile, load_profile_file};

/// Compares `text` with the blessed `tests/out/errors/CASE.snap`.
fn assert_blessed(case: &str, text: &str) {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("out/errors");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!(case, text));
}

/// The directories in `tests/in/KIND`, sorted. Tests run in the root of the package, so paths in texts are relative.
fn cases(kind: &str) -> Vec<(String, PathBuf)> {
    let mut cases: Vec<_> = fs::read_dir(Path::new("tests/in").join(kind))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .map(|name| (name.clone(), Path::new("tests/in").join(kind).join(name)))
        .collect();
    cases.sort();
    assert!(!cases.is_empty());
    cases
}

/// Every diagnostic of a file with a place says where, and every one says what to do.
fn assert_well_formed(loaded: &Loaded) {
    for diagnostic in loaded.report.iter() {
        assert!(!diagnostic.help.is_empty(), "no remedy: {}", diagnostic.message);
        assert!(diagnostic.help.iter().all(|help| !help.contains('\n')), "{:?}", diagnostic.help);
        if let Some((span, label)) = &diagnostic.primary {
            assert!(!label.is_empty(), "no label: {}", diagnostic.message);
            let text = loaded.report.sources().text(span.file);
            assert!(text.get(span.range.clone()).is_some(), "no text at the span: {}", diagnostic.message);
        }
    }
}

#[test]
fn rejected_sets_keep_their_exact_message() {
    for (case, dir) in cases("fail") {
        let loaded = load_directory(&dir);
        assert!(loaded.set.is_none(), "{case} is accepted");
        assert!(loaded.report.has_errors(), "{case} has no error");
        assert_well_formed(&loaded);
        assert_blessed(&case, &loaded.report.render(false));
    }
}

#[test]
fn suspect_sets_are_accepted_with_a_warning() {
    for (case, dir) in cases("warn") {
        let loaded = load_directory(&dir);
        assert!(loaded.set.is_some(), "{case} is rejected:\n{}", loaded.report);
        assert!(loaded.report.warnings().next().is_some(), "{case} has no warning");
        assert_well_formed(&loaded);
        assert_blessed(&case, &loaded.report.render(false));
    }
}

#[test]
fn accepted_sets_say_nothing() {
    for (case, dir) in cases("pass") {
        let loaded = load_directory(&dir);
        assert!(loaded.report.is_empty(), "{case}:\n{}", loaded.report);
        assert!(loaded.set.is_some(), "{case}");
    }
}

#[test]
fn sets_that_ask_for_too_much_keep_their_exact_message() {
    for (case, dir) in cases("out_of_reach") {
        // All is well with the files; the error is in what they amount to.
        assert!(load_directory(&dir).report.is_empty(), "{case}");
        let report = Compiler::new(&dir).compile().unwrap_err();
        assert!(report.errors().all(|error| error.primary.is_some() && !error.help.is_empty()), "{report}");
        assert_blessed(&format!("out_of_reach_of_{case}"), &report.render(false));
    }
}

#[test]
fn a_material_inherits_what_it_does_not_give() {
    let set = load_directory(Path::new("tests/in/pass/every_form")).set.unwrap();
    let names: Vec<&str> = set.materials.iter().map(|material| material.name.as_str()).collect();
    let expected = [
        "builtin",
        "child",
        "classical_dipole",
        "dipole",
        "dmfp",
        "everything",
        "gaussian",
        "mixture",
        "polynomial",
        "renamed",
        "two_exponentials",
    ];
    assert_eq!(names, expected);
    let (base, child) = (set.get("everything").unwrap(), set.get("child").unwrap());
    assert_eq!(base.docs, ["Everything that can be given.", "", " Indented, with `code`."]);
    assert!(child.docs.is_empty());
    assert_eq!(child.surface_albedo, [0.1, 0.2, 0.3]);
    assert_eq!(child.mean_free_path_mm, base.mean_free_path_mm);
    assert_eq!(child.profile.model, base.profile.model);
    assert_eq!((child.reflectance_at_normal, child.roughness), (0.04, 0.6));
    assert_eq!(child.transmission_strength, 0.5);
    let defaults = set.get("dipole").unwrap();
    assert_eq!((defaults.reflectance_at_normal, defaults.roughness), (0.028, 0.4));
    assert_eq!(defaults.transmission_strength, 1.0);
}

#[test]
fn a_profile_keeps_the_name_and_docs_of_the_file_that_writes_it_out() {
    let set = load_directory(Path::new("tests/in/pass/every_form")).set.unwrap();
    let profile = |name: &str| set.get(name).unwrap().profile.clone();
    assert_eq!(profile("renamed").stem.as_deref(), Some("mine"));
    assert_eq!(profile("renamed").docs, ["My own fit."]);
    assert_eq!(profile("builtin").stem.as_deref(), Some("gaussian_skin"));
    assert_eq!(profile("dipole").stem, None);
}

/// A set that exists for this test alone; its directory is shown as `DIR`.
fn generated(case: &str, files: &[(&str, &[u8])]) {
    let dir = tempfile::tempdir().unwrap();
    for (name, bytes) in files {
        fs::write(dir.path().join(name), bytes).unwrap();
    }
    let loaded = load_directory(dir.path());
    assert!(loaded.set.is_none(), "{case} is accepted");
    assert_well_formed(&loaded);
    let text = loaded.report.render(false).replace(&dir.path().to_string_lossy().replace('\\', "/"), "DIR");
    // The longest lists the built-in profiles: 370 characters.
    assert!(text.lines().all(|line| line.chars().count() < 410), "a line is too long to read");
    assert_blessed(case, &text);
}

/// A material that is fine.
const GOOD: &str = "Material(\n    profile: \"burley_searchlight\",\n    mean_free_path_mm: (1.3, 0.95, 0.67),\n    \
                    surface_albedo: (0.83, 0.64, 0.55),\n)\n";

#[test]
fn a_file_that_is_not_utf_8() {
    let mut latin_1 = GOOD.replace("Material(", "// Gr\u{1}\u{2}e\nMaterial(").into_bytes();
    for byte in &mut latin_1 {
        *byte = match *byte {
            1 => 0xF6, // ö in Latin-1
            2 => 0xDF, // ß
            _ => *byte,
        };
    }
    generated("not_utf_8", &[("skin.ron", &latin_1), ("jade.ron", b"\xFF\xFEM\0a\0t\0")]);
}

#[test]
fn a_file_of_10_megabytes() {
    generated("ten_megabytes", &[("skin.ron", &vec![b' '; 10_000_000])]);
}

#[test]
fn nesting_10_000_deep() {
    let open = "(".repeat(10_000);
    let closed = format!("Material(profile: {}{})", "[".repeat(10_000), "]".repeat(10_000));
    generated("nested_10_000_deep", &[("open.ron", open.as_bytes()), ("closed.ron", closed.as_bytes())]);
}

#[test]
fn a_name_of_300_characters() {
    let long = "a".repeat(300);
    let named = GOOD.replace("profile:", &format!("name: \"{long}\", profile:"));
    let field = GOOD.replace("profile:", &format!("{long}: 1, profile:"));
    let profile = GOOD.replace("burley_searchlight", &long);
    generated(
        "name_of_300_characters",
        &[
            ("named.ron", named.as_bytes()),
            ("field.ron", field.as_bytes()),
            ("profile.ron", profile.as_bytes()),
        ],
    );
}

#[test]
fn windows_line_ends_a_byte_order_mark_and_accents() {
    let text = GOOD.replace("(1.3, 0.95, 0.67)", "/* größer */ (1.3, \"ä\", -0.67)").replace('\n', "\r\n");
    let text = format!("\u{feff}/// Größe in µm.\r\n{text}");
    generated("windows_line_ends_and_accents", &[("skin.ron", text.as_bytes())]);
}

#[test]
fn the_101st_error_of_a_file_is_counted_and_not_listed() {
    let terms = "(variance_mm2: -1, weight: 1), ".repeat(150);
    let text = GOOD.replace("\"burley_searchlight\"", &format!("GaussianSum([{terms}])"));
    let loaded = subsurface_codegen::load_memory([("skin.ron", text)]);
    assert_eq!(loaded.report.errors().count(), 101);
    let last = loaded.report.errors().last().unwrap();
    assert_eq!(last.message, "50 further errors of this file are not listed");
}

#[test]
fn a_directory_that_does_not_exist_and_one_that_is_a_file() {
    let missing = load_directory(Path::new("tests/in/no_such_directory"));
    let file = load_directory(Path::new("tests/in/pass/every_form/base.ron"));
    assert!(missing.set.is_none() && file.set.is_none());
    assert_blessed("directory_missing", &missing.report.render(false));
    assert_blessed("directory_is_a_file", &file.report.render(false));
}

#[test]
fn exactly_the_files_read_are_listed_and_sorted() {
    let loaded = load_directory(Path::new("tests/in/pass/every_form"));
    let mut expected: Vec<PathBuf> = ["", "profiles"]
        .iter()
        .flat_map(|folder| fs::read_dir(Path::new("tests/in/pass/every_form").join(folder)).unwrap())
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "ron"))
        .collect();
    expected.sort();
    assert_eq!(loaded.files_read, expected);
    let dir = Path::new("tests/in/pass/every_form");
    assert_eq!(loaded.directories_read, [dir.to_owned(), dir.join("profiles")]);
}

#[test]
fn a_report_reads_the_same_in_every_run() {
    for (_, dir) in cases("fail") {
        assert_eq!(load_directory(&dir).report.render(false), load_directory(&dir).report.render(false));
    }
}

#[test]
fn a_report_as_data_has_the_places_of_the_text() {
    let loaded = load_directory(Path::new("tests/in/fail/unknown_field"));
    let data = loaded.report.to_json();
    let text = loaded.report.render(false);
    let list = data.as_array().unwrap();
    assert_eq!(list.len(), loaded.report.iter().count());
    for diagnostic in list {
        let place = format!(
            "{}:{}:{}",
            diagnostic["file"].as_str().unwrap(),
            diagnostic["line"],
            diagnostic["column"]
        );
        assert!(text.contains(&place), "{place}");
        assert_eq!(diagnostic["severity"], "error");
        assert!(diagnostic["end_column"].as_u64() > diagnostic["column"].as_u64());
        assert!(diagnostic["help"].as_array().is_some_and(|help| !help.is_empty()));
    }
}

#[test]
fn colours_change_no_text() {
    let report = load_directory(Path::new("tests/in/fail/unknown_field")).report;
    let coloured = report.render(true);
    assert!(coloured.contains('\u{1b}'));
    let mut plain = String::new();
    for (index, part) in coloured.split('\u{1b}').enumerate() {
        plain.push_str(if index == 0 { part } else { part.split_once('m').unwrap().1 });
    }
    let words = |text: &str| text.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
    assert_eq!(words(&plain), words(&report.render(false)));
}

#[test]
fn one_file_is_checked_with_what_it_uses_and_without_what_it_does_not() {
    let check = |path: &str| check_paths(&[PathBuf::from(path)]).report;
    assert!(check("tests/in/pass/every_form/child.ron").is_empty());
    assert!(check("tests/in/pass/every_form/profiles/mine.ron").is_empty());
    assert!(check("tests/in/pass/every_form/profiles").is_empty());
    assert!(check("tests/in/pass/every_form").is_empty());

    // `jade.ron` of this set has errors of its own, which do not concern `skin.ron`.
    let report = check("tests/in/fail/wrong_type_in_profile/skin.ron");
    assert!(report.has_errors());
    let files: Vec<&str> = report
        .iter()
        .filter_map(|d| d.primary.as_ref())
        .map(|(span, _)| report.sources().path(span.file))
        .collect();
    assert!(files.iter().all(|file| file.ends_with("profiles/mine.ron")), "{files:?}");

    // The file of a set is checked as one, with what is wrong elsewhere left out.
    assert!(check("tests/in/pass/described_set/set.ron").is_empty());
    let report = check("tests/in/fail/set_of_unknown_words/set.ron");
    assert_eq!(report.errors().count(), 5, "{report}");
    let report = check("tests/in/fail/two_sets/set.ron");
    let messages: Vec<&str> = report.errors().map(|error| error.message.as_str()).collect();
    assert_eq!(messages, ["two files describe this set", "`Interleaved` with 0 taps"]);

    assert!(check("tests/in/fail/import_cycle_of_profiles/profiles/a.ron").has_errors());
    assert!(check("tests/in/no_such_file.ron").has_errors());
    let twice = [PathBuf::from("tests/in/fail/unknown_field"), PathBuf::from("tests/in/fail/unknown_base")];
    let both = check_paths(&twice).report.errors().count();
    assert_eq!(both, twice.iter().map(|path| load_directory(path).report.errors().count()).sum::<usize>());
}

#[test]
fn a_profile_is_found_by_path_and_by_stem() {
    let dir = Path::new("tests/in/pass/every_form");
    let by_path = load_profile_file(&dir.join("profiles/same_as_diffuse.ron")).profile.unwrap();
    let by_stem = load_profile(dir, "same_as_diffuse").profile.unwrap();
    assert_eq!(by_path.model, by_stem.model);
    assert_eq!(by_path.stem.as_deref(), Some("mine"));
    assert_eq!(by_path.docs, ["My own fit."]);

    let builtin = load_profile(Path::new("tests/in/no_such_directory"), "liang_2023").profile.unwrap();
    assert_eq!(Some(builtin.model), subsurface_profile::Model::published("liang_2023"));

    let unknown = load_profile(dir, "laing_2023");
    assert!(unknown.profile.is_none());
    assert_blessed("profile_by_unknown_stem", &unknown.report.render(false));
}
