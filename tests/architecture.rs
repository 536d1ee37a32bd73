//! The pages about the house are true: every crate has its paragraph, every arrow its dependency, every path its file.
#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// Pages whose paths in backticks are those of this repository.
const PAGES: [&str; 3] = ["ARCHITECTURE.md", "CONTRIBUTING.md", "docs/kernels.md"];

fn read(path: impl AsRef<Path>) -> String {
    let path = Path::new(ROOT).join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// What a member of the workspace depends on, by kind; development is left out.
#[derive(Debug, Default, PartialEq, Eq)]
struct Arrows {
    normal: BTreeSet<String>,
    build: BTreeSet<String>,
}

/// `codegen` of `subsurface-codegen`.
fn short(package: &str) -> &str {
    package.strip_prefix("subsurface-").unwrap_or(package)
}

/// The members of the workspace, by short name: what their manifests say.
fn members() -> BTreeMap<String, Arrows> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.args(["metadata", "--no-deps", "--offline", "--format-version", "1"]).current_dir(ROOT);
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: Value = serde_json::from_slice(&output.stdout).unwrap();
    let text = |value: &Value| value.as_str().unwrap().to_owned();
    let packages = metadata["packages"].as_array().unwrap();
    let arrows = |package: &Value| {
        let mut arrows = Arrows::default();
        for dependency in package["dependencies"].as_array().unwrap() {
            let name = short(dependency["name"].as_str().unwrap()).to_owned();
            match dependency["kind"].as_str() {
                None => arrows.normal.insert(name),
                Some("build") => arrows.build.insert(name),
                Some(_) => false,
            };
        }
        (short(&text(&package["name"])).to_owned(), arrows)
    };
    packages.iter().map(arrows).collect()
}

/// A line of the block of arrows: `codegen -> profile, (naga)  build: kernel`. Names in parentheses are other projects'.
struct Line {
    ours: Arrows,
    others: BTreeSet<String>,
}

/// The block of arrows, by crate.
fn lines(page: &str) -> BTreeMap<String, Line> {
    let block = page.split("```").find(|block| block.contains("-> nothing")).expect("a block of arrows");
    let rows = block.lines().filter_map(|line| line.split_once("->"));
    rows.map(|(name, rest)| {
        let (normal, build) = rest.split_once("build:").unwrap_or((rest, ""));
        let names = |text: &str| -> Vec<String> {
            let words = text.split(',').map(|word| word.trim().to_owned());
            words.filter(|word| !word.is_empty() && word != "nothing").collect()
        };
        let (others, normal): (Vec<_>, Vec<_>) =
            names(normal).into_iter().partition(|word| word.starts_with('('));
        let others = others.iter().map(|word| word.trim_matches(['(', ')']).to_owned()).collect();
        let ours = Arrows { normal: normal.into_iter().collect(), build: names(build).into_iter().collect() };
        (name.trim().to_owned(), Line { ours, others })
    })
    .collect()
}

#[test]
fn the_arrows_are_those_of_the_manifests() {
    let members = members();
    let lines = lines(&read("ARCHITECTURE.md"));
    let named: BTreeSet<&String> = lines.keys().collect();
    assert_eq!(named, members.keys().collect(), "the crates with arrows are the members of the workspace");
    let marked: BTreeSet<&String> = lines.values().flat_map(|line| &line.others).collect();
    assert!(!marked.is_empty());
    for (name, arrows) in &members {
        let is_ours = |name: &&String| members.contains_key(*name);
        let ours = Arrows {
            normal: arrows.normal.iter().filter(is_ours).cloned().collect(),
            build: arrows.build.iter().filter(is_ours).cloned().collect(),
        };
        let line = &lines[name];
        assert_eq!(line.ours, ours, "{name}: what the page says, and what Cargo.toml says");
        let others: BTreeSet<&String> = arrows.normal.iter().filter(|name| marked.contains(name)).collect();
        assert_eq!(
            line.others.iter().collect::<BTreeSet<_>>(),
            others,
            "{name}: libraries that the page marks"
        );
    }
}

#[test]
fn every_crate_has_its_paragraph_and_says_what_it_does_not_know() {
    let page = read("ARCHITECTURE.md");
    let mut seen = BTreeSet::new();
    for paragraph in page.split("\n\n") {
        let Some((name, rest)) = paragraph.strip_prefix("**`").and_then(|rest| rest.split_once("`**")) else {
            continue;
        };
        let unwrapped = rest.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(unwrapped.contains("*What this crate does not know:*"), "the paragraph of `{name}`");
        assert!(seen.insert(name.to_owned()), "two paragraphs of `{name}`");
    }
    assert_eq!(seen, members().into_keys().collect(), "paragraphs, and members of the workspace");
}

