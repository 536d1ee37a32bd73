//! The crate of the guide's section "A whole crate", built and run outside the workspace.
//!
//! One test, because its steps share a build: what one step leaves is what the next one starts from.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// The copy of `examples/consumer` that is built, in one place for all runs: another place would be another package to
/// Cargo, and its artifacts would pile up.
fn copy_of_the_consumer() -> PathBuf {
    let (from, to) = (Path::new(ROOT).join("examples/consumer"), scratch().join("package"));
    if to.exists() {
        std::fs::remove_dir_all(&to).expect("the copy of the last run can be removed");
    }
    for file in ["build.rs", "materials/marble.ron", "materials/skin.ron", "src/main.rs"] {
        write(&to.join(file), &read(&from.join(file)));
    }
    let manifest = read(&from.join("Cargo.toml"));
    assert!(manifest.contains("\"../../runtime\"") && manifest.contains("\"../../codegen\""), "{manifest}");
    // In TOML's literal strings a backslash is just that.
    let absolute = |name: &str| format!("'{}'", Path::new(ROOT).join(name).display());
    let manifest = manifest
        .replace("\"../../runtime\"", &absolute("runtime"))
        .replace("\"../../codegen\"", &absolute("codegen"));
    write(&to.join("Cargo.toml"), &manifest);
    // The versions that the workspace was tested with, which are on this machine already.
    write(&to.join("Cargo.lock"), &read(&Path::new(ROOT).join("Cargo.lock")));
    to
}

fn scratch() -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("consumer")
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn write(path: &Path, text: &str) {
    let folder = path.parent().expect("a file has a folder");
    std::fs::create_dir_all(folder).expect("folders can be made below the target folder");
    std::fs::write(path, text).expect("files can be written below the target folder");
}

/// Runs Cargo in the copy: without the network if that is enough.
fn cargo(package: &Path, arguments: &[&str]) -> Output {
    let run = |network: &[&str]| {
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let mut command = Command::new(cargo);
        command.current_dir(package).args(arguments).args(network);
        // The workspace optimizes its dependencies; a build that runs once a test would lose more than it gains.
        command.args([
            "--config",
            "profile.dev.package.'*'.opt-level=0",
            "--config",
            "profile.dev.debug=false",
        ]);
        command.env("CARGO_TARGET_DIR", scratch().join("target")).env("CARGO_TERM_COLOR", "never");
        command.output().expect("Cargo starts")
    };
    let output = run(&["--offline"]);
    if !output.status.success() && text(&output.stderr).contains("--offline") {
        return run(&[]);
    }
    output
}

