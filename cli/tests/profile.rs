//! `subsurface profile`: the laws of a profile, read back from the printed numbers.
#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use std::process::{Command, Output};
use subsurface_profile::Model;

fn profile(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_subsurface")).arg("profile").args(arguments).output().unwrap()
}

/// The `# name = value` lines and the rows.
fn table(output: &Output, header: &str) -> (Vec<(String, String)>, Vec<Vec<f64>>) {
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout.clone()).unwrap();
    let (comments, rows): (Vec<&str>, Vec<&str>) = text.lines().partition(|line| line.starts_with('#'));
    let value = |line: &str| {
        let (name, value) = line.trim_start_matches("# ").split_once(" = ")?;
        Some((name.to_owned(), value.to_owned()))
    };
    assert_eq!(rows[0], header);
    let numbers = |row: &&str| row.split(',').map(|number| number.parse().unwrap()).collect();
    (comments.into_iter().filter_map(value).collect(), rows[1..].iter().map(numbers).collect())
}

fn eval(model: &str, extra: &[&str]) -> (Vec<(String, String)>, Vec<Vec<f64>>) {
    let common = ["eval", "--model", model, "--surface-albedo", "0.83", "--mean-free-path-mm", "1.3"];
    table(&profile(&[&common, extra].concat()), "radius_mm,area_pdf,radial_pdf,radial_cdf")
}

fn number(comments: &[(String, String)], name: &str) -> Option<f64> {
    comments.iter().find(|(known, _)| known == name).map(|(_, value)| value.parse().unwrap())
}

#[test]
fn the_three_measures_of_a_row_agree() {
    for model in Model::PUBLISHED {
        let (_, rows) = eval(model, &["--radii", "0,0.01,0.1,0.5,1,2,5,20,100"]);
        let mut last = 0.0;
        for row in &rows {
            let [radius, area_pdf, radial_pdf, radial_cdf] = row[..] else { panic!("{row:?}") };
            assert!(area_pdf >= 0.0 && radial_pdf >= 0.0 && radial_pdf.is_finite());
            assert!((0.0..=1.0).contains(&radial_cdf) && radial_cdf >= last, "{model}: {row:?}");
            last = radial_cdf;
            if radius > 0.0 {
                let expected = std::f64::consts::TAU * radius * area_pdf;
                // A handful of roundings of f64.
                assert!((radial_pdf - expected).abs() <= 1e-13 * expected, "{model}: {row:?}");
            }
        }
        assert_eq!(rows[0][3], 0.0, "{model}");
    }
}

#[test]
fn the_density_is_the_slope_of_the_distribution() {
    for model in Model::PUBLISHED {
        let (_, rows) = eval(model, &["--radii", "0.699999,0.7,0.700001"]);
        let slope = (rows[2][3] - rows[0][3]) / (rows[2][0] - rows[0][0]);
        // The difference quotient cancels: 1e-16 / 2e-6 of rounding, 1e-12 of truncation.
        assert!((slope - rows[1][2]).abs() < 1e-8 * (1.0 + rows[1][2]), "{model}: {slope} {}", rows[1][2]);
    }
}

#[test]
fn a_sampled_radius_holds_the_fraction_that_was_asked_for() {
    let fractions = ["0.0", "1e-6", "0.25", "0.5", "0.9", "0.997"];
    for model in Model::PUBLISHED {
        let common = ["sample", "--model", model, "--surface-albedo", "0.83", "--mean-free-path-mm", "1.3"];
        let output = profile(&[&common[..], &["--u", &fractions.join(",")]].concat());
        let (_, samples) = table(&output, "u,radius_mm");
        let radii: Vec<String> = samples.iter().map(|row| format!("{:?}", row[1])).collect();
        let (comments, rows) = eval(model, &["--radii", &radii.join(",")]);
        for (sample, row) in samples.iter().zip(&rows) {
            assert_eq!(sample[1], row[0], "{model}: numbers must survive printing");
            // The inverse solves to a few roundings of the distribution.
            assert!((sample[0] - row[3]).abs() < 1e-12, "{model}: {sample:?} {row:?}");
        }
        assert_eq!(number(&comments, "filter_radius_mm"), Some(samples[5][1]), "{model}");
        let has_end = model.starts_with("liang");
        assert_eq!(number(&comments, "r_max_mm").is_some(), has_end, "{model}");
    }
}

#[test]
fn the_diffuse_mean_free_path_is_read_as_such() {
    let (comments, _) = eval("burley_dmfp", &["--radii", "1"]);
    assert_eq!(number(&comments, "diffuse_mean_free_path_mm"), Some(1.3));
    let (comments, _) = eval("burley_searchlight", &["--radii", "1"]);
    assert_eq!(number(&comments, "mean_free_path_mm"), Some(1.3));
}

#[test]
fn models_tell_channels_apart_that_have_coefficients_for_each() {
    let row = |model, channel| eval(model, &["--radii", "1", "--channel", channel]).1;
    for stem in Model::PUBLISHED {
        let differs = row(stem, "red") != row(stem, "blue");
        assert_eq!(differs, Model::published(stem).unwrap().dependence().on_channel(), "{stem}");
    }
}

