//! Layered media: laws, published numbers, and MCML's files.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod adding_doubling;
mod input;
mod laws;
mod output;
mod published;

use std::ops::ControlFlow;

use subsurface_reference::layers::{Grid, Layer, LayerResult, LayerRun, LayerStack, OutputFormat};

/// Index, absorption, scattering, anisotropy, thickness, as in MCML's input.
type Row = [f64; 5];

fn stack(above: f64, rows: &[Row], below: f64) -> LayerStack {
    let layers = rows.iter().map(|&[n, mua, mus, g, d]| Layer::new(n, mua, mus, g, d).unwrap()).collect();
    LayerStack::new(above, layers, below).unwrap()
}

fn run(above: f64, rows: &[Row], below: f64, photons: u64) -> LayerRun {
    let grid = Grid::new(0.01, 0.01, 40, 50, 9).unwrap();
    LayerRun::new("test.mco", OutputFormat::Ascii, photons, grid, stack(above, rows, below)).unwrap()
}

fn simulate(above: f64, rows: &[Row], below: f64, photons: u64, seed: u64) -> LayerResult {
    run(above, rows, below, photons).simulate(seed, &mut |_| ControlFlow::Continue(()))
}

/// Asserts that a difference is below four of its standard deviations, which 6 of 100 000 right results would miss.
/// Seeds are fixed, so a test that passes keeps passing.
#[track_caller]
fn assert_within_noise(what: &str, difference: f64, standard_error: f64) {
    let z = difference / standard_error;
    assert!(
        z.abs() < 4.0,
        "{what}: off by {difference:.2e}, which is {z:.1} standard errors of {standard_error:.1e}"
    );
}
