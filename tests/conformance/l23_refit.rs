//! \[L23\] eq. (6) and (9)-(15): the paper's own procedure on this project's truth.
//!
//! MCML's R'(r) = r·R(r) is cropped where it has fallen to ε = 0.005 of its value at r = 0, then (a r + b)/(r + c) is
//! fitted by least squares, per albedo.

use subsurface_profile::fit::Crop;
use subsurface_profile::{RadialData, RadialRow};
use subsurface_reference::{RadialBin, RadialTable, truth};

use crate::comparison::{Comparison, number};
use crate::minimum::minimum_between;
use crate::rational::{K1_PRINTED, K1_REFITTED, Rational, b_exponent};
use crate::stored::radial_data;

/// What a refit makes of the coefficients of one albedo.
struct Refit {
    /// The cropping radius, mean free paths.
    cropped_at: f64,
    /// a and c over those printed.
    a: f64,
    c: f64,
    /// b over α^k₂, which is k₁.
    k1: f64,
}

/// Least squares of r·R over r, of the rings within `end`.
fn refit(table: &RadialTable, end: f64) -> Rational {
    let bins: Vec<RadialBin> = table.bins.iter().copied().filter(|bin| bin.r_hi <= end).collect();
    // With c given, a and b are linear: the mean over a ring is a (1 - c m) + b m, m the mean of 1/(r + c).
    let best_at = |c: f64| {
        let [mut xx, mut xy, mut yy, mut xt, mut yt] = [0.0; 5];
        for bin in &bins {
            let y = Rational { a: 0.0, b: 1.0, c }.ring_mean(bin.r_lo, bin.r_hi);
            let (x, weight) = (1.0 - c * y, bin.r_hi - bin.r_lo);
            xx += weight * x * x;
            xy += weight * x * y;
            yy += weight * y * y;
            xt += weight * x * bin.r_reflectance;
            yt += weight * y * bin.r_reflectance;
        }
        let determinant = xx * yy - xy * xy;
        Rational { a: (xt * yy - yt * xy) / determinant, b: (yt * xx - xt * xy) / determinant, c }
    };
    let cost = |log_c: f64| {
        let profile = best_at(log_c.exp());
        let square = |bin: &RadialBin| {
            (profile.ring_mean(bin.r_lo, bin.r_hi) - bin.r_reflectance).powi(2) * (bin.r_hi - bin.r_lo)
        };
        bins.iter().map(square).sum::<f64>()
    };
    let start = Rational::liang_2023(table.single_scattering_albedo, K1_REFITTED).c.ln();
    best_at(minimum_between(&cost, start - 1.5, start + 1.5).exp())
}

/// The refits of all stored tables, cropped where `data` say.
fn refits(data: impl Fn(&RadialTable) -> RadialData) -> Vec<Refit> {
    let one = |table: &RadialTable| {
        let alpha = table.single_scattering_albedo;
        let cropped_at = Crop::LIANG_2023.radius(&data(table)).unwrap();
        let (fitted, printed) = (refit(table, cropped_at), Rational::liang_2023(alpha, K1_PRINTED));
        Refit {
            cropped_at,
            a: fitted.a / printed.a,
            c: fitted.c / printed.c,
            k1: fitted.b / alpha.powf(b_exponent(alpha)),
        }
    };
    truth::searchlight().tables.iter().map(one).collect()
}

/// Mean and standard deviation.
fn spread(refits: &[Refit], of: impl Fn(&Refit) -> f64) -> (f64, f64) {
    let mean = refits.iter().map(&of).sum::<f64>() / refits.len() as f64;
    let variance = refits.iter().map(|refit| (of(refit) - mean).powi(2)).sum::<f64>() / refits.len() as f64;
    (mean, variance.sqrt())
}

#[test]
fn equations_11_to_15_are_what_the_procedure_gives_except_k1() {
    let refits = refits(radial_data);
    let mut table = Comparison::new("L23 eq. (6), (11)-(15): refit over all albedos of the tables");
    // Cropping happens in steps of up to 0.5 mean free paths and rings are up to 9 % wide: each moves a single a or c
    // by several per cent. The mean over 27 albedos moves by a fifth of that.
    let (mean, deviation) = spread(&refits, |refit| refit.a);
    table.agrees("a / printed, mean", 1.0, mean, 0.05);
    table.agrees("a / printed, standard deviation", 0.0, deviation, 0.07);
    let (mean, deviation) = spread(&refits, |refit| refit.c);
    table.agrees("c / printed, mean", 1.0, mean, 0.05);
    table.agrees("c / printed, standard deviation", 0.0, deviation, 0.07);
    let (mean, deviation) = spread(&refits, |refit| refit.k1);
    // The same 5 %/√27.
    table.differs("k1 of b, mean", K1_PRINTED, mean, [K1_REFITTED, 0.0015], "misprinted, 7 times too large");
    table.agrees("k1 of b, standard deviation", 0.0, deviation, 0.003);
    table.finish();
}

#[test]
fn equation_6_crops_r_times_reflectance() {
    let mut table = Comparison::new("L23 eq. (6): what is cropped where it falls to 0.005 of r = 0");
    let of_r_reflectance = refits(radial_data);
    // R itself instead of r·R, at the middle of each ring as MCML writes it.
    let of_reflectance = refits(|table| {
        let row = |bin: &RadialBin| {
            let middle = 0.5 * (bin.r_lo + bin.r_hi);
            RadialRow::point(middle, bin.r_reflectance / middle)
        };
        RadialData::new(table.surface_albedo, table.bins.iter().map(row).collect()).unwrap()
    });
    let farthest = |refits: &[Refit]| refits.iter().map(|refit| refit.cropped_at).fold(0.0, f64::max);
    let (mean, _) = spread(&of_r_reflectance, |refit| refit.a);
    let (printed_mean, printed_deviation) = spread(&of_reflectance, |refit| refit.a);
    table.statement(
        "r'_max if r R is cropped",
        "-",
        &format!("up to {} mfp", number(farthest(&of_r_reflectance))),
        farthest(&of_r_reflectance) > 20.0,
    );
    table.statement("a / printed if r R is cropped", "-", &number(mean), (mean - 1.0).abs() < 0.05);
    // R diverges as 1/r, so that the first ring, whatever its width, decides where its 0.005 is.
    table.statement(
        "r'_max if R is cropped",
        "-",
        &format!("up to {} mfp", number(farthest(&of_reflectance))),
        farthest(&of_reflectance) < 1.0,
    );
    table.contradiction(
        "a / printed if R is cropped, as printed",
        "1",
        &format!("{} +- {}", number(printed_mean), number(printed_deviation)),
        (printed_mean - 1.0).abs() > 1.0,
        "R is infinite at r = 0: eq. (6) is for r R",
    );
    table.finish();
}
