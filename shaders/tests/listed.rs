//! Every WGSL file is listed, in its room.

use std::path::Path;

use subsurface_shaders::{GATHER, KERNELS, LIBRARY, LIGHT, PASSES, PROFILES, modules};

fn collect(folder: &Path, root: &Path, names: &mut Vec<String>) {
    for entry in std::fs::read_dir(folder).expect("the folder can be read") {
        let path = entry.expect("the folder can be read").path();
        if path.is_dir() {
            collect(&path, root, names);
        } else if path.extension().is_some_and(|extension| extension == "wgsl") {
            let below = path.strip_prefix(root).expect("it is below the root").with_extension("");
            let parts: Vec<_> = below.iter().map(|part| part.to_string_lossy()).collect();
            names.push(parts.join("/"));
        }
    }
}

#[test]
fn every_file_is_listed() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = Vec::new();
    collect(root, root, &mut files);
    files.sort();
    let mut listed: Vec<_> = modules().map(|module| module.name).collect();
    listed.sort_unstable();
    assert_eq!(listed, files);
}

#[test]
fn rooms_hold_their_own_files_sorted() {
    for (room, files) in [
        ("lib/", LIBRARY),
        ("profiles/", PROFILES),
        ("gather/", GATHER),
        ("kernels/", KERNELS),
        ("light/", LIGHT),
        ("passes/", PASSES),
    ] {
        assert!(files.iter().all(|module| module.name.starts_with(room)), "{room}");
        assert!(files.windows(2).all(|pair| pair[0].name < pair[1].name), "{room} is not sorted");
    }
}
