//! Tables of radial data: what is read, what is refused and in which words, and what comes out.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

use std::f64::consts::PI;
use std::fs;
use std::path::{Path, PathBuf};

use subsurface_codegen::{
    Compilation, Compiler, Loaded, check_paths, load_directory, load_memory, load_profile_file,
    load_radial_table,
};
use subsurface_profile::{Channel, Medium, Model, RadialData};

fn assert_blessed(folder: &str, name: &str, text: &str) {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(Path::new("out").join(folder));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!(name, text));
}

fn material(profile: &str) -> String {
    format!("Material(profile: {profile}, mean_free_path_mm: (1, 1, 1), surface_albedo: (0.5, 0.5, 0.5))")
}

/// A set of one material, whose profile is the table.
fn load(csv: impl AsRef<[u8]>) -> Loaded {
    let ron = material("Tabulated(file: \"t.csv\")");
    load_memory([("m.ron", ron.as_bytes()), ("t.csv", csv.as_ref())])
}

/// Tables that are none, each by what is wrong with it.
const REFUSED: [(&str, &str); 41] = [
    ("an empty file", ""),
    ("nothing but comments", "# surface_albedo,r,reflectance\n\n"),
    ("nothing but a header", "surface_albedo,r,r_reflectance\n"),
    ("no header", "0.5,0,0.1\n0.5,1,0.05\n"),
    ("semicolons", "surface_albedo;r;r_reflectance\n0,5;0;0,1\n"),
    ("tabulators", "surface_albedo\tr\tr_reflectance\n0.5\t0\t0.1\n"),
    ("no radius", "surface_albedo,r_reflectance\n0.5,0.1\n0.5,0.05\n"),
    ("capitals", "surface_albedo,R,r_reflectance\n0.5,0,0.1\n0.5,1,0.05\n"),
    ("no outer radius", "r_lo,r_reflectance\n0,0.1\n1,0.05\n"),
    ("no inner radius", "r_hi,r_reflectance\n1,0.1\n2,0.05\n"),
    ("no value", "surface_albedo,r\n0.5,0\n0.5,1\n"),
    ("a misspelt value", "surface_albedo,r,radial_reflectence\n0.5,0,0.1\n0.5,1,0.05\n"),
    ("two values", "r,reflectance,r_reflectance\n0,0.1,0\n1,0.05,0.05\n"),
    ("points and bins", "r,r_lo,r_hi,r_reflectance\n0,0,1,0.1\n1,1,2,0.05\n"),
    ("a column twice", "r,r,r_reflectance\n0,0,0.1\n1,1,0.05\n"),
    ("too few cells", "surface_albedo,r,r_reflectance\n0.5,0,0.1\n0.5,1\n"),
    ("decimal commas", "surface_albedo,r,r_reflectance\n0,5,0,0,1\n0,5,1,0,05\n"),
    ("words", "r,r_reflectance\n0,0.1\none,0.05\n2,n/a\n"),
    ("other notations", "r,r_reflectance\n0x10,0.1\n1_000,0.05\n1,5%\n"),
    ("empty cells", "surface_albedo,r,r_reflectance\n0.5,0,0.1\n,1,\n"),
    ("not a number", "r,r_reflectance\nNaN,0.1\n1,nan\n"),
    ("infinite", "r,r_reflectance,standard_error\n0,0.1,inf\n1,1e400,0\ninf,0,0\n"),
    ("negative", "r,r_reflectance,standard_error\n-1,0.1,0\n1,-0.01,0\n2,0.01,-0.1\n"),
    ("radii out of range", "r,r_reflectance\n0,0.1\n1e-300,0.1\n1e300,0.1\n"),
    ("surface albedos out of range", "surface_albedo,r,r_reflectance\n0,0,0.1\n1.2,1,0.1\n-1,2,0.1\n"),
    ("not sorted", "r,r_reflectance\n0,0.1\n2,0.05\n1,0.07\n"),
    ("a radius twice", "r,r_reflectance\n0,0.1\n1,0.05\n1,0.05\n"),
    ("a table twice", "surface_albedo,r,r_reflectance\n0.5,0,0.1\n0.5,1,0.05\n0.5,0,0.1\n0.5,1,0.05\n"),
    ("bins that overlap", "r_lo,r_hi,r_reflectance\n0,1,0.05\n0.5,2,0.02\n"),
    ("a bin without width", "r_lo,r_hi,r_reflectance\n0,1,0.05\n1,1,0.02\n"),
    ("a bin that is reversed", "r_lo,r_hi,r_reflectance\n0,1,0.05\n2,1,0.02\n"),
    ("a gap", "r_lo,r_hi,r_reflectance\n0,1,0.05\n1.5,2,0.02\n"),
    ("a late start", "surface_albedo,r_lo,r_hi,r_reflectance\n0.5,0.5,1,0.05\n0.5,1,2,0.05\n"),
    ("one row", "r,r_reflectance\n0,0.1\n"),
    ("one row of one surface albedo", "surface_albedo,r,r_reflectance\n0.2,0,0.05\n0.5,0,0.1\n0.5,1,0.05\n"),
    ("no light", "surface_albedo,r,r_reflectance\n0.5,0,0\n0.5,1,0.0\n0.5,2,-0\n"),
    ("more than all light", "r,reflectance\n0,40\n1,40\n2,40\n"),
    ("radii too close", "surface_albedo,r,r_reflectance\n0.5,0,0.1\n0.5,1,0.05\n0.5,1.00000001,0.05\n"),
    ("zero bytes", "r,r_reflectance\n0,0.1\n\0\0\0\0"),
    ("a quote that does not end", "r,r_reflectance\n0,\"0.1\n1,0.05\n2,0.01\n"),
    ("a web page", "<!DOCTYPE html>\n<html><body>404, not found</body></html>\n"),
];

