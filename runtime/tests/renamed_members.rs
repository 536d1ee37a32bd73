//! A member or a binding that is renamed in WGSL stops the build of the passes, which names it.
//!
//! The generated Rust has the names of the WGSL. This test builds the crate once more against bindings whose members all
//! have another name, and asks the compiler's errors for each of them.

#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What the build script generated for this crate.
const BINDINGS: &str = include_str!(concat!(env!("OUT_DIR"), "/bindings.rs"));

/// The struct of vertices is for the callers' literals: the passes take its layout, which is generated too.
const OF_CALLERS: &str = "GBufferVertex";

/// Fields of the generated structs, padding left out.
fn fields() -> BTreeSet<&'static str> {
    let mut fields = BTreeSet::new();
    let mut structure = "";
    for line in BINDINGS.lines().map(str::trim_start) {
        if let Some(rest) = line.strip_prefix("pub struct ") {
            structure = rest.split(['<', ' ']).next().unwrap_or_default();
        } else if let Some((name, _)) = line.strip_prefix("pub ").and_then(|rest| rest.split_once(':')) {
            let is_word = name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_');
            if is_word && structure != OF_CALLERS && !name.starts_with('_') {
                fields.insert(name);
            }
        }
    }
    fields
}

/// `text` with `_anew` behind each of `words`.
fn renamed(text: &str, words: &BTreeSet<&str>) -> String {
    let is_of_word = |c: char| c.is_alphanumeric() || c == '_';
    let mut result = String::with_capacity(2 * text.len());
    let mut rest = text;
    while !rest.is_empty() {
        let is_word = rest.starts_with(is_of_word);
        let end = rest.find(|c| is_of_word(c) != is_word).unwrap_or(rest.len());
        let (piece, behind) = rest.split_at(end);
        result.push_str(piece);
        if words.contains(piece) {
            result.push_str("_anew");
        }
        rest = behind;
    }
    result
}

/// A workspace of this crate alone, whose build script takes `bindings` as they are.
fn copy_of_the_crate(bindings: &str) -> PathBuf {
    let crate_folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let root = crate_folder.parent().unwrap();
    let to = Path::new(env!("CARGO_TARGET_TMPDIR")).join("renamed_members");
    if to.exists() {
        fs::remove_dir_all(&to).unwrap();
    }
    copy(&crate_folder.join("src"), &to.join("runtime/src"));
    let manifest = fs::read_to_string(crate_folder.join("Cargo.toml")).unwrap();
    // The passes alone: neither the build script's dependencies nor those of tests. But `syn` with the features that it
    // has in the test of the consumer: nearly all crates are built with it, and those of that test serve here too.
    let (manifest, _) = manifest.split_once("[build-dependencies]").unwrap();
    let manifest = manifest.replace("readme = \"README.md\"\n", "");
    fs::write(to.join("runtime/Cargo.toml"), manifest + "[build-dependencies]\nsyn.workspace = true\n")
        .unwrap();
    fs::write(to.join("runtime/bindings.rs"), bindings).unwrap();
    fs::write(
        to.join("runtime/build.rs"),
        "fn main() {\n    let folder = std::env::var(\"OUT_DIR\").unwrap();\n    \
         std::fs::copy(\"bindings.rs\", folder + \"/bindings.rs\").unwrap();\n}\n",
    )
    .unwrap();
    let workspace = fs::read_to_string(root.join("Cargo.toml")).unwrap();
    let (workspace, _) = workspace.split_once("[package]").unwrap();
    let members = workspace.lines().find(|line| line.starts_with("members = ")).unwrap();
    // In TOML's literal strings a backslash is just that.
    let kernel = format!("path = '{}'", root.join("kernel").display());
    let workspace =
        workspace.replace(members, "members = [\"runtime\"]").replace("path = \"kernel\"", &kernel);
    // Profiles name packages that are not here.
    let (workspace, _) = workspace.split_once("[profile").unwrap();
    fs::write(to.join("Cargo.toml"), workspace).unwrap();
    fs::copy(root.join("Cargo.lock"), to.join("Cargo.lock")).unwrap();
    to
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        let target = to.join(path.file_name().unwrap());
        if path.is_dir() { copy(&path, &target) } else { fs::copy(&path, &target).map(drop).unwrap() }
    }
}

/// What Cargo says of a build of the copy.
fn build(bindings: &str) -> (bool, String) {
    let package = copy_of_the_crate(bindings);
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.current_dir(&package).args(["build", "--package", "subsurface-runtime", "--offline"]);
    // As the test of the consumer builds, and into its folder.
    command.args(["--config", "profile.dev.package.'*'.opt-level=0", "--config", "profile.dev.debug=false"]);
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("consumer/target");
    command.env("CARGO_TARGET_DIR", target).env("CARGO_TERM_COLOR", "never");
    let output = command.output().unwrap();
    (output.status.success(), String::from_utf8_lossy(&output.stderr).into_owned())
}

#[test]
fn members_and_bindings_that_are_renamed_stop_the_build() {
    let fields = fields();
    // A member of each struct, and a binding.
    for known in ["taps", "world_from_object", "opaque_roughness", "lights", "exposure", "irradiance_texture"]
    {
        assert!(fields.contains(known), "{known}: {fields:?}");
    }
    let (is_built, errors) = build(&renamed(BINDINGS, &fields));
    assert!(!is_built);
    let missing: Vec<&&str> = fields
        .iter()
        .filter(|field| {
            let is_named =
                |line: &str| line.starts_with("error") && line.contains(&format!("field named `{field}`"));
            !errors.lines().any(is_named)
        })
        .collect();
    assert!(missing.is_empty(), "the build does not name {missing:?}:\n{errors}");
    // The copy is a whole crate: with the names as they are it is built.
    let (is_built, errors) = build(BINDINGS);
    assert!(is_built, "{errors}");
}
