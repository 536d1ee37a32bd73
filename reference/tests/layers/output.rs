//! MCML's output files.

use std::ops::ControlFlow;

use subsurface_reference::Estimate;
use subsurface_reference::layers::{LayerResult, parse_mci};

use super::{run, simulate};

/// The data lines of one section, read as MCML's own `conv` does: from the line that begins with the section's name to
/// the next empty line.
fn section<'a>(text: &'a str, name: &str) -> Vec<&'a str> {
    let mut lines = text.lines().skip_while(|line| line.split_whitespace().next() != Some(name));
    assert!(lines.next().is_some(), "no section {name}");
    lines.take_while(|line| !line.is_empty()).collect()
}

fn numbers(text: &str, name: &str) -> Vec<f64> {
    section(text, name).iter().map(|line| line.split('#').next().unwrap().trim().parse().unwrap()).collect()
}

fn small() -> LayerResult {
    simulate(1.0, &[[1.4, 1.0, 20.0, 0.6, 0.1], [1.3, 5.0, 2.0, -0.3, 0.2]], 1.2, 5000, 100)
}

#[test]
fn sections_hold_what_was_measured() {
    let result = small();
    let text = result.to_mco();
    let means = |estimates: &[Estimate]| estimates.iter().map(|estimate| estimate.mean).collect::<Vec<_>>();
    let totals = vec![
        result.specular_reflectance,
        result.diffuse_reflectance.mean,
        result.absorbed.mean,
        result.transmittance.mean,
    ];
    for (name, expected) in [
        ("RAT", totals),
        ("A_l", means(&result.absorbed_by_layer)),
        ("A_z", result.absorbed_by_depth.clone()),
        ("Rd_r", means(&result.reflectance_by_radius)),
        ("Rd_a", means(&result.reflectance_by_angle)),
        ("Tt_r", means(&result.transmittance_by_radius)),
        ("Tt_a", means(&result.transmittance_by_angle)),
    ] {
        let written = numbers(&text, name);
        assert_eq!(written.len(), expected.len(), "{name}");
        for (written, expected) in written.iter().zip(expected) {
            // MCML prints A_l to four digits.
            assert!((written - expected).abs() <= 0.5e-3 * expected.abs(), "{name}: {written} {expected}");
        }
    }
    // Every standard error stands in a comment: three totals, two layers, and a line for each cell of four sections.
    let errors: usize = text
        .split("# Standard errors")
        .skip(1)
        .map(|part| {
            part.lines().skip(1).take_while(|line| line.starts_with("# ") && !line.contains(':')).count()
        })
        .sum();
    assert_eq!(errors, 3 + 2 + 50 + 9 + 50 + 9);
}

#[test]
fn the_input_can_be_read_back() {
    let result = small();
    let text = result.to_mco();
    let input = format!("1.0\n1\n{}", text.split_once("\nInParm").unwrap().1.split_once('\n').unwrap().1);
    let input = input.split_once("\nRAT").unwrap().0;
    assert_eq!(parse_mci(input).unwrap(), [result.run]);
}

#[test]
fn an_interrupted_run_says_how_many_photons_it_has() {
    let run = run(1.0, &[[1.4, 1.0, 20.0, 0.6, 0.1]], 1.0, 1_000_000);
    let result = run.simulate(101, &mut |_| ControlFlow::Break(()));
    let text = result.to_mco();
    assert!(text.contains(&format!("# Seed 101, {} of 1000000 photons.", result.photons)));
    assert_eq!(
        section(&text, "InParm")[1].split_whitespace().next(),
        Some(result.photons.to_string().as_str())
    );
}

/// The bytes of a small run: any machine, any number of threads, this text.
const GOLDEN: &str = include_str!("golden.mco");

#[test]
fn bytes_of_a_small_run() {
    let input =
        "1.0\n1\ngolden.mco A\n3000\n0.05 0.05\n4 5 3\n2\n1.0\n1.5 0 0 0 0.1\n1.37 2 50 0.8 0.2\n1.33\n";
    let run = &parse_mci(input).unwrap()[0];
    let text = run.simulate(1995, &mut |_| ControlFlow::Continue(())).to_mco();
    assert_eq!(text.replace(env!("CARGO_PKG_VERSION"), "VERSION"), GOLDEN);
}
