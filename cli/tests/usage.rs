//! How the binary is called: help, exit codes, arguments out of range.
#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use std::process::{Command, Output};

fn subsurface(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_subsurface")).args(arguments).output().unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

const COMMANDS: [&[&str]; 21] = [
    &["render"],
    &["check"],
    &["build"],
    &["profile", "eval"],
    &["profile", "sample"],
    &["profile", "compare"],
    &["profile", "fit"],
    &["profile", "plot"],
    &["profile", "coefficients"],
    &["reference", "simulate"],
    &["reference", "merge"],
    &["reference", "table"],
    &["reference", "check"],
    &["reference", "albedo"],
    &["reference", "layers"],
    &["diffuse"],
    &["contact-sheet"],
    &["export"],
    &["compare"],
    &["bench"],
    &["bench", "kernels"],
];

#[test]
fn every_command_has_help_with_an_example_of_itself() {
    for command in COMMANDS {
        let output = subsurface(&[command, &["--help"]].concat());
        assert_eq!(output.status.code(), Some(0));
        let help = String::from_utf8(output.stdout).unwrap();
        let example = format!("Examples:\n  subsurface {}", command.join(" "));
        assert!(help.contains(&example), "{help}");
    }
}

#[test]
fn a_missing_argument_is_a_usage_error() {
    assert_eq!(subsurface(&[]).status.code(), Some(2));
    // `profile compare` and `bench kernels` need none: they compare all that there is.
    let takes_all = |command: &&[&str]| ["compare", "kernels"].contains(&command[command.len() - 1]);
    for command in COMMANDS.into_iter().filter(|command| !takes_all(command)) {
        assert_eq!(subsurface(command).status.code(), Some(2), "{command:?}");
    }
    assert_eq!(subsurface(&["no-such-command"]).status.code(), Some(2));
}

#[test]
fn an_argument_out_of_range_is_a_usage_error_that_says_the_range() {
    let cases: &[(&[&str], &str)] = &[
        (&["render", "--out", "a.png", "--size", "0x0"], "at least 1x1"),
        (&["render", "--out", "a.png", "--size", "100"], "WIDTHxHEIGHT"),
        (&["render", "--out", "a.png", "--size", "100000x1"], "32768"),
        (&["render", "--out", "a.jpg"], ".png or .exr"),
        (&["render", "--out", "a.png", "--taps", "0"], "1..=4096"),
        (&["render", "--out", "a.png", "--kernel", "interleafed"], "did you mean `interleaved`?"),
        (&["render", "--out", "a.png", "--kernel", "interleaved:65"], "interleaved has 1 to 64 taps, not 65"),
        (&["render", "--out", "a.png", "--kernel", "separable:16"], "an odd number of taps from 3 to 65"),
        (&["contact-sheet", "--out", "a.png", "--kernel", "dense:9"], "no number of taps"),
        (&["render", "--out", "a.png", "--path", "ray"], "possible values: compute, fragment"),
        (&["render", "--out", "a.png", "--shape", "round"], "possible values: hardware, software"),
        (&["render", "--out", "a.png", "--debug", "noise"], "possible values: taps, filter-radius"),
        (&["render", "--out", "a.png", "--debug", "taps", "--no-subsurface"], "cannot be used with"),
        (&["bench", "kernels", "--input", "a.exr"], "--mm-per-pixel"),
        (&["bench", "kernels", "--fov-y-degrees", "24"], "--input"),
        (&["bench", "kernels", "--kernel", "dense"], "always runs"),
        (&["bench", "kernels", "--footprints", "5,0"], "between 0.01 and 100 pixels"),
        (&["bench", "kernels", "--repeats", "0"], "1..=1000"),
        (&["bench", "kernels", "--white", "0"], "above 0"),
        (&["bench", "kernels", "--plot", "a.jpg"], ".svg or .png"),
        (&["render", "--out", "a.png", "--light", "0,0,0"], "direction is zero"),
        (&["render", "--out", "a.png", "--light", "0,0,1,1,180"], "0 to 170"),
        (&["render", "--out", "a.png", "--point", "0,0,1,-1"], "is negative"),
        (&["render", "--out", "a.png", "--spot", "0,0,1,0,0,-1,200"], "0 (no light) to 180"),
        (&["render", "--out", "a.png", "--environment-intensity", "2"], "--environment"),
        (&["render", "--out", "a.png", "--ambient", "-1"], "between 0 and 1e6"),
        (&["render", "--out", "a.png", "--scene", "cube"], "possible values: bust, sphere, ellipsoid"),
        (&["render", "--out", "a.png", "--scene", "sphere", "--mesh", "a.glb"], "cannot be used with"),
        (&["export", "--to", "blender", "--out", "a"], "possible values: mitsuba"),
        (&["compare", "a.exr", "b.exr", "--exposure", "0"], "above 0"),
        (&["render", "--out", "a.png", "--camera", "1,2"], "three numbers"),
        (&["render", "--out", "a.png", "--fov-y-degrees", "180"], "between 1 and 170"),
        (
            &["render", "--out", "a.png", "--mesh", "a.glb", "--flip-v=maybe"],
            "possible values: auto, always, never",
        ),
        (&["render", "--out", "a.png", "--flip-v"], "--mesh <FILE.glb>"),
        (&["contact-sheet", "--out", "a.exr"], ".png"),
        (&["diffuse", "--material", "skin", "--input", "a.exr", "--out", "b.exr"], "--mm-per-pixel"),
        (
            &["diffuse", "--material", "skin", "--input", "a.exr", "--out", "b.exr", "--mm-per-pixel", "-1"],
            "between 1e-9 and 1e9",
        ),
    ];
    for (arguments, says) in cases {
        let output = subsurface(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(stderr(&output).contains(says), "{}", stderr(&output));
    }
}

#[test]
fn zero_by_zero_pixels_keeps_its_exact_message() {
    let output = subsurface(&["render", "--out", "a.png", "--size", "0x0"]);
    insta::assert_snapshot!(stderr(&output).trim_end(), @r"
    error: invalid value '0x0' for '--size <WxH>': a picture needs at least 1x1 pixels, for example 1280x720

    For more information, try '--help'.
    ");
}

#[test]
fn a_missing_folder_is_refused_before_any_work() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("no/such/folder/a.png");
    let output = subsurface(&["render", "--out", out.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        stderr(&output).contains("does not exist\n  = help: create it first: mkdir -p "),
        "{}",
        stderr(&output)
    );
}

#[test]
fn a_missing_materials_directory_says_how_to_name_one() {
    let output = subsurface(&["build", "--materials", "no/such/folder", "--out", "unused"]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(
        stderr(&output).trim_end(),
        "error: there is no materials directory no/such/folder\n  \
         = help: name one with --materials DIR; it holds one .ron file per material"
    );
}
