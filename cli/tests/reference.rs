//! `subsurface reference`: runs that go on, merge and are refused, tables, MCML's files.
#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

/// Runs `subsurface reference …` in `folder`; photons come in batches of 65536, and one batch takes a moment.
fn reference(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_subsurface"))
        .current_dir(folder)
        .arg("reference")
        .args(arguments)
        .output()
        .unwrap()
}

fn succeed(folder: &Path, arguments: &[&str]) -> String {
    let output = reference(folder, arguments);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn complaint(folder: &Path, arguments: &[&str]) -> String {
    let output = reference(folder, arguments);
    assert_eq!(output.status.code(), Some(1), "{arguments:?}");
    String::from_utf8(output.stderr).unwrap().trim_end().to_owned()
}

fn simulate(folder: &Path, seed: &str, photons: &str, out: &str, more: &[&str]) -> String {
    let arguments =
        ["simulate", "--entry", "searchlight", "--photons", photons, "--seed", seed, "--out", out];
    succeed(folder, &[&arguments, more].concat())
}

#[test]
fn a_run_that_goes_on_is_the_run_that_was_never_broken_off() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let said = simulate(folder, "5", "131072", "whole.bin", &["--threads", "1"]);
    assert!(said.starts_with("whole.bin: 131072 photons, "), "{said}");
    simulate(folder, "5", "1", "parts.bin", &["--quiet"]);
    let arguments =
        ["simulate", "--entry", "searchlight", "--photons", "1e5", "--seed", "5", "--out", "parts.bin"];
    let output = reference(folder, &arguments);
    assert_eq!(
        String::from_utf8(output.stderr).unwrap(),
        "going on with parts.bin: 65536 photons are there\n"
    );
    assert_eq!(fs::read(folder.join("whole.bin")).unwrap(), fs::read(folder.join("parts.bin")).unwrap());
    assert_eq!(fs::read_dir(folder).unwrap().count(), 2, "no temporary file is left");
}

#[test]
fn runs_of_two_seeds_add_up() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    simulate(folder, "1", "1", "one.bin", &[]);
    simulate(folder, "2", "1", "two.bin", &[]);
    let said = succeed(folder, &["merge", "one.bin", "two.bin", "--out", "sum.bin"]);
    assert!(said.starts_with("sum.bin: 131072 photons, "), "{said}");
    let reverse = succeed(folder, &["merge", "two.bin", "one.bin", "--out", "reverse.bin"]);
    assert_eq!(said.replace("sum", "reverse"), reverse);
    assert_eq!(fs::read(folder.join("sum.bin")).unwrap(), fs::read(folder.join("reverse.bin")).unwrap());
    insta::assert_snapshot!(complaint(folder, &["merge", "sum.bin", "one.bin", "--out", "more.bin"]), @r"
    error: cannot add one.bin: both runs hold photons of seed 1, some of them the same
      = help: give each machine a seed of its own
    ");
    assert!(!folder.join("more.bin").exists());
}

#[test]
fn a_table_is_read_by_the_commands_that_judge() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    simulate(folder, "3", "1", "run.bin", &[]);
    succeed(folder, &["table", "--run", "run.bin", "--surface-albedo", "0.8,0.3", "--out", "truth.csv"]);
    let table = fs::read_to_string(folder.join("truth.csv")).unwrap();
    let header = "# entry: searchlight\n# anisotropy: 0\n# refractive_index: 1\n# photons: 65536\n# seed: 3\n# command: \
                  subsurface reference table --run run.bin --surface-albedo 0.8,0.3 --out truth.csv\n\
                  surface_albedo,single_scattering_albedo,r_lo,r_hi,r_reflectance,standard_error,cdf_at_r_hi\n0.3,";
    assert!(table.starts_with(header), "{table}");
    let output = Command::new(env!("CARGO_BIN_EXE_subsurface"))
        .current_dir(folder)
        .args(["profile", "compare", "--model", "burley_searchlight", "--truth", "truth.csv", "--csv", "-"])
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(String::from_utf8(output.stdout).unwrap().lines().count(), 3);
    let by_medium =
        succeed(folder, &["table", "--run", "run.bin", "--single-scattering-albedo", "0.9", "--out", "-"]);
    assert!(by_medium.contains(",0.9,0,"), "{by_medium}");
}