/// Every file and folder of the repository, relative to the root, with `/`.
fn tree() -> BTreeSet<String> {
    fn walk(folder: &Path, all: &mut BTreeSet<String>) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_string_lossy();
            if name == ".git" || name.starts_with("target") {
                continue;
            }
            let relative = path.strip_prefix(ROOT).unwrap();
            all.insert(relative.to_string_lossy().replace(std::path::MAIN_SEPARATOR, "/"));
            if path.is_dir() {
                walk(&path, all);
            }
        }
    }
    let mut all = BTreeSet::new();
    walk(Path::new(ROOT), &mut all);
    all
}

/// What stands in backticks in running text.
fn quoted(page: &str) -> Vec<&str> {
    let outside_blocks = page.split("```").step_by(2);
    outside_blocks.flat_map(|text| text.split('`').skip(1).step_by(2)).collect()
}

/// True for what can only be a path: folders, or the name of a file of this repository.
fn is_path(word: &str) -> bool {
    let has_other_signs =
        word.contains(|sign: char| " <>()@:…\"".contains(sign)) || word.starts_with("target/");
    let is_file =
        [".rs", ".wgsl", ".ron", ".md", ".toml", ".csv", ".yml"].iter().any(|end| word.ends_with(end));
    // A word of slashes alone begins a comment.
    let has_letters = word.chars().any(char::is_alphanumeric);
    !has_other_signs && has_letters && (word.contains('/') || is_file)
}

/// `a` and `b` of `{a,b}`, in place.
fn expanded(word: &str) -> Vec<String> {
    let Some((head, rest)) = word.split_once('{') else { return vec![word.to_owned()] };
    let (choices, tail) = rest.split_once('}').expect("a closing brace");
    choices.split(',').flat_map(|choice| expanded(&format!("{head}{}{tail}", choice.trim()))).collect()
}

/// True if `pattern`, in which a `*` stands for any text without a `/`, is `path`.
fn matches(pattern: &str, path: &str) -> bool {
    match pattern.split_once('*') {
        None => pattern == path,
        Some((head, tail)) => path.strip_prefix(head).is_some_and(|rest| {
            let end = rest.find('/').unwrap_or(rest.len());
            (0..=end).filter(|&end| rest.is_char_boundary(end)).any(|end| matches(tail, &rest[end..]))
        }),
    }
}

#[test]
fn every_path_that_the_pages_name_exists() {
    let tree = tree();
    let mut checked = 0;
    for page in PAGES {
        let text = read(page);
        for word in quoted(&text).into_iter().filter(|word| is_path(word)).flat_map(expanded) {
            let word = word.trim_end_matches('/');
            // A name alone is that of a file in some folder that the text has just named.
            let exists = tree.iter().any(|path| {
                matches(word, path) || (!word.contains('/') && path.rsplit('/').next() == Some(word))
            });
            assert!(exists, "{page} names `{word}`, which does not exist");
            checked += 1;
        }
    }
    assert!(checked > 50, "the pages name more than {checked} paths");
}

/// The anchor of a heading, as GitHub makes it.
fn anchor(heading: &str) -> String {
    let kept = heading.trim().chars().filter(|sign| sign.is_alphanumeric() || " -_".contains(*sign));
    kept.collect::<String>().to_lowercase().replace(' ', "-")
}

#[test]
fn every_link_of_every_page_leads_somewhere() {
    let tree = tree();
    let pages: Vec<&String> = tree.iter().filter(|path| path.ends_with(".md")).collect();
    assert!(pages.len() > 10);
    for page in pages {
        let text = read(page);
        let outside_blocks: String = text.split("```").step_by(2).collect();
        for link in outside_blocks.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            if link.starts_with("https://") {
                continue;
            }
            let (path, fragment) = link.split_once('#').unwrap_or((link, ""));
            let target: PathBuf = match path {
                "" => Path::new(ROOT).join(page),
                path => Path::new(ROOT).join(page).parent().unwrap().join(path),
            };
            assert!(target.exists(), "{page} links to {link}, which does not exist");
            if !fragment.is_empty() {
                let text = fs::read_to_string(&target).unwrap();
                let mut headings = text.lines().filter(|line| line.starts_with('#'));
                let found = headings.any(|line| anchor(line.trim_start_matches('#')) == fragment);
                assert!(found, "{page} links to {link}, and that page has no such heading");
            }
        }
    }
}

#[test]
fn the_checks_tell_paths_from_other_words() {
    assert!(is_path("profile/src/burley.rs") && is_path("emit.rs") && is_path("shaders/{lib,gather}/"));
    assert!(
        !is_path("cargo xtask ci") && !is_path("a::b") && !is_path("min_binding_size") && !is_path("///")
    );
    assert_eq!(expanded("shaders/{lib, gather}/x"), ["shaders/lib/x", "shaders/gather/x"]);
    assert!(
        matches("materials/*.ron", "materials/skin.ron") && !matches("materials/*.ron", "materials/a/b.ron")
    );
    assert!(matches("shaders/*/*.wgsl", "shaders/lib/tone.wgsl"));
    assert_eq!(anchor(" The set: `set.ron`"), "the-set-setron");
}
