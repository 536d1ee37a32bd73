//! The stored truth, and truth at surface albedos between those of the tables.

use std::f64::consts::PI;

use subsurface_profile::{RadialData, RadialRow};
use subsurface_reference::{RadialBin, RadialTable};

/// A table as the profiles read it.
pub(crate) fn radial_data(table: &RadialTable) -> RadialData {
    let row = |bin: &RadialBin| RadialRow {
        standard_error: Some(bin.standard_error),
        ..RadialRow::bin(bin.r_lo, bin.r_hi, bin.r_reflectance)
    };
    RadialData::new(table.surface_albedo, table.bins.iter().map(row).collect()).unwrap()
}

/// The table of a surface albedo that is stored.
pub(crate) fn at(tables: &[RadialTable], surface_albedo: f64) -> &RadialTable {
    tables.iter().find(|table| (table.surface_albedo - surface_albedo).abs() < 1e-9).unwrap()
}

/// Fraction of the reflected energy within `radius`, linear within a ring.
pub(crate) fn share_within(table: &RadialTable, radius: f64) -> f64 {
    let mut inner = 0.0;
    for bin in &table.bins {
        if radius < bin.r_hi {
            return inner + (bin.cdf_at_r_hi - inner) * (radius - bin.r_lo) / (bin.r_hi - bin.r_lo);
        }
        inner = bin.cdf_at_r_hi;
    }
    1.0
}

/// Truth at any surface albedo within the tables: the cubic through the four around it, of the energy within each
/// radius at which all four have an edge. Without standard errors.
pub(crate) fn between(tables: &[RadialTable], surface_albedo: f64) -> Vec<RadialBin> {
    let above = tables.partition_point(|table| table.surface_albedo < surface_albedo);
    let first = above.saturating_sub(2).min(tables.len() - 4);
    let around = &tables[first..first + 4];
    let factor = |here: &RadialTable| -> f64 {
        let others = around.iter().filter(|other| other.surface_albedo != here.surface_albedo);
        let ratio = |other: &RadialTable| {
            (surface_albedo - other.surface_albedo) / (here.surface_albedo - other.surface_albedo)
        };
        others.map(ratio).product()
    };
    let factors: Vec<f64> = around.iter().map(factor).collect();
    let (mut bins, mut r_lo, mut inner) = (Vec::new(), 0.0, 0.0);
    for bin in &around[0].bins {
        let energies: Option<Vec<f64>> = around.iter().map(|table| energy_at_edge(table, bin.r_hi)).collect();
        let Some(energies) = energies else { continue };
        let energy: f64 = factors.iter().zip(&energies).map(|(factor, energy)| factor * energy).sum();
        bins.push(RadialBin {
            r_lo,
            r_hi: bin.r_hi,
            r_reflectance: (energy - inner) / (2.0 * PI * (bin.r_hi - r_lo)),
            standard_error: 0.0,
            cdf_at_r_hi: energy / surface_albedo,
        });
        (r_lo, inner) = (bin.r_hi, energy);
    }
    bins
}

/// Energy within an edge of the table's rings. Summed, since the cdf is stored with fewer digits.
fn energy_at_edge(table: &RadialTable, r_hi: f64) -> Option<f64> {
    let last = table.bins.iter().position(|bin| bin.r_hi == r_hi)?;
    let energy = |bin: &RadialBin| 2.0 * PI * bin.r_reflectance * (bin.r_hi - bin.r_lo);
    Some(table.bins[..=last].iter().map(energy).sum())
}

#[test]
fn the_cubic_between_albedos_returns_a_table_that_was_left_out() {
    let tables = &subsurface_reference::truth::searchlight().tables;
    for left_out in [0.25, 0.55, 0.9] {
        let without: Vec<RadialTable> =
            tables.iter().filter(|table| table.surface_albedo != left_out).cloned().collect();
        let truth = at(tables, left_out);
        for bin in between(&without, left_out).iter().filter(|bin| bin.cdf_at_r_hi < 0.99) {
            let stored = share_within(truth, bin.r_hi) - share_within(truth, bin.r_lo);
            let stored = left_out * stored / (2.0 * PI * (bin.r_hi - bin.r_lo));
            // Gaps that are twice as wide as those of the tables: the cubic's error there is up to 1 %, and in a
            // table with all of its albedos 1/16 of that. 6 digits of the stored cdf make 0.1 % of a narrow ring.
            let relative = bin.r_reflectance / stored - 1.0;
            assert!(relative.abs() < 0.02, "A = {left_out}, r = {}: {relative}", bin.r_hi);
        }
    }
}