#[test]
fn a_run_of_another_seed_agrees_with_the_stored_truth() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    simulate(folder, "424242", "1", "run.bin", &[]);
    let said = succeed(folder, &["check", "--run", "run.bin"]);
    let last = said.lines().last().unwrap();
    let per_ring: f64 = last.split_whitespace().nth(3).unwrap().parse().unwrap();
    // About 70 rings are independent, the albedos of one run are not: χ² per ring spreads by √(2/70) = 0.17, and rings
    // that one photon reaches or none are no Gaussians. Four of those.
    assert!((0.3..1.7).contains(&per_ring), "{said}");
    let seed = stored_seed();
    simulate(folder, &seed, "1", "same.bin", &[]);
    let complaint = complaint(folder, &["check", "--run", "same.bin"]);
    assert!(
        complaint.contains("they may share photons\n  = help: simulate with another --seed"),
        "{complaint}"
    );
}

/// The seed of the stored truth.
fn stored_seed() -> String {
    let table = include_str!("../../reference/truth/searchlight.csv");
    table.lines().find_map(|line| line.strip_prefix("# seed: ")).unwrap().to_owned()
}

#[test]
fn a_run_of_another_medium_or_seed_is_not_gone_on_with() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    simulate(folder, "1", "1", "run.bin", &[]);
    let before = fs::read(folder.join("run.bin")).unwrap();
    let again = |more: &[&str]| {
        let arguments = ["simulate", "--entry", "searchlight", "--photons", "1", "--out", "run.bin"];
        complaint(folder, &[&arguments, more].concat())
    };
    insta::assert_snapshot!(again(&["--anisotropy", "-0.5"]), @r"
    error: run.bin is a run of another half-space: searchlight entry, anisotropy 0, refractive index 1, not searchlight entry, anisotropy -0.5, refractive index 1
      = help: choose another --out, or start over with --fresh
    ");
    insta::assert_snapshot!(again(&["--seed", "2"]), @r"
    error: run.bin is a run of seed 1, not 2
      = help: choose another --out, or start over with --fresh
    ");
    assert_eq!(before, fs::read(folder.join("run.bin")).unwrap());
    simulate(folder, "2", "1", "run.bin", &["--fresh"]);
    assert_ne!(before, fs::read(folder.join("run.bin")).unwrap());
}

#[test]
fn a_file_that_is_no_run_says_why() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    simulate(folder, "1", "1", "run.bin", &[]);
    let bytes = fs::read(folder.join("run.bin")).unwrap();
    fs::write(folder.join("short.bin"), &bytes[..bytes.len() - 7]).unwrap();
    let mut damaged = bytes.clone();
    damaged[bytes.len() / 2] ^= 1;
    fs::write(folder.join("damaged.bin"), damaged).unwrap();
    fs::write(folder.join("foreign.bin"), "not a run").unwrap();
    let table =
        |name: &str| complaint(folder, &["table", "--run", name, "--surface-albedo", "0.5", "--out", "-"]);
    for (name, says) in [
        ("short.bin", "error: short.bin: "),
        ("damaged.bin", "error: damaged.bin: "),
        ("foreign.bin", "error: foreign.bin: this is not a simulation run"),
        ("none.bin", "error: there is no file none.bin"),
    ] {
        let complaint = table(name);
        assert!(complaint.starts_with(says) && complaint.contains("= help: "), "{complaint}");
        if name != "none.bin" {
            let arguments = ["simulate", "--entry", "searchlight", "--photons", "1", "--out", name];
            assert!(reference(folder, &arguments).status.code() == Some(1), "{name} must not be overwritten");
        }
    }
}

#[test]
fn arguments_out_of_range_are_usage_errors() {
    let folder = tempfile::tempdir().unwrap();
    let simulate = ["simulate", "--entry", "searchlight", "--out", "run.bin"];
    let table = ["table", "--run", "run.bin", "--out", "-"];
    let cases: &[(&[&str], &[&str], &str)] = &[
        (&simulate, &["--photons", "0"], "from 1 to 1e15"),
        (&simulate, &["--photons", "1.5"], "whole number"),
        (&simulate, &["--photons", "many"], "not a number"),
        (&simulate, &["--photons", "1", "--anisotropy", "1"], "in (-1, 0.999]"),
        (&simulate, &["--photons", "1", "--anisotropy", "NaN"], "in (-1, 0.999]"),
        (&simulate, &["--photons", "1", "--standard-error", "0"], "between 0 and 1"),
        (&simulate, &["--photons", "1", "--threads", "0"], "from 1 to 1024"),
        (&table, &["--surface-albedo", "1.5"], "in [0, 1]"),
        (&table, &["--single-scattering-albedo", "-0.1"], "in [0, 1]"),
        (&table, &[], "--surface-albedo"),
        (&["merge", "one.bin", "--out", "sum.bin"], &[], "2 values required"),
    ];
    for (command, more, says) in cases {
        let output = reference(folder.path(), &[*command, *more].concat());
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{stderr}");
        assert!(stderr.contains(says), "{stderr}");
    }
    let refractive =
        complaint(folder.path(), &[&simulate[..], &["--photons", "1", "--refractive-index", "0.9"]].concat());
    assert!(refractive.contains("refractive index 0.9 is not in [1, 4]\n  = help: "), "{refractive}");
}