#[test]
fn a_mixture_is_evaluated_like_any_other() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("mine.ron");
    let text = "Mixture([(0.25, Burley(parametrization: Diffuse)), (0.75, Dipole(medium: Marble))])";
    std::fs::write(&file, text).unwrap();
    let cdf = |model: &str| eval(model, &["--radii", "0.7", "--channel", "green"]).1[0][3];
    let expected = 0.25 * cdf("burley_diffuse") + 0.75 * cdf("dipole_marble");
    // Two roundings.
    assert!((cdf(file.to_str().unwrap()) - expected).abs() < 1e-15);
}

#[test]
fn the_list_has_every_published_profile_and_every_field_of_every_model() {
    let text = |arguments: &[&str]| {
        let output = profile(&[&["list"], arguments].concat());
        assert_eq!(output.status.code(), Some(0));
        String::from_utf8(output.stdout).unwrap()
    };
    let (list, markdown, sections) = (text(&[]), text(&["--markdown"]), text(&["--coefficients"]));
    for set in subsurface_profile::ModelKind::ALL.iter().flat_map(|kind| kind.published()) {
        let stem = set.stem;
        assert!(list.lines().any(|line| line.starts_with(&format!("{stem} ")) && line.contains(set.source)));
        assert!(markdown.contains(&format!("| `\"{stem}\"` |")), "{stem}");
    }
    for kind in subsurface_profile::ModelKind::ALL {
        let section = sections.split(&format!("### `{}`\n", kind.description().name)).nth(1).unwrap();
        let section = section.split("\n### ").next().unwrap();
        let fields = kind.fields();
        assert!(fields.iter().all(|field| section.contains(field.name())), "{section}");
        assert_eq!(section.lines().filter(|line| line.starts_with("| `")).count(), fields.len(), "{section}");
    }
}

#[test]
fn a_profile_file_overrides_nothing_but_itself() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("mine.ron");
    std::fs::write(&file, "Burley(parametrization: Searchlight)").unwrap();
    let (_, mine) = eval(file.to_str().unwrap(), &["--radii", "0.5,1"]);
    let (_, published) = eval("burley_searchlight", &["--radii", "0.5,1"]);
    assert_eq!(mine, published);

    // A file in the materials directory comes before the built-in model of its name.
    let profiles = folder.path().join("profiles");
    std::fs::create_dir(&profiles).unwrap();
    std::fs::write(profiles.join("burley_searchlight.ron"), "Burley(parametrization: Diffuse)").unwrap();
    let materials = folder.path().to_str().unwrap();
    let (_, shadowed) = eval("burley_searchlight", &["--radii", "0.5,1", "--materials", materials]);
    let (_, diffuse) = eval("burley_diffuse", &["--radii", "0.5,1"]);
    assert_eq!(shadowed, diffuse);
}

#[test]
fn an_unknown_name_gets_a_suggestion() {
    let output = profile(&[
        "eval",
        "--model",
        "burly_diffuse",
        "--surface-albedo",
        "0.5",
        "--mean-free-path-mm",
        "1",
        "--radii",
        "1",
    ]);
    assert_eq!(output.status.code(), Some(1));
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!(
        stderr,
        "error: no profile is called `burly_diffuse`\n  = help: did you mean `burley_diffuse`?\n"
    );
}

#[test]
fn what_lies_outside_the_domain_is_a_usage_error_that_says_the_range() {
    let call = |albedo: &str, length: &str, command: &str, list: [&str; 2]| {
        let albedo = format!("--surface-albedo={albedo}");
        let length = format!("--mean-free-path-mm={length}");
        profile(&[command, "--model", "burley_diffuse", &albedo, &length, list[0], list[1]])
    };
    let radii = |list| ["--radii", list];
    let u = |list| ["--u", list];
    let cases = [
        (call("1.5", "1", "eval", radii("1")), "in [0, 1]"),
        (call("-0.1", "1", "eval", radii("1")), "in [0, 1]"),
        (call("NaN", "1", "eval", radii("1")), "in [0, 1]"),
        (call("0.5", "0", "eval", radii("1")), "above 0"),
        (call("0.5", "-1", "eval", radii("1")), "above 0"),
        (call("0.5", "inf", "eval", radii("1")), "above 0"),
        (call("0.5", "1", "eval", radii("1,-1")), "0 or more"),
        (call("0.5", "1", "eval", radii("-1,1")), "0 or more"),
        (call("0.5", "1", "eval", radii("1,x")), "not a number"),
        (call("0.5", "1", "sample", u("1")), "in [0, 1)"),
        (call("0.5", "1", "sample", u("-0.5")), "in [0, 1)"),
        (call("0.5", "1", "sample", u("NaN")), "in [0, 1)"),
    ];
    for (output, says) in cases {
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{stderr}");
        assert!(stderr.contains(says), "{stderr}");
    }
}