fn succeeded(output: Output) -> Output {
    assert!(output.status.success(), "{}{}", text(&output.stdout), text(&output.stderr));
    output
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// The programs that a verbose build ran: build scripts and compilers, by the package they ran for.
fn ran(output: &Output) -> Vec<String> {
    let lines = text(&output.stderr);
    let programs = lines.lines().filter_map(|line| line.trim_start().strip_prefix("Running `"));
    programs
        .map(|command| {
            let script = command.split_whitespace().find(|word| word.contains("build-script-build"));
            match command.split_once("--crate-name ") {
                Some((_, rest)) => format!("rustc {}", rest.split(' ').next().unwrap_or_default()),
                None => format!("script {}", script.and_then(package_of_script).unwrap_or(command)),
            }
        })
        .collect()
}

/// `consumer` of `…/build/consumer-1c0b7a72f2dd4f5e/build-script-build`.
fn package_of_script(path: &str) -> Option<&str> {
    let folder = Path::new(path).parent()?.file_name()?.to_str()?;
    folder.rsplit_once('-').map(|(name, _)| name)
}

/// The lines that the consumer prints: the kernel's provenance, and a pixel of each material.
fn printed(output: &Output) -> [String; 3] {
    let lines: Vec<String> = text(&output.stdout).lines().map(str::to_owned).collect();
    let [kernel, skin, marble] =
        lines.try_into().unwrap_or_else(|lines| panic!("not three lines: {lines:?}"));
    assert!(kernel.starts_with("kernel ") && skin.starts_with("skin: ") && marble.starts_with("marble: "));
    [kernel, skin, marble]
}

#[test]
fn a_crate_outside_the_workspace_swaps_its_model_by_one_word() {
    let package = copy_of_the_consumer();
    let [kernel, skin, marble] = printed(&succeeded(cargo(&package, &["run", "--quiet"])));
    for (line, name) in [(&skin, "skin"), (&marble, "marble")] {
        assert!(line.starts_with(&format!("{name}: 0 -> [")), "the pixel lies in shadow: {line}");
        assert!(!line.contains("-> [0.0, 0.0, 0.0, "), "light reaches it under the surface: {line}");
    }

    // Nothing changed: nothing runs.
    let again = succeeded(cargo(&package, &["build", "--verbose"]));
    assert_eq!(ran(&again), [""; 0], "{}", text(&again.stderr));
    assert!(text(&again.stderr).contains("Fresh consumer"), "{}", text(&again.stderr));

    // One word in the RON: the consumer's own build script and crate, and no other.
    let material = package.join("materials/skin.ron");
    let original = read(&material);
    assert_eq!(original.matches("two_exponential_dipole_searchlight").count(), 1);
    write(&material, &original.replace("two_exponential_dipole_searchlight", "burley_searchlight"));
    let changed = succeeded(cargo(&package, &["build", "--verbose"]));
    assert_eq!(ran(&changed), ["script consumer", "rustc consumer"], "{}", text(&changed.stderr));
    assert!(text(&changed.stderr).contains("Fresh subsurface-codegen"), "{}", text(&changed.stderr));

    let [other_kernel, other_skin, same_marble] = printed(&succeeded(cargo(&package, &["run", "--quiet"])));
    assert_ne!(kernel, other_kernel, "another model is another kernel");
    assert_ne!(skin, other_skin, "and another picture");
    assert_eq!(marble, same_marble, "of that material alone");

    // The same word back: the same bytes.
    write(&material, &original);
    let back = printed(&succeeded(cargo(&package, &["run", "--quiet"])));
    assert_eq!(back, [kernel, skin, marble]);

    // A new file is seen too, though no file that was read has changed.
    write(&package.join("materials/bone.ron"), &original);
    let added = succeeded(cargo(&package, &["build", "--verbose"]));
    assert_eq!(ran(&added), ["script consumer", "rustc consumer"], "{}", text(&added.stderr));

    // A set that asks for an error states it, and other tiers beside it.
    write(&package.join("materials/set.ron"), "MaterialSet(quality: Medium)\n");
    let program = package.join("src/main.rs");
    let stated = "fn main() -> Result<(), Box<dyn std::error::Error>> {\n    \
                  const { assert!(materials::KERNEL_ERROR <= 0.02) };\n    \
                  const { assert!(materials::Quality::Low.taps() <= materials::Quality::High.taps()) };\n    \
                  assert!(materials::Quality::ALL.iter().all(|tier| tier.error() > 0.0));\n";
    write(&program, &read(&program).replace(stated.lines().next().expect("the first line"), stated));
    assert!(read(&program).contains("KERNEL_ERROR"));
    printed(&succeeded(cargo(&package, &["run", "--quiet"])));

    // A material that does not exist is a compile error.
    write(&program, &read(&program).replace("Material::Marble", "Material::Granite"));
    let refused = cargo(&package, &["build"]);
    let message = text(&refused.stderr);
    assert!(!refused.status.success() && message.contains("error[E0599]"), "{message}");
    assert!(message.contains("no variant") && message.contains("`Granite`"), "{message}");
}

#[test]
fn the_consumer_stays_below_40_lines() {
    let program = read(&Path::new(ROOT).join("examples/consumer/src/main.rs"));
    assert!(program.lines().count() < 40, "{} lines", program.lines().count());
}

#[test]
fn the_guide_shows_the_whole_crate() {
    let root = Path::new(ROOT);
    let guide = read(&root.join("docs/guide.md"));
    for (file, language) in [
        ("build.rs", "rust"),
        ("materials/skin.ron", "ron"),
        ("materials/marble.ron", "ron"),
        ("src/main.rs", "rust"),
    ] {
        let block = format!("```{language}\n{}```\n", read(&root.join("examples/consumer").join(file)));
        assert!(guide.contains(&block), "docs/guide.md does not show examples/consumer/{file} as it is");
    }
    let manifest = read(&root.join("examples/consumer/Cargo.toml"));
    for line in code(&guide, "toml") {
        assert!(manifest.lines().any(|own| own == line), "the consumer's manifest has no line `{line}`");
    }
}

/// The README shows parts of the program, less indented, in the order in which they stand in it.
#[test]
fn the_readme_quotes_the_crate() {
    let root = Path::new(ROOT);
    let crate_root = root.join("examples/consumer");
    let readme = read(&root.join("README.md"));
    let program = [read(&crate_root.join("build.rs")), read(&crate_root.join("src/main.rs"))].concat();
    let mut rest = program.lines().map(str::trim);
    let quoted = code(&readme, "rust");
    assert!(quoted.len() > 10, "README.md shows the pass");
    for line in quoted.iter().map(|line| line.trim()) {
        assert!(rest.any(|own| own == line), "examples/consumer has no line `{line}`, or not in this order");
    }
    let material = format!("```ron\n{}```\n", read(&crate_root.join("materials/skin.ron")));
    assert!(
        readme.contains(&material),
        "README.md does not show examples/consumer/materials/skin.ron as it is"
    );
}

/// The lines of the blocks of code in `language`, without empty ones.
fn code<'a>(text: &'a str, language: &str) -> Vec<&'a str> {
    let mut lines = Vec::new();
    let mut is_inside = false;
    for line in text.lines() {
        match line.strip_prefix("```") {
            Some(name) => is_inside = !is_inside && name == language,
            None if is_inside && !line.is_empty() => lines.push(line),
            None => {}
        }
    }
    lines
}
