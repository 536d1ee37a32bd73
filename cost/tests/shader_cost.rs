//! The command as people call it.
#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

use std::process::{Command, Output};

use serde_json::Value;
use subsurface_kernel::Estimator;
use subsurface_quality::{Device, cost};

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

/// Cycles per pixel of the compute path in the accepted figures; the shape for software drivers runs on no GPU.
fn accepted_cycles(gpu: &str, kernel: Estimator) -> f64 {
    let accepted: Value = serde_json::from_str(include_str!("../blessed.json")).unwrap();
    let kernel = kernel.to_string();
    let figures = accepted["figures"].as_array().unwrap().iter();
    let of_path = figures.filter(|stage| {
        let name = stage["stage"].as_str().unwrap();
        stage["gpu"] == gpu
            && stage["kernel"] == kernel.as_str()
            && name.ends_with("_compute")
            && !name.contains("software")
    });
    of_path.map(|stage| stage["cycles_per_pixel"].as_f64().unwrap()).sum()
}

#[test]
fn the_search_knows_the_accepted_cycles() {
    for (gpu, device) in [
        ("polaris10", Device::Gcn),
        ("vega10", Device::Gcn),
        ("navi21", Device::Rdna),
        ("gfx1100", Device::Rdna),
    ] {
        for kernel in [
            Estimator::Interleaved { taps: 4 },
            Estimator::ImportanceSampled { taps: 17 },
            Estimator::Separable { taps: 17, rotated: false },
        ] {
            let (known, accepted) = (cost(kernel, device), accepted_cycles(gpu, kernel));
            // One line stands for the two GPUs of a class, which differ by up to 2 %; accepted figures move by 5 %.
            assert!(
                (known / accepted - 1.0).abs() < 0.07,
                "{gpu}, {kernel}: {known:.1} of {accepted:.1} cycles"
            );
        }
    }
}
