//! The command as people call it.
#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use std::process::{Command, Output};

fn shader_cost(arguments: &[&str]) -> Output {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    Command::new(env!("CARGO_BIN_EXE_subsurface-cost")).current_dir(root).args(arguments).output().unwrap()
}

#[test]
fn help_has_examples() {
    let output = shader_cost(&["--help"]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success() && text.contains("cargo xtask shader-cost --gpu navi21"), "{text}");
}

#[test]
fn what_cannot_be_is_refused_with_what_can() {
    for (arguments, expected) in [
        (["--gpu", "navi99"], "possible values: polaris10"),
        (["--bless", "--gpu=navi21"], "cannot be used with"),
        (["--kernel", "interlaced"], "there are interleaved"),
        (["--materials", "no/such/folder"], "no/such/folder"),
    ] {
        let output = shader_cost(&arguments);
        let complaint = String::from_utf8(output.stderr).unwrap();
        assert!(!output.status.success() && complaint.contains(expected), "{arguments:?}: {complaint}");
    }
}
