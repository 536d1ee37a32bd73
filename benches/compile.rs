//! How long the compiler takes: the presets cold, and sets of 100 and 1,000 materials, and one
//! whose kernel is searched.
//!
//! Goals: presets below 50 ms, 1,000 materials below 1 s, 12 materials with a search below 0.3 s, all in release. The time per material should stay flat.

use std::hint::black_box;

use criterion::{Criterion, Throughput};
use subsurface_codegen::Compiler;

/// `count` materials: profiles and values differ, so that little can be shared.
fn materials(count: usize) -> Vec<(String, String)> {
    let profiles = [
        "\"burley_searchlight\"",
        "\"exponential_dipole_diffuse\"",
        "\"liang_2023\"",
        "GaussianSum([(variance_mm2: 0.5, weight: 0.7), (variance_mm2: 2.5, weight: 0.3)])",
    ];
    (0..count)
        .map(|index| {
            let profile = profiles[index % profiles.len()];
            let length = 0.5 + index as f64 * 1e-3;
            let text = format!(
                "/// Material number {index}.\nMaterial(profile: {profile}, mean_free_path_mm: ({length}, 0.9, 0.6), \
                 surface_albedo: (0.8, 0.6, 0.4))\n"
            );
            (format!("material_{index}.ron"), text)
        })
        .collect()
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args().sample_size(10);
    // Read from disk each time, as a build script does.
    criterion.bench_function("compile/presets from disk", |bencher| {
        bencher.iter(|| black_box(Compiler::new("materials").compile().expect("the presets compile")));
    });
    // Twelve that look different, all of one profile: what a set takes that asks for an error.
    let mut files: Vec<_> = (0..12)
        .map(|index| {
            let text = format!(
                "Material(profile: \"two_exponential_dipole_searchlight\", mean_free_path_mm: (1.3, 0.95, {}), \
                 surface_albedo: (0.83, 0.64, 0.55))",
                0.2 + f64::from(index) * 0.05
            );
            (format!("material_{index}.ron"), text)
        })
        .collect();
    for (name, request) in [("without an error", ""), ("with an error", "quality: Medium")] {
        files.push(("set.ron".to_owned(), format!("MaterialSet({request})")));
        criterion.bench_function(&format!("compile/12 materials {name}"), |bencher| {
            bencher.iter(|| {
                let compiler = Compiler::from_memory(files.iter().map(|(path, text)| (path, text.as_str())));
                black_box(compiler.compile().expect("the set compiles"))
            });
        });
        files.pop();
    }
    let mut group = criterion.benchmark_group("compile/materials");
    for count in [10, 100, 1000] {
        let files = materials(count);
        group.throughput(Throughput::Elements(count as u64));
        group.bench_function(count.to_string(), |bencher| {
            bencher.iter(|| {
                let compiler = Compiler::from_memory(files.iter().map(|(path, text)| (path, text.as_str())));
                black_box(compiler.compile().expect("the set compiles"))
            });
        });
    }
    group.finish();
    criterion.final_summary();
}