#[test]
fn refused_tables_keep_their_exact_message() {
    let mut text = String::new();
    for (case, csv) in REFUSED {
        let loaded = load(csv);
        assert!(loaded.set.is_none() && loaded.report.has_errors(), "{case} is accepted");
        for diagnostic in loaded.report.iter() {
            assert!(!diagnostic.help.is_empty(), "{case}: no remedy");
            let (span, label) = diagnostic.primary.as_ref().unwrap();
            assert!(loaded.report.sources().path(span.file) == "t.csv" && !label.is_empty(), "{case}");
        }
        text += &format!("── {case} ──\n{}\n", loaded.report.render(false));
    }
    assert_blessed("errors", "tables", &text);
}

#[test]
fn what_is_too_much_to_list_is_counted_where_it_stands() {
    let errors = load(format!("r,r_reflectance\n{}", "x,1\n".repeat(150)));
    let last = errors.report.iter().find(|diagnostic| diagnostic.message.contains("further")).unwrap();
    assert_eq!(last.message, "50 further errors of this file are not listed");
    assert_eq!(errors.report.sources().path(last.primary.as_ref().unwrap().0.file), "t.csv");
    // Warnings do not become an error by their number.
    let rows = |n: u32| format!("{0},0,1\n{0},1,1\n", f64::from(n) / 101.0);
    let warnings =
        load(format!("surface_albedo,r,r_reflectance\n{}", (1..=101).map(rows).collect::<String>()));
    assert!(warnings.set.is_some(), "{}", warnings.report);
    assert!(warnings.report.iter().any(|d| d.message == "1 further warning of this file is not listed"));
}

