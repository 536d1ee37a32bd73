//! Makes the tables of `reference/truth/`.
//!
//! ```text
//! cargo run --release -p subsurface-reference --example truth -- PHOTONS RUNS [NAME...]
//! ```
//!
//! `RUNS` is a folder for the runs themselves: one that is already there goes on where it was. `NAME` is one of
//! `searchlight`, `diffuse`, `searchlight_eta_1_4`, `diffuse_eta_1_4`; without one, all four are made.

#![allow(clippy::print_stderr, reason = "a program that runs for minutes says how far it is")]

use std::error::Error;
use std::io::ErrorKind;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

use subsurface_reference::{Entry, Goal, HalfSpace, Run, TruthTable};

/// The tables and their seeds: each has its own, so that their errors are independent.
const TABLES: [(&str, Entry, f64, u64); 4] = [
    ("searchlight", Entry::Searchlight, 1.0, 1),
    ("diffuse", Entry::Diffuse, 1.0, 2),
    ("searchlight_eta_1_4", Entry::Searchlight, 1.4, 3),
    ("diffuse_eta_1_4", Entry::Diffuse, 1.4, 4),
];

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [photons, runs, names @ ..] = arguments.as_slice() else {
        return Err("usage: truth PHOTONS RUNS [NAME...]".into());
    };
    let photons: u64 = photons.parse()?;
    std::fs::create_dir_all(runs)?;
    for (name, entry, refractive_index, seed) in TABLES {
        if !names.is_empty() && !names.iter().any(|wanted| wanted == name) {
            continue;
        }
        let path = Path::new(runs).join(format!("{name}.run"));
        let mut run = match std::fs::read(&path) {
            Ok(bytes) => Run::from_bytes(&bytes)?,
            Err(error) if error.kind() != ErrorKind::NotFound => return Err(error.into()),
            Err(_) => Run::new(HalfSpace::new(entry, 0.0, refractive_index)?, seed),
        };
        let (start, events) = (Instant::now(), run.events());
        run.simulate(&Goal::photons(photons)?, &mut |progress| {
            let rate = (progress.events - events) as f64 / start.elapsed().as_secs_f64();
            eprint!("\r{name}: {:.3e} photons, {:.0} M events/s", progress.photons as f64, rate / 1e6);
            ControlFlow::Continue(())
        });
        eprintln!();
        std::fs::write(path, run.to_bytes())?;
        let command =
            format!("cargo run --release -p subsurface-reference --example truth -- {photons} RUNS {name}");
        let table = TruthTable::from_run(&run, &TruthTable::SURFACE_ALBEDOS, &command)?;
        let target = Path::new(env!("CARGO_MANIFEST_DIR")).join("truth").join(format!("{name}.csv"));
        std::fs::write(target, table.to_csv())?;
    }
    Ok(())
}