#[test]
fn exact_albedos_are_there_and_back() {
    let folder = tempfile::tempdir().unwrap();
    let first = |arguments: &[&str]| {
        let said = succeed(folder.path(), &[&["albedo", "--entry", "diffuse"], arguments].concat());
        let row: Vec<String> = said.lines().nth(1).unwrap().split_whitespace().map(str::to_owned).collect();
        (row[0].clone(), row[1].clone())
    };
    let (surface_albedo, alpha) = first(&["--surface-albedo", "0.5"]);
    assert_eq!(surface_albedo, "0.50000000");
    assert_eq!(first(&["--single-scattering-albedo", &alpha]), ("0.50000000".to_owned(), alpha));
}

/// A slab and a file with two mistakes of its own.
const SLAB: &str =
    "1.0 # version\n1 # runs\nslab.mco A\n2000\n0.01 0.01\n10 10 5\n1\n1.0\n1.0 10 90 0.75 0.02\n1.0\n";

#[test]
fn layers_write_the_file_that_the_input_names() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("slab.mci"), SLAB).unwrap();
    let said = succeed(folder, &["layers", "slab.mci"]);
    // van de Hulst 1980: R 0.09739, T 0.66096 for this slab; 2000 packets know them to about 0.003 and 0.006, and the
    // bounds are four of those.
    let row: Vec<&str> = said.lines().nth(1).unwrap().split_whitespace().collect();
    let (reflectance, transmittance): (f64, f64) = (row[3].parse().unwrap(), row[5].parse().unwrap());
    assert!((reflectance - 0.09739).abs() < 0.012 && (transmittance - 0.66096).abs() < 0.024, "{said}");
    assert!(fs::read_to_string(folder.join("slab.mco")).unwrap().contains("RAT"));
    fs::create_dir(folder.join("out")).unwrap();
    succeed(folder, &["layers", "slab.mci", "--out", "out", "--threads", "1"]);
    // The number of threads changes nothing.
    assert_eq!(fs::read(folder.join("slab.mco")).unwrap(), fs::read(folder.join("out/slab.mco")).unwrap());
}

#[test]
fn a_bad_input_of_layers_names_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("a.mci"), SLAB.replace("2000", "none")).unwrap();
    let refused = complaint(folder, &["layers", "a.mci"]);
    assert!(refused.starts_with("error: a.mci:4: `none` is not a whole number"), "{refused}");
    fs::write(folder.join("a.mci"), SLAB.replace("slab.mco", "../slab.mco")).unwrap();
    insta::assert_snapshot!(complaint(folder, &["layers", "a.mci"]), @r"
    error: a.mci: the output file `../slab.mco` is not a plain file name
      = help: name the file without a folder, and give the folder with --out DIR
    ");
    assert_eq!(fs::read_dir(folder).unwrap().count(), 1);
}

#[cfg(unix)]
#[test]
fn an_interrupted_simulation_keeps_its_photons() {
    use std::io::{BufRead as _, Read as _};

    let folder = tempfile::tempdir().unwrap();
    simulate(folder.path(), "1", "1", "run.bin", &[]);
    let arguments = ["simulate", "--entry", "searchlight", "--photons", "1e12", "--out", "run.bin"];
    let mut child = Command::new(env!("CARGO_BIN_EXE_subsurface"))
        .current_dir(folder.path())
        .arg("reference")
        .args(arguments)
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    let mut stderr = std::io::BufReader::new(child.stderr.take().unwrap());
    // By the time of its first words it listens to signals.
    let mut first = String::new();
    stderr.read_line(&mut first).unwrap();
    assert!(first.starts_with("going on with run.bin"), "{first}");
    Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    let mut rest = String::new();
    stderr.read_to_string(&mut rest).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130), "{rest}");
    assert!(rest.starts_with("interrupted: run.bin holds the "), "{rest}");
    assert!(rest.ends_with("= help: the same command goes on from there\n"), "{rest}");
    succeed(folder.path(), &["table", "--run", "run.bin", "--surface-albedo", "0.5", "--out", "-"]);
}