#[test]
fn files_that_hold_no_table_are_refused() {
    let dir = tempfile::tempdir().unwrap();
    fs::create_dir(dir.path().join("folder.csv")).unwrap();
    fs::write(dir.path().join("picture.csv"), b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR").unwrap();
    fs::write(dir.path().join("huge.csv"), vec![b'#'; 17 * 1024 * 1024]).unwrap();
    let mut names = ["folder.csv", "picture.csv", "huge.csv", "missing.csv", "", "C:\\data\\mine.csv"]
        .map(|name| format!("Tabulated(file: {name:?})"))
        .to_vec();
    names.extend(
        [
            "Tabulated",
            "Tabulated(5)",
            "Tabulated(file: 5)",
            "Tabulated(fle: \"a.csv\")",
            "Tabulated(\"a.csv\")",
        ]
        .map(str::to_owned),
    );
    for (number, profile) in names.iter().enumerate() {
        fs::write(dir.path().join(format!("m{number:02}.ron")), material(profile)).unwrap();
    }
    let loaded = load_directory(dir.path());
    assert!(loaded.set.is_none());
    for number in 0..names.len() {
        let place = format!("m{number:02}.ron");
        let report = check_paths(&[dir.path().join(&place)]).report;
        assert!(report.has_errors(), "{place} alone is accepted");
    }
    let text = loaded.report.render(false).replace(&dir.path().to_string_lossy().replace('\\', "/"), "DIR");
    assert_blessed("errors", "tables_that_cannot_be_read", &text);
}

#[test]
fn the_three_measures_say_the_same_and_columns_have_no_order() {
    let model = |csv: &str| {
        let loaded = load(csv);
        let set = loaded.set.unwrap_or_else(|| panic!("{}", loaded.report));
        set.materials[0].profile.model.clone()
    };
    let at = |model: &Model, r: f64| {
        let medium = Medium::new(0.5, 1.0).unwrap();
        model.profile(medium, Channel::Red).unwrap().radial_cdf(r)
    };
    // R is the mean over the ring, so that r·R has the mean R (r_lo + r_hi)/2.
    let r = model("surface_albedo,r_lo,r_hi,reflectance\n0.3,0,1,0.1\n0.3,1,3,0.02\n");
    let r_r = model("r_hi,\"r_lo\",r_reflectance,surface_albedo\r\n1,0,0.05,0.3\r\n3,1,0.04,0.3\r\n");
    let radial = model("\u{feff}r_lo , r_hi, radial_reflectance\n0,1, 0.1\n1,3,0.08\n");
    for radius in [0.1, 0.5, 1.0, 2.0, 2.9] {
        assert!((at(&r, radius) - at(&r_r, radius)).abs() < 1e-15);
        assert!((at(&r, radius) - at(&radial, radius)).abs() < 1e-15);
    }
    // 0.05 of 0.13 within the first bin, exactly.
    assert!((at(&r, 1.0) - 0.05 / 0.13).abs() < 1e-15);
}

#[test]
fn a_table_is_read_for_fits_as_it_is_for_materials() {
    let path = Path::new("tests/in/pass/tabulated/tables/bins.csv");
    let loaded = load_radial_table(path);
    assert!(loaded.report.is_empty(), "{}", loaded.report);
    assert_eq!(loaded.files_read, [path]);
    let data = loaded.data.unwrap();
    assert_eq!(data.iter().map(RadialData::surface_albedo).collect::<Vec<_>>(), [0.4, 0.8]);
    assert_eq!(data[0].rows().len(), 5);
    assert_eq!(data[0].rows()[0].standard_error, Some(0.001));
    assert_eq!(data[0].rows()[4].standard_error, None);
    // Without a surface albedo the integral stands for it, what the profile has before the first point included.
    let one = load_radial_table(Path::new("tests/in/pass/tabulated/tables/points.csv")).data.unwrap();
    let before_first = 2.0 * PI * (0.05 * 0.9) * 0.05;
    // Roundings of seven areas.
    assert!((one[0].surface_albedo() - one[0].energy() - before_first).abs() < 1e-15);
    assert!(check_paths(&[path.to_owned()]).report.is_empty());
    let bad = Path::new("tests/in/fail/table_not_sorted/profiles/measured.csv");
    assert!(load_radial_table(bad).data.is_none());
    assert!(check_paths(&[bad.to_owned()]).report.has_errors());
    assert!(load_radial_table(Path::new("tests/in/no_such_table.csv")).report.has_errors());
}

#[test]
fn energy_before_the_first_point_counts() {
    let warnings = |csv: &str| {
        let loaded = load(csv);
        assert!(loaded.set.is_some(), "{}", loaded.report);
        loaded.report.iter().map(|diagnostic| diagnostic.message.clone()).collect::<Vec<_>>()
    };
    // r R is 0.08 up to r = 0.9 and falls to 0 at 1.1: 2π·0.08·0.9 = 0.452 before the first point and 0.050 after it.
    let usual = "surface_albedo,r,r_reflectance\n0.5,0.9,0.08\n0.5,1.1,0\n";
    assert_eq!(warnings(usual), [""; 0]);
    // Of 0.4 that is 1.257 times as much, though the points alone hold an eighth.
    let too_much = usual.replace("0.5,", "0.4,");
    assert_eq!(warnings(&too_much), ["the table of surface albedo 0.4 integrates to 1.257 times that"]);
    // Without a surface albedo it is more than all light, though the points alone hold an eighth.
    let refused = load("r,r_reflectance\n0.9,0.2\n1.1,0\n").report.render(false);
    assert!(refused.contains("the table integrates to 1.257, more than all light"), "{refused}");
}

#[test]
fn a_single_table_is_the_shape_for_every_surface_albedo() {
    let one = "surface_albedo,r,r_reflectance\n0.8,0,0.1\n0.8,2.5,0\n";
    assert!(load(one).report.is_empty(), "{}", load(one).report);
    // The material has 0.5: outside of two tables, unless one means the same with other digits, or it is black.
    let outside = |least: &str, surface_albedo: &str| {
        let csv = format!(
            "{}{}",
            one,
            one.lines().skip(1).map(|row| row.replace("0.8,", least) + "\n").collect::<String>()
        );
        let ron = material("Tabulated(file: \"t.csv\")").replace("0.5, 0.5, 0.5", surface_albedo);
        let loaded = load_memory([("m.ron", ron), ("t.csv", csv)]);
        assert!(loaded.set.is_some(), "{}", loaded.report);
        loaded.report.iter().any(|diagnostic| diagnostic.message.contains("outside of the table"))
    };
    assert!(outside("0.6,", "0.5, 0.7, 0.7") && outside("0.501,", "0.5, 0.7, 0.7"));
    assert!(outside("0.6,", "0.7, 0.7, 0.801") && outside("0.6,", "0.7, 1e-6, 0.7"));
    assert!(!outside("0.5005,", "0.5, 0.7, 0.8005") && !outside("0.6,", "0.7, 0, 0.7"));
}

#[test]
fn a_build_depends_on_its_tables() {
    let dir = Path::new("tests/in/pass/tabulated");
    let loaded = load_directory(dir);
    let tables: Vec<&PathBuf> =
        loaded.files_read.iter().filter(|path| path.extension().is_some_and(|e| e == "csv")).collect();
    assert_eq!(tables, [&dir.join("profiles/../tables/points.csv"), &dir.join("tables/bins.csv")]);
    let alone = load_profile_file(&dir.join("profiles/measured.ron"));
    assert!(alone.profile.is_some() && alone.files_read.len() == 2, "{}", alone.report);
    // A changed table is another kernel.
    let compile = |csv: &str| {
        let ron = material("Tabulated(file: \"./tables/../t.csv\")");
        Compiler::from_memory([("m.ron", ron.as_str()), ("t.csv", csv)]).compile().unwrap()
    };
    let (one, other) =
        (compile("r,r_reflectance\n0,0.1\n1,0.05\n"), compile("r,r_reflectance\n0,0.1\n1,0.06\n"));
    assert!(one.provenance != other.provenance && one.parts.profile_tables() != other.parts.profile_tables());
    assert_eq!(one.wgsl().replace(&one.provenance, ""), other.wgsl().replace(&other.provenance, ""));
}

#[test]
fn a_set_of_tables_compiles_to_the_blessed_texts() {
    let compilation = Compiler::new("tests/in/pass/tabulated").without_gbuffer().compile();
    let compilation = compilation.unwrap_or_else(|report| panic!("{report}"));
    for (folder, text) in
        [("wgsl", compilation.wgsl()), ("rust", &compilation.rust), ("manifest", &compilation.manifest)]
    {
        assert_blessed(folder, "tabulated", &text.replace(&compilation.provenance, "<sha256>"));
    }
    // Two surface albedos at the common radii 0, 0.25, 0.5, 1, 2, 3, 4, 9, and one at the points and 0.
    assert_eq!(compilation.parts.profile_tables().len(), 20 * (2 * 8 + 7));
    let dir = tempfile::tempdir().unwrap();
    compilation.write_to(dir.path()).unwrap();
    assert_eq!(fs::read(dir.path().join("subsurface.tables")).unwrap(), compilation.parts.profile_tables());
    let without = Compiler::new("tests/in/pass/one_model").compile().unwrap();
    assert!(without.parts.profile_tables().is_empty() && !without.manifest.contains("profile_tables"));
}

#[test]
fn a_kernel_has_the_profile_tables_that_its_module_reads_or_is_none() {
    use subsurface_kernel::{KernelParts, PartsError};
    let parts = |compilation: &Compilation, profile_tables: &[u8]| {
        let parts = &compilation.parts;
        KernelParts::builder(parts.module().clone())
            .materials(
                compilation.material_names(),
                parts.material_rows().to_vec(),
                parts.module().row_stride(),
            )
            .profile_curves(parts.profile_curves().to_vec(), parts.curve_size())
            .profile_tables(profile_tables.to_vec())
            .build()
    };
    let with = Compiler::new("tests/in/pass/tabulated").compile().unwrap();
    let without = Compiler::new("tests/in/pass/one_model").compile().unwrap();
    let tables = with.parts.profile_tables();
    assert_eq!(parts(&with, tables).as_ref(), Ok(&with.parts));
    assert_eq!(parts(&without, &[]).as_ref(), Ok(&without.parts));
    assert_eq!(parts(&with, &[]), Err(PartsError::ProfileTables { bytes: 0, stride: 20 }));
    assert_eq!(parts(&without, tables), Err(PartsError::UnreadProfileTables { bytes: tables.len() }));
}

#[test]
fn equal_tables_are_stored_once() {
    let csv = "r,r_reflectance\n0,0.1\n1,0.05\n2,0\n";
    let [a, b] = [material("Tabulated(file: \"t.csv\")"), material("Tabulated(file: \"u.csv\")")];
    let files = [("a.ron", a.as_str()), ("b.ron", &b), ("t.csv", csv), ("u.csv", csv)];
    assert_eq!(Compiler::from_memory(files).compile().unwrap().parts.profile_tables().len(), 3 * 20);
}
